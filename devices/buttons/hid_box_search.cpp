#include "devices/buttons/hid_box_search.h"

#include <algorithm>

#include <fmt/format.h>

#include "devices/buttons/hid_button_box.h"
#include "devices/buttons/hid_knob.h"
#include "devices/buttons/iolab_box.h"
#include "devices/hid/hid_driver.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

bool is_iolab(const HidDeviceInfo& device) {
    return device.vendor_id == iolab_vendor_id && device.product_id == iolab_product_id;
}

} // namespace

HidDeviceInfo find_hid_box(const ButtonBoxSettings& box) {
    const auto numbers = hid_numbers(box.address);
    if (!box.address.empty() && !box.address.starts_with('/') && !numbers)
        throw InputError(fmt::format("[[button_box]] \"{}\": \"{}\" is no HID device: write a path such as "
                                     "/dev/hidraw0, or vendor and product such as 19bc:0001",
                                     box.id, box.address));
    const std::vector<HidDeviceInfo> devices = hid_devices();
    const auto is_it = [&](const HidDeviceInfo& device) {
        if (box.address.empty())
            return is_iolab(device);
        return numbers ? std::pair(device.vendor_id, device.product_id) == *numbers
                       : device.path == box.address;
    };
    if (const auto found = std::ranges::find_if(devices, is_it); found != devices.end())
        return *found;
    std::string there;
    for (const HidDeviceInfo& device : devices)
        there += (there.empty() ? "" : ", ") + describe(device);
    throw DeviceError(fmt::format("{} is plugged in. HID devices that are: {}.",
                                  box.address.empty() ? std::string("No ioLab box")
                                                      : fmt::format("No HID device {}", box.address),
                                  there.empty() ? "none" : there));
}

std::vector<std::string> hid_boxes_found() {
    std::vector<std::string> lines;
    try {
        for (const HidDeviceInfo& device : hid_devices()) {
            try {
                const HidDescriptor descriptor = parse_report_descriptor(hid_descriptor_of(device.path));
                if (is_iolab(device))
                    lines.push_back(fmt::format("{}: kind iolab", describe(device)));
                else if (is_spacemouse(device))
                    lines.push_back(fmt::format("{}: kind spacemouse", describe(device)));
                else if (is_dial(descriptor))
                    lines.push_back(fmt::format("{}: kind dial, address {:04x}:{:04x}", describe(device),
                                                device.vendor_id, device.product_id));
                else if (HidButtons(descriptor).has_any())
                    lines.push_back(fmt::format("{}: kind hid, address {:04x}:{:04x}", describe(device),
                                                device.vendor_id, device.product_id));
            } catch (const Error& error) {
                lines.push_back(fmt::format("{}: {}", describe(device), error.what()));
            }
        }
    } catch (const Error& error) {
        lines.emplace_back(error.what());
    }
    return lines;
}

} // namespace overt
