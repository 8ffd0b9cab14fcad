#include "app/cli/interruption.h"

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/stop_request.h"

namespace overt {
namespace {

constexpr std::array<int, 3> watched{SIGINT, SIGTERM, SIGHUP};

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "the handler of a signal must not wait");

void take_note(int) {
    interrupted.store(true, std::memory_order_relaxed);
    for (const int signal : watched)
        if (signal != SIGHUP) // its ignoring may be meant, and one more does no harm
            std::signal(signal, SIG_DFL);
}

} // namespace

Interruption::Interruption() {
    interrupted.store(false, std::memory_order_relaxed);
    stop_check().store([]() noexcept { return interrupted.load(std::memory_order_relaxed); });
    struct sigaction action {};
    action.sa_handler = take_note;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    for (std::size_t i = 0; i < watched.size(); ++i) {
        sigaction(watched[i], nullptr, &before_[i]);
        if (before_[i].sa_handler != SIG_IGN)
            sigaction(watched[i], &action, nullptr);
    }
}

Interruption::~Interruption() {
    stop_check().store(nullptr);
    for (std::size_t i = 0; i < watched.size(); ++i)
        sigaction(watched[i], &before_[i], nullptr);
}

const std::atomic<bool>& Interruption::requested() noexcept { return interrupted; }

void Interruption::check(std::string_view what) {
    if (requested())
        throw Error(fmt::format("{} was interrupted: nothing of it is left.", what));
}

} // namespace overt
