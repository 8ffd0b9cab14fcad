/// What else takes part in a session: boxes with buttons, and outputs that mark events for other devices.
/// Explained key by key in device_keys.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiment/ports/button_box_kinds.h"
#include "experiment/ports/marker_output_kinds.h"

namespace overt {

/// In whose hand a box lies.
enum class ButtonBoxUser : std::uint8_t { observer, experimenter };
template <> inline constexpr auto names_of<ButtonBoxUser> = enum_names<ButtonBoxUser>("observer", "operator");

/// [[button_box]]
struct ButtonBoxSettings {
    std::string id;
    ButtonBoxKind kind = kind_called<ButtonBoxKind>("hid");
    std::string address; ///< empty: the first of its kind
    ButtonBoxUser used_by = ButtonBoxUser::observer;
    std::vector<std::string> buttons; ///< see parse_button_meaning(); of an observer's box, empty: all go on
    bool required = true;
    double steps_per_count = 1.0; ///< of `dial`; < 0: the other way round
    // Of `spacemouse`: steps in a second as far as it goes, which as far again is the other way round below
    // 0; and the share of its way that is none yet.
    double full_turn_steps_s = 30.0, full_tilt_steps_s = 30.0;
    double dead_zone = 0.1;

    bool is_operators() const { return used_by == ButtonBoxUser::experimenter; }
};

/// [[marker_output]]
struct MarkerOutputSettings {
    std::string id;
    MarkerOutputKind kind{}; ///< the first: serial
    std::string address;     ///< of the port; empty: the first of its kind
    int baud = 115200;
    bool as_text = false;  ///< of serial: codes in figures, or without codes the texts, a line each
    double pulse_ms = 5.0; ///< 0: codes are not taken back
    std::vector<std::string> codes, condition_codes, refresh_codes; ///< see MarkerCodes
    /// Of t-lock, from the vertical blank of the refresh that shows a code to the outputs' edge; nothing: one
    /// refresh, as Cambridge Research Systems' psychopy-crs has it.
    std::optional<double> offset_ms;
    bool required = true;
};

} // namespace overt
