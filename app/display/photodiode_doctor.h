/// `overt doctor --photodiode`: how long after its vertical blank a screen's light comes.
#pragma once

#include "app/display/display_commands.h"

namespace overt {

/// Shows a square in the top left corner that changes every six refreshes, and compares what a sensor before
/// it saw with the times of the flips; 1 if the sensor missed a change. Throws DeviceError for a sensor that
/// is not there.
int run_photodiode_doctor(const DoctorOptions& options);

} // namespace overt
