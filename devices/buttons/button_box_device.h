/// How a response box of a kind is opened. Beside the driver of each kind of
/// experiment/ports/button_box_kinds.h stands
///     template <> ButtonBoxDevice button_box_device_of<kind_called<ButtonBoxKind>("its name")>() { … }
/// without which the program is not linked: the linker names the row's number, from 0.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiment/ports/button_box.h"
#include "experiment/ports/clock.h"
#include "experiment/protocol/device_settings.h"

namespace overt {

class DisplayPlusPlus;

/// What a box can be opened from. The clock and the display box must outlive it.
struct ButtonBoxParts {
    ButtonBoxSettings settings;
    Clock& clock;
    DisplayPlusPlus* display_box; ///< of the session; null if there is none
};

struct ButtonBoxDevice {
    /// Throws DeviceError for a box that cannot be had, InputError for an address that is none.
    std::unique_ptr<ButtonBox> (*open)(const ButtonBoxParts& parts) = nullptr;
    /// Lines for an overview of the machine: devices that could be such boxes. Opens none. Null: those of
    /// another kind have these, too.
    std::vector<std::string> (*look_for)() = nullptr;
};

template <ButtonBoxKind kind> ButtonBoxDevice button_box_device_of();

} // namespace overt
