/// A key or button that was pressed in a trial or between trials, as the record keeps it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "experiment/ports/session_phase.h"
#include "experiment/session_time.h"

namespace overt {

/// Devices of key presses that are no response boxes, which the protocol names.
inline constexpr std::string_view keyboard_device = "keyboard";
inline constexpr std::string_view mouse_device = "mouse"; ///< of what is told of it, see ObserverInput
inline constexpr std::string_view simulated_observer_device = "simulated observer";

struct RecordedKeyPress {
    SessionTime at;
    SessionDuration uncertainty{}; ///< at a keyboard, the press came so long before `at` at most; at a box, ±
    int trial = -1;                ///< -1: in practice, and between trials
    std::string device;            ///< one of the above, or the box as the protocol calls it
    std::string name;              ///< what is written on it, as "7" or "enter"; "scancode 93" if unknown
    std::optional<int> code = {};  ///< of a keyboard the scancode, of a box the button's number
    std::string modifiers = {};    ///< held with it, as "shift" or "control+alt"; empty: none
    std::string text = {};         ///< that it wrote (UTF-8); empty: none
    SessionPhase screen = SessionPhase::response_screen; ///< what stood on the screen
    std::string meaning = {};                            ///< what it did to the session; empty: nothing
    int sitting = 1;                                     ///< of one that was read
    std::optional<std::int64_t> attempt_id = {};         ///< of one that was read: the attempt's id
};

/// Boxes have rows of their buttons' changes besides.
inline bool is_of_box(const RecordedKeyPress& press) {
    return press.device != keyboard_device && press.device != simulated_observer_device;
}

} // namespace overt
