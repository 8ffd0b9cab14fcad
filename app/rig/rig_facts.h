/// What a rig is made of, in words: what has to be the same for a measurement of it to hold.
#pragma once

#include <string>
#include <vector>

#include "experiment/ports/eye_tracker.h"
#include "experiment/protocol/protocol.h"
#include "render/gl/gl_context.h"
#include "render/window/window_context.h"

namespace overt {

/// Such as "the eye tracker" and "eyelink".
struct RigFact {
    std::string what, is;
    bool operator==(const RigFact&) const = default;
};
/// Each `what` once.
using RigFacts = std::vector<RigFact>;

// Those that a protocol and the machine tell.
inline constexpr const char* machine_fact = "the machine";
inline constexpr const char* screen_fact = "the screen"; ///< its size and rate
inline constexpr const char* output_fact = "the output mode";
inline constexpr const char* tracker_fact = "the eye tracker"; ///< its kind, and the rate asked for
inline constexpr const char* boxes_fact = "the response boxes";
inline constexpr const char* markers_fact = "the marker outputs";
// Those that are known once the devices are open.
inline constexpr const char* graphics_fact = "the graphics card"; ///< and its driver
inline constexpr const char* monitor_fact = "the monitor";
inline constexpr const char* model_fact = "the eye tracker's model";
inline constexpr const char* display_box_fact = "the display box";

/// What is named so among them; nothing if none is.
const RigFact* fact_called(const RigFacts& facts, std::string_view what);

/// What the protocol says of the rig that it is for, and this machine's name.
RigFacts facts_of_protocol(const Protocol& protocol);

/// `monitor`: null if there is none.
void add_screen_facts(RigFacts& facts, const GlDescription& graphics, const MonitorInfo* monitor);
/// What it tells of one recording, such as the name of a file, is left out.
void add_model_fact(RigFacts& facts, const TrackerDescription& tracker);
void add_box_fact(RigFacts& facts, const std::string& product, const std::string& serial_number);

/// What is known of both and differs: "the screen was 1920 x 1080 px at 120 Hz, is …", a part of a sentence
/// each.
std::vector<std::string> differences_between(const RigFacts& then, const RigFacts& now);

} // namespace overt
