#include "experiment/protocol/protocol_keys.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/ports/tracker_kinds.h"
#include "experiment/protocol/key_rows.h"

namespace overt {

const ProtocolSections& protocol_sections() {
    static const ProtocolSections sections{
        key_rows::protocol(),  key_rows::display(),  key_rows::tracker(),      key_rows::view(),
        key_rows::light(),     key_rows::bake(),     key_rows::animation(),    key_rows::schedule(),
        key_rows::screens(),   key_rows::consent(),  key_rows::instructions(), key_rows::observer_fields(),
        key_rows::operators(), key_rows::answers(),  key_rows::task(),         key_rows::block(),
        key_rows::group(),     key_rows::practice(), key_rows::breaks(),       key_rows::repeat(),
        key_rows::sculpture(), key_rows::material(), key_rows::frames(),       key_rows::words(),
        key_rows::dataset()};
    return sections;
}

std::string_view name_of(Dithering dithering) { return key_rows::ditherings[static_cast<int>(dithering)]; }
std::string_view name_of(PairFilter filter) { return key_rows::pair_filters[static_cast<int>(filter)]; }
std::string_view name_of(PatchCorner corner) { return key_rows::patch_corners[static_cast<int>(corner)]; }
std::string_view name_of(TrackerKind kind) { return tracker_names[static_cast<std::size_t>(kind)]; }
std::string_view name_of(Playback playback) { return key_rows::playbacks[static_cast<int>(playback)]; }
std::string_view name_of(WhenLate when_late) { return key_rows::when_lates[static_cast<int>(when_late)]; }
std::string_view name_of(TaskCoverage coverage) {
    return key_rows::task_coverages[static_cast<int>(coverage)];
}
std::string_view name_of(OrderMethod method) { return key_rows::order_methods[static_cast<int>(method)]; }
std::string_view name_of(TrialFactor factor) { return key_rows::trial_factors[static_cast<int>(factor)]; }
std::string_view name_of(LevelOrder order) { return key_rows::level_orders[static_cast<int>(order)]; }
std::string_view name_of(FrameEncoding encoding) {
    return key_rows::frame_encodings[static_cast<int>(encoding)];
}
std::string_view name_of(FrameColours colours) { return key_rows::frame_colours[static_cast<int>(colours)]; }
std::string_view name_of(BakeQuality quality) { return key_rows::bake_qualities[static_cast<int>(quality)]; }
std::string_view name_of(PixelFilter filter) { return key_rows::pixel_filters[static_cast<int>(filter)]; }
std::string_view name_of(StandardObserver observer) {
    return key_rows::standard_observers[static_cast<int>(observer)];
}

std::string range_text(const KeyRule& rule) {
    const std::string unit = rule.unit.empty() ? "" : fmt::format(" {}", rule.unit);
    if (std::isfinite(rule.low) && std::isfinite(rule.high))
        return fmt::format("{} … {}{}", rule.low, rule.high, unit);
    if (std::isfinite(rule.low))
        return fmt::format("at least {}{}", rule.low, unit);
    if (std::isfinite(rule.high))
        return fmt::format("at most {}{}", rule.high, unit);
    return {};
}

std::string expected_text(const KeyRule& rule, std::string_view noun) {
    if (rule.choices.size() == 1)
        return fmt::format("\"{}\"", rule.choices.front());
    if (!rule.choices.empty())
        return fmt::format("one of \"{}\"", fmt::join(rule.choices, "\", \""));
    if (!rule.unit.empty())
        return fmt::format("{} of {}", noun, rule.unit);
    return std::string(noun);
}

} // namespace overt
