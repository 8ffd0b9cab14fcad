#include "experiment/record/tables/session_tables.h"

namespace overt {
namespace {

constexpr int rate_decimals = 3;  // a millihertz
constexpr int drift_decimals = 3; // a thousandth of a millionth

} // namespace

RowLayout<RecordedEvent> events_layout() {
    return {
        "events",
        "What happened besides flips and samples, in all attempts and between trials.",
        {
            {session_seconds("time_s", "When it happened"), [](auto& to, auto& row) { to.seconds(row.at); }},
            {{"trial", "Position of the trial in the observer's order, from 1", "", {}},
             [](auto& to, auto& row) { row.trial < 0 ? to.missing() : to.integer(row.trial + 1); }},
            {{"kind", "What happened", "", {}}, [](auto& to, auto& row) { to.text(row.kind); }},
            {{"detail", "Particulars", "", {}}, [](auto& to, auto& row) { to.text(row.detail); }},
        }};
}

RowLayout<RecordedStimulus> stimuli_layout(const SharedColumns& shared, const SessionHeader& header) {
    return {"stimuli",
            "What was shown: one row for each sculpture in each material.",
            {
                {shared.sculpture,
                 [&header](auto& to, auto& row) {
                     const auto* const found = item_of(header.sculptures, row.condition.sculpture);
                     to.text(found ? found->id : "");
                 }},
                {shared.material,
                 [&header](auto& to, auto& row) {
                     const auto* const found = item_of(header.materials, row.condition.material);
                     to.text(found ? found->id : "");
                 }},
                {{"source", "How the frames were made", "", {}},
                 [](auto& to, auto& row) { to.text(row.source); }},
                {{"frames_sha256", "SHA-256 of the frames", "", {}},
                 [](auto& to, auto& row) { to.text(row.frames_sha256); }},
                {{"mesh_file", "The sculpture's mesh, relative to the session's directory", "", {}},
                 [&header](auto& to, auto& row) {
                     const auto* const found = item_of(header.sculptures, row.condition.sculpture);
                     to.text(found ? found->mesh_file : "");
                 }},
                {{"mesh_sha256", "SHA-256 of the mesh", "", {}},
                 [&header](auto& to, auto& row) {
                     const auto* const found = item_of(header.sculptures, row.condition.sculpture);
                     to.text(found ? found->mesh_sha256 : "");
                 }},
            }};
}

RowLayout<DisplayBoxRow> display_box_layout() {
    return {
        "display_box",
        "What the video signal went through: one row for each sitting.",
        {
            {{"sitting", "Counts how often the session was begun or resumed, from 1", "", {}},
             [](auto& to, auto& row) { to.integer(row.sitting); }},
            {{"use",
              "Whether there was a display box",
              "",
              {{"box", "A Display++ or Bits# was switched to the mode"},
               {"declined", "The protocol says that there is none: its mode was not looked at"},
               {"simulated", "Nothing was shown on a real screen in real time"},
               {"not needed", "The output goes through no box"}}},
             [](auto& to, auto& row) { to.word(name_of(row.box.use)); }},
            {{"product", "Name of the box", "", {}}, [](auto& to, auto& row) { to.text(row.box.product); }},
            {{"serial_number", "Its serial number", "", {}},
             [](auto& to, auto& row) { to.text(row.box.serial_number); }},
            {{"firmware_date", "Date of its firmware", "", {}},
             [](auto& to, auto& row) { to.text(row.box.firmware_date); }},
            {{"port", "Serial port at which it was found", "", {}},
             [](auto& to, auto& row) { to.text(row.box.port); }},
            {{"mode", "To which it was switched", "", {}},
             [](auto& to, auto& row) { to.text(row.box.mode); }},
            {{"gamma_table", "File on its disk that it was told to use", "", {}},
             [](auto& to, auto& row) { to.text(row.box.gamma_table); }},
            {{"settled_after_s", "From the command to two equal measurements of the video rate", "s", {}},
             [](auto& to, auto& row) {
                 row.box.use == RecordedBox::Use::box ? to.seconds(row.box.settled_after) : to.missing();
             }},
            {{"video_rate_hz", "Rate of the video signal as the box measures it", "Hz", {}},
             [](auto& to, auto& row) {
                 row.box.use == RecordedBox::Use::box ? to.fixed(row.box.video_rate_hz, rate_decimals)
                                                      : to.missing();
             }},
            {{"clock_readings", "Readings of its clock and the session's", "", {}},
             [](auto& to, auto& row) { to.integer(row.clock ? row.clock->readings : 0); }},
            {session_seconds("clock_zero_s", "When its clock showed 0, by the line through the readings"),
             [](auto& to, auto& row) { row.clock ? to.seconds(row.clock->zero) : to.missing(); }},
            {{"clock_uncertainty_s", "Bound on the error of times read off that line", "s", {}},
             [](auto& to, auto& row) { row.clock ? to.seconds(row.clock->uncertainty) : to.missing(); }},
            {{"clock_drift_ppm",
              "By how much a second of the session exceeds a second of the box",
              "ppm",
              {}},
             [](auto& to, auto& row) {
                 row.clock ? to.fixed(row.clock->drift_ppm, drift_decimals) : to.missing();
             }},
            {{"clock_drift_uncertainty_ppm", "Bound on the error of clock_drift_ppm", "ppm", {}},
             [](auto& to, auto& row) {
                 row.clock ? to.fixed(row.clock->drift_uncertainty_ppm, drift_decimals) : to.missing();
             }},
        }};
}

} // namespace overt
