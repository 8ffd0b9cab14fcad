/// How an output of markers of a kind is opened. Beside the driver of each kind of
/// experiment/ports/marker_output_kinds.h stands
///     template <> MarkerDevice marker_device_of<kind_called<MarkerOutputKind>("its name")>() { … }
/// without which the program is not linked: the linker names the row's number, from 0. What rides on the
/// picture has none.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "devices/triggers/marker_output.h"
#include "experiment/ports/clock.h"
#include "experiment/protocol/device_settings.h"

namespace overt {

/// What an output can be opened from. The clock must outlive it.
struct MarkerParts {
    const MarkerOutputSettings& settings;
    Clock& clock;
    const std::string& session; ///< tells streams of several sessions apart
};

struct MarkerDevice {
    /// Throws DeviceError for an output that cannot be had.
    std::unique_ptr<MarkerOutput> (*open)(const MarkerParts& parts) = nullptr;
    /// Lines for an overview of the machine: ports that markers could be sent to. Opens none. Null: those of
    /// another kind have these, too.
    std::vector<std::string> (*look_for)() = nullptr;
};

template <MarkerOutputKind kind> MarkerDevice marker_device_of();

} // namespace overt
