#include "devices/display_box/box_time.h"

#include <vector>

namespace overt {
namespace {

static_assert(std::is_same_v<BoxClock::duration, TrackerClock::duration>);

TrackerTime in_trackers_place(BoxTime time) { return TrackerTime(time.time_since_epoch()); }

std::vector<ClockPair> in_trackers_place(std::span<const BoxClockPair> pairs) {
    std::vector<ClockPair> replaced;
    for (const BoxClockPair& pair : pairs)
        replaced.push_back({pair.before, in_trackers_place(pair.box), pair.after});
    return replaced;
}

} // namespace

BoxClockMap::BoxClockMap(std::span<const BoxClockPair> pairs) : map_(in_trackers_place(pairs)) {}

MappedTime BoxClockMap::to_session(BoxTime time) const { return map_.to_session(in_trackers_place(time)); }

} // namespace overt
