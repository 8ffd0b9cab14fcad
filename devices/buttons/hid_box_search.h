/// Which of the system's HID devices is a response box.
#pragma once

#include <string>
#include <vector>

#include "devices/hid/hid_line.h"
#include "experiment/protocol/device_settings.h"

namespace overt {

/// By path, by vendor and product, or the first ioLab box. Throws DeviceError if it is not plugged in,
/// InputError for an address that is none.
HidDeviceInfo find_hid_box(const ButtonBoxSettings& box);

/// A line for each device that could be one, of kind iolab or hid. Opens none.
std::vector<std::string> hid_boxes_found();

} // namespace overt
