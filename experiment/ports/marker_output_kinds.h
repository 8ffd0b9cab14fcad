/// The kinds of output of markers that a protocol may name. A new one is a row here, and a
/// marker_device_of() of its name beside its driver (devices/triggers/marker_device.h). The first is the
/// default.
#pragma once

#include <cstdint>

#include "experiment/base/kind_table.h"

namespace overt {

struct MarkerOutputKindRow {
    std::string_view name;        ///< as [[marker_output]] kind has it
    std::string_view explanation; ///< for the reference of protocols; follows the name and a colon
    int largest_code = 255;       ///< of a byte
    bool has_address = false;
    std::string_view needs_address{}; ///< such as this one; empty: it is found without
    bool has_speed = false;           ///< `baud`
    std::string_view library{};       ///< as vendor_libraries has it; empty: it needs none
    std::string_view usual_address{}; ///< in words: what is opened where a protocol names no address
    bool tells_texts = false;         ///< all of them, and no codes
    bool rides_on_picture = false;    ///< the picture raises it at the refresh that it marks; nothing is sent
};

enum class MarkerOutputKind : std::uint8_t {};

template <>
inline constexpr auto kinds_of<MarkerOutputKind> = std::to_array<MarkerOutputKindRow>({
    {.name = "serial",
     .explanation = "a byte to a serial port",
     .has_address = true,
     .needs_address = "/dev/ttyUSB0",
     .has_speed = true},
    {.name = "parallel",
     .explanation = "a byte on the data lines of a parallel port",
     .has_address = true,
     .usual_address = "/dev/parport0"},
    {.name = "xid",
     .explanation = "a Cedrus StimTracker or c-pod, or the outputs of another XID device",
     .has_address = true,
     .usual_address = "the first such device among the serial ports and USB devices"},
    {.name = "lsl",
     .explanation = "a text in the stream `overt` of the Lab Streaming Layer",
     .library = "lsl",
     .usual_address = "a stream that anyone in the local network can read",
     .tells_texts = true},
    {.name = "t-lock",
     .explanation =
         "the digital outputs of the Display++ or Bits#, raised by the picture itself at the refresh "
         "that it marks",
     .largest_code = 1023, // ten digital outputs
     .rides_on_picture = true},
});

} // namespace overt
