#include "app/rig/button_boxes.h"

#include <algorithm>

#include <fmt/format.h>

#include "devices/buttons/button_box_panel.h"
#include "devices/buttons/cb6_box.h"
#include "devices/buttons/hid_button_box.h"
#include "devices/buttons/iolab_box.h"
#include "devices/buttons/xid_box.h"
#include "devices/hid/hid_driver.h"
#include "devices/link/serial_port_search.h"
#include "devices/usb/serial_line.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

bool is_iolab(const HidDeviceInfo& device) {
    return device.vendor_id == iolab_vendor_id && device.product_id == iolab_product_id;
}

/// By path, by vendor and product, or the first ioLab box.
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

/// The first port behind a chip that Cedrus uses, or the first such chip that has no port.
std::string xid_port(const ButtonBoxSettings& box) {
    if (!box.address.empty())
        return box.address;
    for (const SerialPortInfo& port : serial_ports("/dev", "/sys", "ttyUSB"))
        if (port.vendor_id == ftdi_vendor_id)
            return port.path;
    for (const FtdiChip& chip : ftdi_chips())
        if (!chip.has_tty)
            return chip.address();
    throw DeviceError(
        "No USB serial port (/dev/ttyUSB*) and no chip without one is such as boxes of Cedrus have: is the "
        "box plugged in? Name its port with address.");
}

std::unique_ptr<ButtonBox> open_button_box(const ButtonBoxSettings& box, Clock& clock) {
    if (box.kind == ButtonBoxKind::xid)
        return std::make_unique<XidBox>(
            xid_port(box),
            [&clock](const std::string& port, int baud) { return open_serial_line(port, clock, baud); },
            clock);
    const HidDeviceInfo device = find_hid_box(box);
    if (box.kind == ButtonBoxKind::iolab)
        return std::make_unique<IolabBox>(open_hid(device.path, clock), clock);
    return std::make_unique<HidButtonBox>(open_hid(device.path, clock),
                                          parse_report_descriptor(hid_descriptor_of(device.path)),
                                          describe(device), clock);
}

std::unique_ptr<ThreadedButtonBox> start(const ButtonBoxSettings& box, Clock& clock,
                                         DisplayPlusPlus* display_box) {
    using ReadOn = ThreadedButtonBox::ReadOn;
    if (box.kind != ButtonBoxKind::cb6)
        return std::make_unique<ThreadedButtonBox>([box, &clock] { return open_button_box(box, clock); },
                                                   clock);
    if (!display_box)
        throw DeviceError(
            "a CB6 is read through the Display++ or Bits#, which this session does not use: it has "
            "no real screen in real time");
    return std::make_unique<ThreadedButtonBox>(
        [display_box, &clock] { return std::make_unique<Cb6Box>(*display_box, clock); }, clock,
        ReadOn::sessions_thread);
}

} // namespace

std::unique_ptr<ResponsePanel> make_button_boxes(const Protocol& protocol, Clock& clock,
                                                 ResponsePanel* answering, DisplayPlusPlus* display_box,
                                                 const std::function<void(const std::string&)>& tell) {
    std::vector<BoxInHand> boxes;
    for (const ButtonBoxSettings& settings : protocol.button_boxes) {
        BoxInHand box{settings.id, settings.is_operators(), {}, nullptr};
        for (const std::string& meaning : settings.buttons)
            box.meanings.push_back(parse_button_meaning(meaning, box.is_operators));
        try {
            box.box = start(settings, clock, display_box);
        } catch (const DeviceError& error) {
            if (settings.required)
                throw DeviceError(
                    fmt::format("[[button_box]] \"{}\": {} The protocol requires it: required = "
                                "false would let a session go on without it.",
                                settings.id, error.what()));
            tell(fmt::format("the response box \"{}\" is left out: {}", settings.id, error.what()));
            continue;
        }
        boxes.push_back(std::move(box));
    }
    if (boxes.empty())
        return nullptr;
    return std::make_unique<ButtonBoxPanel>(std::move(boxes), clock, answering, tell);
}

std::vector<std::string> button_box_overview() {
    std::vector<std::string> lines;
    try {
        for (const HidDeviceInfo& device : hid_devices()) {
            try {
                const HidDescriptor descriptor = parse_report_descriptor(hid_descriptor_of(device.path));
                if (is_iolab(device))
                    lines.push_back(fmt::format("{}: kind iolab", describe(device)));
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
    for (const SerialPortInfo& port : serial_ports("/dev", "/sys", "ttyUSB"))
        lines.push_back(fmt::format(
            "{}: a serial line{}", describe(port),
            port.vendor_id == ftdi_vendor_id ? ", of kind xid if it is a box of Cedrus; not asked" : ""));
    try {
        for (const FtdiChip& chip : ftdi_chips())
            if (!chip.has_tty)
                lines.push_back(fmt::format("{}: a serial chip without a port, address {}; not asked",
                                            describe(chip), chip.address()));
    } catch (const Error& error) {
        lines.emplace_back(error.what());
    }
    if (lines.empty())
        lines.emplace_back("none that could be one (HID devices with buttons, /dev/ttyUSB*)");
    return lines;
}

} // namespace overt
