#include "experiment/protocol/recorded_course.h"

#include <algorithm>

#include <fmt/format.h>

namespace overt {

std::string RecordedCourse::name() const { return fmt::format("{} trial {}", whose, trial); }

AnimationFrameIndex RecordedCourse::frame_at(int refresh, double refresh_hz) const noexcept {
    // Tables have times to a microsecond, and no refresh is as short as ten of them.
    constexpr double rounding_s = 1e-5;
    const auto next =
        std::ranges::upper_bound(turns, refresh / refresh_hz + rounding_s, {}, &RecordedCourse::Turn::t_s);
    return next == turns.begin() ? next->frame : (next - 1)->frame;
}

std::vector<std::string_view> whose_courses(const std::vector<RecordedCourse>& courses) {
    std::vector<std::string_view> all;
    for (const RecordedCourse& course : courses)
        if (std::ranges::find(all, course.whose) == all.end())
            all.push_back(course.whose);
    return all;
}

} // namespace overt
