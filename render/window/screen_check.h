/// What on the way from the graphics card to the screen can change a signal that was right when it was
/// written.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiment/protocol/protocol.h"
#include "render/window/signal_settings.h"
#include "render/window/window_context.h"
#include "render/window/window_system.h"

namespace overt {

/// What is known of a window's screen.
struct ScreenFacts {
    WindowSystem system;
    MonitorInfo monitor;
    GammaRamp gamma_ramp;
    glm::ivec2 window_size{0};    ///< in the desktop's units
    glm::ivec2 framebuffer_px{0}; ///< in pixels
    int bits_per_channel = 8;
    bool is_fullscreen = false;
    std::vector<SignalSetting> signal = {}; ///< empty: the driver tells none
};
ScreenFacts facts_of(const WindowContext& window);

/// Of a window that would fill the monitor, in the depth it asks for: what can be known without opening one.
ScreenFacts facts_at(const MonitorInfo& monitor, int bits_per_channel = 8);

struct ScreenFinding {
    enum class Weight : std::uint8_t {
        good,
        risk,    ///< cannot be proved harmless from here
        refusal, ///< what is shown would not be what the protocol says
    };
    Weight weight = Weight::good;
    std::string what, finding;
};

/// Of settings that the driver applies to the bytes in the cable, one for each. What changes them is refused
/// where the bytes are packed and a risk elsewhere; so is it that nothing is known of them where they are
/// packed. `output`: MonitorInfo::name.
std::vector<ScreenFinding> judge_signal(std::span<const SignalSetting> settings, OutputMode mode,
                                        const std::string& output);

/// Weighs the facts for a session in real time with this display. One finding for each thing looked at.
std::vector<ScreenFinding> judge_screen(const ScreenFacts& facts, const DisplaySettings& display);

/// Whether each value of a channel leaves as itself, in the table's own depth (256 entries: 8 bits). In the
/// 16 bits of an entry, drivers write the others as zeros or repeat the first.
bool is_identity(const std::vector<std::uint16_t>& ramp);
/// Of all channels, with nothing reckoned in besides.
bool is_identity(const GammaRamp& ramp);

/// "the gamma table is the identity", or which channel first changes what; "cannot be read".
std::string describe(const GammaRamp& ramp);

/// Throws GraphicsError with all refusals, if there is one.
void refuse_unfit_screen(const std::vector<ScreenFinding>& findings);

} // namespace overt
