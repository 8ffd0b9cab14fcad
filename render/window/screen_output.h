/// The output of the graphics card that feeds a window's screen, as the RandR extension tells of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/window/native_window.h"

namespace overt {

/// What the server does not say is empty.
struct ScreenOutput {
    std::optional<double> refresh_hz;         ///< of the mode, from its pixel clock and totals
    std::string edid_name;                    ///< the monitor's own, from property EDID
    std::optional<std::uint32_t> connector;   ///< the kernel's number of it (property CONNECTOR_ID)
    std::optional<bool> may_vary_its_refresh; ///< property vrr_capable: the screen waits for late pictures
    /// The outputs of the same X screen that show something with a refresh of their own: "DP-2".
    std::vector<std::string> neighbours;
};

/// Asks the server over a connection of its own. Never throws.
ScreenOutput examine_output(const NativeWindow& window);

} // namespace overt
