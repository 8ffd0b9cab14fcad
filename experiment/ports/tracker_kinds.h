/// The kinds of eye tracker that a protocol may name. A new one is a row here and a row in the table of
/// app/rig/tracker_devices.cpp, in the same order, which says how it is made; the compiler refuses one
/// without the other. The first is the default.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace overt {

struct TrackerKindRow {
    std::string_view name;        ///< as [tracker] kind has it
    std::string_view explanation; ///< for the reference of protocols; follows the name and a colon
    bool measures_gaze = true;
};

inline constexpr TrackerKindRow tracker_kinds[] = {
    {"simulated", "measures a simulated observer, with noise and a clock of its own"},
    {"replay", "plays back the gaze of a recorded session or of an EyeLink recording (ASC)"},
    {"eyelink", "an SR Research EyeLink 1000 or later, through the vendor's library"},
    {"tobii", "a Tobii below the screen, through the vendor's library"},
    {"opengaze", "a Gazepoint, through the Open Gaze API of Gazepoint Control"},
    {"pupil", "Pupil Core glasses, through Pupil Capture"},
    {"lsl", "a stream of gaze of the Lab Streaming Layer"},
    {"hid", "a device of the HID usage page of eye trackers"},
    {"mouse", "the mouse pointer stands in for an eye"},
    {"none", "there is none, and the session is recorded without gaze", false},
};

/// Their names alone.
inline constexpr auto tracker_names = [] {
    std::array<std::string_view, std::size(tracker_kinds)> names{};
    for (std::size_t i = 0; i < names.size(); ++i)
        names[i] = tracker_kinds[i].name;
    return names;
}();

} // namespace overt
