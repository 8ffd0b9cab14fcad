/// The kinds of motion. How each moves is in a file of its own, motion_….cpp; how it follows from a frame's
/// number is in its comment there.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "experiment/base/kind_table.h"

namespace overt {

/// What an object, or its light, does while it is shown. Its name is in records: it stays.
enum class MotionKind : std::uint8_t {
    turn,
    still,
    observer,
    turntable,
    triangle,
    trapezoid,
    steps,
    waves,
    orbit,
    approach,
    keyframes,
    recorded,
    movie,
};

/// A row is all that the rest of the program knows of a kind.
struct MotionKindRow {
    std::string_view name;        ///< in a protocol and in records
    std::string_view explanation; ///< what it does; the end of a sentence
    /// The keys of [[motion]] that make a difference to this kind and not to all; empty behind the last.
    std::array<std::string_view, 8> keys;

    constexpr bool has_key(std::string_view key) const { return std::ranges::find(keys, key) != keys.end(); }
};

/// In the order of MotionKind.
template <>
inline constexpr auto kinds_of<MotionKind> = std::to_array<MotionKindRow>({
    {"turn", "the object turns to and fro, as a sine", {"amplitude_deg", "axis", "pivot"}},
    {"still", "the object stands", {}},
    {"observer", "the observer turns it, about the vertical from pose to pose; the light stands", {}},
    {"turntable", "it turns all the way round, at one speed", {"turns", "axis", "pivot"}},
    {"triangle",
     "to and fro at one speed, or with its ends eased",
     {"amplitude_deg", "ease", "axis", "pivot"}},
    {"trapezoid",
     "the same, with a rest at each end",
     {"amplitude_deg", "rest_share", "ease", "axis", "pivot"}},
    {"steps", "it stands at one angle after the other", {"angles_deg", "axis", "pivot"}},
    {"waves", "a sum of sines", {"waves", "axis", "pivot"}},
    {"orbit", "the camera goes round object and light, which keep to one another", {"turns"}},
    {"approach", "the object comes nearer, and goes back", {"approach_mm"}},
    {"keyframes", "it goes from place to place, by a table", {"keyframes", "between"}},
    {"recorded",
     "it turns as observers of earlier sessions turned it, refresh by refresh",
     {"recorded", "matched_by"}},
    {"movie", "nothing moves but what a picture shows: each frame is a picture of its own", {}},
});

static_assert(kind_called<MotionKind>("turn") == MotionKind::turn &&
              kind_called<MotionKind>("still") == MotionKind::still &&
              kind_called<MotionKind>("observer") == MotionKind::observer &&
              kind_called<MotionKind>("orbit") == MotionKind::orbit &&
              kind_called<MotionKind>("keyframes") == MotionKind::keyframes &&
              kind_called<MotionKind>("recorded") == MotionKind::recorded &&
              kind_called<MotionKind>("movie") == MotionKind::movie);

struct Animation;
struct AnimationFrameIndex;
struct Pose;

/// What a motion does. One for each kind, in motion_….cpp; a kind without one does not link.
struct MotionLaw {
    /// How object and light stand in a frame by the kind alone; what turns the light with any kind comes on
    /// top.
    Pose (*pose_of)(const Animation& motion, AnimationFrameIndex frame);
    /// Whether it moves anything at all.
    bool moves = true;
    /// Whether each presentation goes through the frames in the same order. Else each trial has its own, and
    /// what was shown is known by the ledger alone.
    bool has_plan = true;
};

template <MotionKind kind> const MotionLaw& motion_law();

const MotionLaw& law_of(MotionKind kind);

} // namespace overt
