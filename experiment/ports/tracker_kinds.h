/// The kinds of eye tracker that a protocol may name. A new one is a row here, and a tracker_device_of() of
/// its name beside its driver (devices/tracker/tracker_device.h). The first is the default.
#pragma once

#include <cstdint>

#include "experiment/base/kind_table.h"

namespace overt {

struct TrackerKindRow {
    std::string_view name;        ///< as [tracker] kind has it
    std::string_view explanation; ///< for the reference of protocols; follows the name and a colon
    bool is_made_up = false;      ///< gaze is simulated or played back: each is a device of its own
    bool measures_gaze = true;
    std::string_view library{};       ///< of its maker, as vendor_libraries has it; empty: it needs none
    std::string_view usual_address{}; ///< in words: what is opened where a protocol names no address

    /// Measures in real time only.
    constexpr bool is_hardware() const { return measures_gaze && !is_made_up; }
};

enum class TrackerKind : std::uint8_t {};

template <>
inline constexpr auto kinds_of<TrackerKind> = std::to_array<TrackerKindRow>({
    {"simulated", "measures a simulated observer, with noise and a clock of its own", true},
    {"replay", "plays back the gaze of a recorded session or of an EyeLink recording (ASC)", true},
    {.name = "eyelink",
     .explanation = "an SR Research EyeLink 1000 or later, through the vendor's library",
     .library = "eyelink",
     .usual_address = "the network address 100.1.1.1"},
    {.name = "tobii",
     .explanation = "a Tobii below the screen, through the vendor's library",
     .library = "tobii",
     .usual_address = "the tracker that its library finds, at USB or in the network"},
    {.name = "opengaze",
     .explanation = "a Gazepoint, through the Open Gaze API of Gazepoint Control",
     .usual_address = "the network address 127.0.0.1:4242"},
    {.name = "pupil",
     .explanation = "Pupil Core glasses, through Pupil Capture",
     .usual_address = "the network address 127.0.0.1:50020"},
    {.name = "lsl",
     .explanation = "a stream of gaze of the Lab Streaming Layer",
     .library = "lsl",
     .usual_address = "the first stream of gaze in the local network"},
    {.name = "hid",
     .explanation = "a device of the HID usage page of eye trackers",
     .usual_address = "the first such device among /dev/hidraw*"},
    {.name = "mouse",
     .explanation = "the mouse pointer stands in for an eye",
     .usual_address = "the mouse, through the X server"},
    {"none", "there is none, and the session is recorded without gaze", false, false},
});

/// The kind that is called so. Throws InputError naming those there are.
TrackerKind tracker_kind_called(std::string_view name);

} // namespace overt
