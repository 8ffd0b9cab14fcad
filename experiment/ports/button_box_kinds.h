/// The kinds of response box that a protocol may name. A new one is a row here, and a button_box_device_of()
/// of its name beside its driver (devices/buttons/button_box_device.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "experiment/base/kind_table.h"

namespace overt {

struct ButtonBoxKindRow {
    std::string_view name;               ///< as [[button_box]] kind has it
    std::string_view explanation;        ///< for the reference of protocols; follows the name and a colon
    std::string_view needs_address{};    ///< what the address of one must be; empty: the first is found
    bool is_read_by_display_box = false; ///< it shares the line of the Display++ or Bits#
    std::string_view usual_address{};    ///< in words: what is opened where a protocol names no address
    /// The keys of [[button_box]] that make a difference to this kind and not to all; empty behind the last.
    std::array<std::string_view, 3> keys{};

    constexpr bool has_key(std::string_view key) const { return std::ranges::find(keys, key) != keys.end(); }
};

enum class ButtonBoxKind : std::uint8_t {};

template <>
inline constexpr auto kinds_of<ButtonBoxKind> = std::to_array<ButtonBoxKindRow>({
    {.name = "iolab",
     .explanation = "the ioLab box",
     .usual_address = "the first such box among /dev/hidraw*"},
    {.name = "xid",
     .explanation = "boxes of Cedrus that speak XID",
     .usual_address = "the first such box among the serial ports and USB devices"},
    {"hid", "game pads, joysticks and boxes that present themselves as keyboards",
     "vendor:product as lsusb shows them, or /dev/hidrawN; overt doctor lists them"},
    {.name = "cb6",
     .explanation = "the infrared box and the digital inputs of the Display++ or Bits# of `[display]`",
     .is_read_by_display_box = true,
     .usual_address = "the line of the display box"},
    {.name = "dial",
     .explanation =
         "knobs that present themselves as HID dials or wheels, with their buttons: for matches and "
         "objects that are turned",
     .needs_address = "vendor:product as lsusb shows them, or /dev/hidrawN; overt doctor lists them",
     .keys = {"steps_per_count"}},
    {.name = "spacemouse",
     .explanation = "3D mice of 3Dconnexion, which turn by their twist and tilt by their pitch, with their "
                    "buttons",
     .usual_address = "the first such device among /dev/hidraw*",
     .keys = {"full_turn_steps_s", "full_tilt_steps_s", "dead_zone"}},
});

} // namespace overt
