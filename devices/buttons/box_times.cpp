#include "devices/buttons/box_times.h"

namespace overt {
namespace {

using namespace std::chrono_literals;

/// More are not needed for the drift; the oldest make room.
constexpr std::size_t most_pairs = 1000;

/// Which instant of the millisecond it is makes no difference: readings and changes have the same.
BoxTime time_of(std::uint32_t ms) { return BoxTime(std::chrono::milliseconds(ms)); }

} // namespace

void BoxTimes::add_exchange(SessionTime before, std::uint32_t ms, SessionTime after) {
    if (pairs_.size() >= most_pairs)
        pairs_.erase(pairs_.begin() + 1); // the first keeps the line long
    // Half a millisecond for where in the millisecond it was.
    pairs_.push_back({before - 500us, time_of(ms), after + 500us});
    map_.emplace(pairs_);
}

void BoxTimes::forget() {
    pairs_.clear();
    map_.reset();
}

ButtonChange BoxTimes::arrival(int button, bool is_down, SessionTime looked_before, SessionTime fetched,
                               SessionDuration transport) noexcept {
    ButtonChange change;
    change.button = button;
    change.is_down = is_down;
    const SessionDuration within = fetched - looked_before + transport;
    change.at = fetched - within / 2;
    change.uncertainty = within / 2;
    return change;
}

ButtonChange BoxTimes::of(int button, bool is_down, std::uint32_t ms, SessionTime looked_before,
                          SessionTime fetched) const noexcept {
    ButtonChange change = arrival(button, is_down, looked_before, fetched, usb_transport);
    change.device_time = time_of(ms);
    if (!map_)
        return change;
    const MappedTime mapped = map_->to_session(time_of(ms));
    change.at = mapped.time;
    change.uncertainty = mapped.uncertainty + SessionDuration(500us);
    return change;
}

} // namespace overt
