/// How fast stimuli come from disk that do not fit into the frame store.
#pragma once

#include <optional>
#include <string>

#include "app/check/rig_forecast.h"
#include "experiment/base/diagnostics.h"
#include "render/stimulus/stimulus_library.h"

namespace overt {

struct StreamingCost {
    std::string stimulus; ///< its name, of those with most pictures a second
    double needed_hz = 0.0;
    /// Pictures that arrived a second, at the slowest of a few stretches; nothing while they are not
    /// rendered.
    std::optional<double> found_hz;
    double disk_mb_s = 0.0; ///< what the disk has to give for needed_hz; meaningless without found_hz
    bool is_enough() const;
};

/// Shows part of such a stimulus as fast as it comes, on a display that only keeps time. The system is asked
/// beforehand to forget what it has of the files in memory, so that they come from the disk. Nothing if all
/// stimuli fit. With the context of `library` current. Throws as the library does.
std::optional<StreamingCost> measure_streaming(const GlContext& context, const Protocol& protocol,
                                               StimulusLibrary& library);

/// Warns at the key of the frame store if they come too slowly.
void check_streaming(const StreamingCost& cost, const Protocol& protocol, Diagnostics& diagnostics);

ForecastLine forecast_of(const StreamingCost& cost);
nlohmann::ordered_json to_json(const StreamingCost& cost);

} // namespace overt
