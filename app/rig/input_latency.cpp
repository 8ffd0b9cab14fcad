#include "app/rig/input_latency.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/random.h"
#include "render/window/sent_keys.h"
#include "render/window/window_response_panel.h"

namespace overt {

namespace {

constexpr int flips_to_begin_with = 12; ///< a driver needs some pictures to fall into step

/// Presses keys until it is destroyed.
class KeySender {
  public:
    KeySender(WindowContext& window, const Clock& clock, std::uint64_t seed)
        : keys_(window), thread_([this, &clock, seed] { run(clock, seed); }) {}
    ~KeySender() {
        is_over_ = true;
        thread_.join();
    }

    int sent() const noexcept { return sent_; }
    /// When a press was sent, by its number from 0.
    SessionTime at(int press) const { return times_[static_cast<std::size_t>(press)]; }

  private:
    void run(const Clock& clock, std::uint64_t seed) {
        RandomStream random(seed, "keys that are sent");
        while (!is_over_ && sent_ < static_cast<int>(times_.size())) {
            std::this_thread::sleep_for(std::chrono::duration<double>(random.uniform(0.02, 0.14)));
            const int press = sent_;
            times_[static_cast<std::size_t>(press)] = clock.now();
            sent_ = press + 1; // before the key comes
            keys_.send(true);
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            keys_.send(false);
        }
    }

    SentKeys keys_;
    std::array<SessionTime, 20000> times_{};
    std::atomic<int> sent_{0};
    std::atomic<bool> is_over_{false};
    std::thread thread_;
};

int presses_in(WindowResponsePanel& panel) {
    int presses = 0;
    while (panel.poll()) {
    }
    while (const std::optional<ObserverInput> input = panel.next_input())
        presses += input->kind == ObserverInput::Kind::key_down && input->key.view() == "right";
    return presses;
}

} // namespace

std::string InputLatency::description() const {
    if (!delays)
        return fmt::format("none of {} keys that were sent came", sent);
    return fmt::format("{:.1f} ms in the median ({:.2f} refreshes), 95 % within {:.1f} ms, {:.1f} ms at the "
                       "longest, of {} keys{}",
                       1e3 * delays->median_s, median_refreshes(), 1e3 * delays->most_s,
                       1e3 * delays->longest_s, delays->count,
                       seen < sent ? fmt::format("; {} did not come", sent - seen) : "");
}

InputLatency measure_input_latency(WindowContext& window, const Clock& clock, double seconds,
                                   std::uint64_t seed, const std::function<FlipReport(int presses)>& flip) {
    WindowResponsePanel panel(window, clock, {}, {});
    for (int i = 0; i < flips_to_begin_with; ++i)
        flip(0);
    panel.await_answer(clock.now(), nullptr);
    presses_in(panel);
    InputLatency found;
    std::vector<double> delays_s, intervals_s;
    const auto sender = std::make_unique<KeySender>(window, clock, seed);
    const SessionTime end = clock.now() + from_seconds(seconds);
    SessionTime before = flip(0).vertical_blank;
    while (clock.now() < end) {
        const int first = found.seen;
        found.seen += presses_in(panel);
        const SessionTime lit = flip(found.seen).vertical_blank;
        for (int press = first; press < found.seen; ++press)
            delays_s.push_back(to_seconds(lit - sender->at(press)));
        intervals_s.push_back(to_seconds(lit - before));
        before = lit;
    }
    // The last may be on its way.
    found.sent = sender->sent();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    found.sent = std::max(found.sent, found.seen);
    found.seen = std::min(found.sent, found.seen + presses_in(panel));
    found.delays = summary_of(std::move(delays_s));
    if (!intervals_s.empty()) {
        const auto middle = intervals_s.begin() + static_cast<std::ptrdiff_t>(intervals_s.size() / 2);
        std::ranges::nth_element(intervals_s, middle);
        found.refresh_ms = 1e3 * *middle;
    }
    return found;
}

} // namespace overt
