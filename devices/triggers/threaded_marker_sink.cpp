#include "devices/triggers/threaded_marker_sink.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

/// In case the bell is missed, which it is not; and to see a stop.
constexpr std::chrono::milliseconds longest_sleep{50};

} // namespace

ThreadedMarkerSink::ThreadedMarkerSink(std::unique_ptr<MarkerOutput> output, Clock& clock, MarkerPulse pulse,
                                       std::size_t capacity)
    : output_(std::move(output)), clock_(clock), pulse_(pulse), held_(capacity), fates_(capacity) {
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

ThreadedMarkerSink::~ThreadedMarkerSink() {
    if (thread_.joinable())
        finish();
}

void ThreadedMarkerSink::mark(const Marker& marker) noexcept {
    if (output_->needs_code() && marker.code == 0)
        return;
    Held held{};
    held.at = marker.at;
    held.code = marker.code;
    held.number = marker.number;
    held.length = static_cast<std::uint8_t>(std::min(marker.text.size(), longest_marker));
    std::memcpy(held.text.data(), marker.text.data(), held.length);
    if (held_.try_push(held))
        bell_.ring();
    else
        ++crowded_;
}

void ThreadedMarkerSink::serve(const std::stop_token& stop) noexcept {
    for (;;) {
        const bool is_last = stop.stop_requested();
        for (Held held; held_.try_pop(held);)
            send(held);
        if (is_last)
            return;
        bell_.wait_for(longest_sleep);
    }
}

void ThreadedMarkerSink::send(const Held& held) noexcept {
    SentMarker fate;
    fate.code = held.code;
    fate.at = held.at;
    fate.number = held.number;
    fate.not_before = clock_.now();
    const bool is_sent = output_->send({held.at, held.code, {held.text.data(), held.length}});
    fate.not_after = clock_.now();
    fate.is_sent = is_sent;
    failed_ += is_sent ? 0 : 1;
    if (!fates_.try_push(fate))
        ++untold_;
    if (is_sent && pulse_.length > SessionDuration::zero()) {
        clock_.wait_until(fate.not_after + pulse_.length);
        output_->rest();
        clock_.wait_until(clock_.now() + pulse_.pause);
    }
}

std::size_t ThreadedMarkerSink::poll(std::span<SentMarker> into) noexcept {
    std::size_t taken = 0;
    while (taken < into.size() && fates_.try_pop(into[taken]))
        ++taken;
    return taken;
}

std::vector<std::string> ThreadedMarkerSink::finish() {
    if (!thread_.joinable())
        return {};
    thread_.request_stop();
    bell_.ring();
    thread_.join();
    std::vector<std::string> said;
    if (const std::int64_t failed = failed_)
        said.push_back(
            fmt::format("{}: {} could not be sent: {}", name(), counted(failed, "marker"), output_->fault()));
    if (const std::int64_t crowded = crowded_)
        said.push_back(fmt::format("{}: {} went lost: too many at once", name(), counted(crowded, "marker")));
    if (const std::int64_t untold = untold_)
        said.push_back(fmt::format("{}: when {} went out is not known: nobody asked", name(),
                                   counted(untold, "marker")));
    return said;
}

} // namespace overt
