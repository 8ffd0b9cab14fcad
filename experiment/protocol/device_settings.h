/// What else takes part in a session: boxes with buttons, and outputs that mark events for other devices.
/// Explained key by key in device_keys.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiment/base/enum_names.h"

namespace overt {

enum class ButtonBoxKind : std::uint8_t { iolab, xid, hid, cb6 };
template <>
inline constexpr auto names_of<ButtonBoxKind> = enum_names<ButtonBoxKind>("iolab", "xid", "hid", "cb6");

/// In whose hand a box lies.
enum class ButtonBoxUser : std::uint8_t { observer, experimenter };
template <> inline constexpr auto names_of<ButtonBoxUser> = enum_names<ButtonBoxUser>("observer", "operator");

/// [[button_box]]
struct ButtonBoxSettings {
    std::string id;
    ButtonBoxKind kind = ButtonBoxKind::hid;
    std::string address; ///< empty: the first of its kind
    ButtonBoxUser used_by = ButtonBoxUser::observer;
    std::vector<std::string> buttons; ///< see parse_button_meaning(); of an observer's box, empty: all go on
    bool required = true;

    bool is_operators() const { return used_by == ButtonBoxUser::experimenter; }
};

enum class MarkerOutputKind : std::uint8_t { serial, parallel, lsl, t_lock };
template <>
inline constexpr auto names_of<MarkerOutputKind> = enum_names<MarkerOutputKind>("serial", "parallel", "lsl",
                                                                                "t-lock");

/// [[marker_output]]
struct MarkerOutputSettings {
    std::string id;
    MarkerOutputKind kind = MarkerOutputKind::serial;
    std::string address; ///< of the port; empty: the first of its kind
    int baud = 115200;
    double pulse_ms = 5.0;                                          ///< 0: codes are not taken back
    std::string library;                                            ///< of lsl; empty: where the system looks
    std::vector<std::string> codes, condition_codes, refresh_codes; ///< see MarkerCodes
    /// Of t-lock, from the vertical blank of the refresh that shows a code to the outputs' edge; nothing: one
    /// refresh, as Cambridge Research Systems' psychopy-crs has it.
    std::optional<double> offset_ms;
    bool required = true;
};

} // namespace overt
