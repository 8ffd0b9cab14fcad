/// `overt doctor --photodiode`: how long after its vertical blank a screen's light comes.
#pragma once

#include <string>

#include "app/display/display_commands.h"
#include "devices/light/light_sensor.h"

namespace overt {

/// What a sensor before the screen saw.
struct MeasuredLight {
    std::string source; ///< of the flips' times
    int changes = 0;    ///< of the square
    LightLatency found; ///< nothing was seen, of no sensor

    bool is_whole() const { return found.matched > 0 && found.unseen == 0; }
};

/// Shows a square in the top left corner that changes every six refreshes, and compares what a sensor before
/// it saw with the times of the flips. Throws DeviceError for a sensor that is not there.
MeasuredLight measure_light(const DoctorOptions& options);

/// The same, and prints it; 1 if the sensor missed a change.
int run_photodiode_doctor(const DoctorOptions& options);

} // namespace overt
