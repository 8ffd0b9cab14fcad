/// The place on the object that an observer pointed at.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "experiment/analysis/flip_history.h"
#include "experiment/analysis/pointed_place.h"
#include "experiment/record/read/session_record.h"

namespace overt {

/// Kind of an answer that is a place, as GivenAnswer::kind has it.
inline constexpr std::string_view point_kind = "point";

/// The value of such an answer, "120.500 -30.000": right and down from the middle of the screen, in pixels.
/// Nothing if it is no such value.
std::optional<glm::dvec2> read_pointed_px(std::string_view value);

struct PointedAnswer {
    std::string slot;                    ///< in whose image the place lies
    glm::dvec2 image_px{0.0};            ///< continuous, from its top left corner
    std::optional<LitFrame> shown;       ///< the frame that was lit there then; nothing: none was
    std::optional<SurfacePoint> surface; ///< nothing beside the object, or without a map
    std::string part;                    ///< of the surface
    /// Of the pixel that was pointed at; nothing where maps were given without a mesh.
    std::optional<SurfaceFootprint> footprint;
};

/// A place that was pointed at, and how exactly.
struct PointedPlace {
    ScreenPoint at;
    SessionTime when;
    std::optional<glm::dmat2> covariance_px = {}; ///< in the picture (pointed_place.h); nothing: not known
};

/// Where it lies in the slot of `seen` (TrialRecord::seen_in); nothing outside of the slot's image. `lookup`:
/// of the object shown there; null: no surface. The frame is the one lit at that row then.
std::optional<PointedAnswer> pointed_answer(const SessionHeader& header, const TrialRecord& seen,
                                            const FlipHistory& history, const SurfaceLookup* lookup,
                                            const PointedPlace& place);

/// Where the answer lies in the slot of `seen` (TrialRecord::seen_in); nothing for an answer of another kind,
/// one that was missed, or a place outside of the slot's image. `lookup`: of the object shown there; null: no
/// surface. The frame is the one lit at the row when the button was found pressed.
std::optional<PointedAnswer> pointed_answer(const SessionHeader& header, const TrialRecord& seen,
                                            const FlipHistory& history, const SurfaceLookup* lookup,
                                            const GivenAnswer& given);

} // namespace overt
