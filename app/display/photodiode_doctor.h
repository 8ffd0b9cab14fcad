/// `overt doctor --photodiode`: how long after its vertical blank a screen's light comes.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "app/display/display_commands.h"
#include "devices/display_box/display_plus_plus.h"
#include "devices/light/light_sensor.h"
#include "render/gl/gl_context.h"
#include "render/window/window_context.h"

namespace overt {

/// What a sensor before the screen saw.
struct MeasuredLight {
    std::string source;   ///< of the flips' times
    std::string mode;     ///< in which it was packed, as a protocol names it
    bool is_real = false; ///< a screen lit it; else the display only kept time
    GlDescription graphics;
    std::optional<MonitorInfo> monitor;     ///< nothing: there is no screen
    std::optional<BoxIdentity> display_box; ///< that it went through
    int changes = 0;                        ///< of the square
    double scan_ms = 0.0; ///< that the rows above the square take, borders of the signal left out
    LightLatency found;   ///< nothing was seen, of no sensor

    /// From the vertical blank to the light of the screen's first row: what [display] latency_ms is.
    double first_row_ms() const { return found.mean_ms - scan_ms; }
    bool is_whole() const { return found.matched > 0 && found.unseen == 0; }
};

/// Shows a square that changes every six refreshes, and compares what a sensor before it saw with the times
/// of the flips. The square goes the way of a stimulus: through the session's presenter, in the mode, on the
/// screen and through the display box of options.protocol, in the corner that it names; without a protocol in
/// 8 bits, in the top left corner. Throws DeviceError for a sensor or a box that is not there, InputError or
/// GraphicsError where a session of the protocol would be refused for its screen.
MeasuredLight measure_light(const DoctorOptions& options);

/// The same with a sensor that is made once the display and its box are open, which must be there as long as
/// it is: `box` is null if there is none. No sensor: changes are shown and compared with nothing.
using SensorOpener = std::function<std::unique_ptr<LightSensor>(Clock& clock, DisplayPlusPlus* box)>;
MeasuredLight measure_light(const DoctorOptions& options, const SensorOpener& open_sensor);

/// The same, and prints it; 1 if the sensor missed a change.
int run_photodiode_doctor(const DoctorOptions& options);

} // namespace overt
