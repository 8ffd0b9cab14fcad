/// What a refresh costs this machine, by a short probe, before anybody sits down.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/check/rig_forecast.h"
#include "experiment/protocol/protocol.h"
#include "experiment/stimulus/object.h"
#include "render/gl/gl_context.h"

namespace overt {

struct FrameCost {
    int flips = 0;                                    ///< that were timed, each to another page
    double median_flip_ms = 0.0, worst_flip_ms = 0.0; ///< with the copy
    double copy_ms = 0.0;                             ///< of the whole screen into the window, at the median
    double page_ms = 0.0;                             ///< packing and uploading one page
    std::optional<double> worst_map_ms; ///< drawing and reading a hidden map; nothing without a mesh
};

/// Plays pages of the protocol's size in its output mode on a display that only keeps time, copies each
/// screen as into a window, and draws a hidden map of each object. Takes about half a second in software.
/// With `context` current. Throws GraphicsError.
FrameCost measure_frame_cost(const GlContext& context, const Protocol& protocol,
                             std::span<const Object> objects);

/// In words, and what to do if a refresh is too short for it.
std::vector<ForecastLine> forecast_of(const FrameCost& cost, const Protocol& protocol,
                                      const GlDescription& graphics);

nlohmann::ordered_json to_json(const FrameCost& cost);

} // namespace overt
