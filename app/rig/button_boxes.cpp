#include "app/rig/button_boxes.h"

#include <fmt/format.h>

#include "devices/buttons/button_box_device.h"
#include "devices/buttons/button_box_panel.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

/// In the order of their kinds.
const auto button_box_devices =
    for_each_kind<ButtonBoxKind>([]<ButtonBoxKind kind> { return button_box_device_of<kind>(); });

std::unique_ptr<ThreadedButtonBox> start_box(const ButtonBoxParts& parts) {
    using ReadOn = ThreadedButtonBox::ReadOn;
    const ButtonBoxDevice& device = button_box_devices[static_cast<std::size_t>(parts.settings.kind)];
    return std::make_unique<ThreadedButtonBox>(
        [parts, &device] { return device.open(parts); }, parts.clock,
        row_of(parts.settings.kind).is_read_by_display_box ? ReadOn::sessions_thread : ReadOn::own_thread);
}

} // namespace

std::unique_ptr<ThreadedButtonBox> open_button_box(const ButtonBoxSettings& settings, Clock& clock,
                                                   DisplayPlusPlus* display_box) {
    return start_box({settings, clock, display_box});
}

std::unique_ptr<ResponsePanel> make_button_boxes(const Protocol& protocol, Clock& clock,
                                                 ResponsePanel* answering, DisplayPlusPlus* display_box,
                                                 const std::function<void(const std::string&)>& tell) {
    std::vector<BoxInHand> boxes;
    for (const ButtonBoxSettings& settings : protocol.button_boxes) {
        BoxInHand box{settings.id, settings.is_operators(), {}, nullptr};
        for (const std::string& meaning : settings.buttons)
            box.meanings.push_back(parse_button_meaning(meaning, box.is_operators));
        try {
            box.box = open_button_box(settings, clock, display_box);
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
    for (const ButtonBoxDevice& device : button_box_devices)
        if (device.look_for)
            for (std::string& line : device.look_for())
                lines.push_back(std::move(line));
    if (lines.empty())
        lines.emplace_back("none that could be one (HID devices with buttons, /dev/ttyUSB*)");
    return lines;
}

} // namespace overt
