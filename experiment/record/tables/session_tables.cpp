#include "experiment/record/tables/session_tables.h"

#include "experiment/scene/object_scale.h"

namespace overt {
namespace {

constexpr int rate_decimals = 3;  // a millihertz
constexpr int drift_decimals = 3; // a thousandth of a millionth
constexpr int scale_decimals = 9;

/// What the header has of a stimulus's object.
auto of_object(const SessionHeader& header, std::string RecordedObject::*what) {
    return [&header, what](const RecordedStimulus& row) {
        return of_maybe(item_of(header.objects, row.stimulus.object), what);
    };
}

/// One coordinate of the object's own origin, all digits of which count.
TableColumn origin_column(const std::string& axis, const std::string& meaning) {
    return {"origin_" + axis, meaning};
}
auto of_origin(const SessionHeader& header, int axis) {
    return [&header, axis](const RecordedStimulus& row) {
        return of_maybe(item_of(header.objects, row.stimulus.object), [axis](const RecordedObject& of) {
            return Fixed{of.origin[axis], scale_decimals};
        });
    };
}

/// How large the stimulus's object is, and is shown.
auto of_scale(const SessionHeader& header, double ObjectScale::*what) {
    return [&header, what](const RecordedStimulus& row) {
        const RecordedObject& of = item(header.objects, row.stimulus.object);
        const auto scale = object_scale(of.camera(row.stimulus.view), of.axis_point,
                                        header.screen_of_view(row.stimulus.view), of.unit);
        return of_maybe(scale, [what](const ObjectScale& known) {
            return Fixed{known.*what, scale_decimals};
        });
    };
}

/// What the box itself said.
auto of_box(std::string RecordedBox::*what) {
    return [what](const DisplayBoxRow& row) { return row.box.*what; };
}
auto of_clock(auto what) {
    return [what](const DisplayBoxRow& row) { return of_maybe(row.clock, what); };
}

} // namespace

RowLayout<RecordedEvent> events_layout() {
    return {"events",
            "What happened besides flips and samples, in all attempts and between trials.",
            {
                {session_seconds("time_s", "When it happened"), &RecordedEvent::at},
                {{"trial", "Position of the trial in the observer's order, from 1"},
                 [](auto& row) { return when(row.trial >= 0, row.trial + 1); }},
                {{"kind", "What happened"}, &RecordedEvent::kind},
                {{"detail", "Particulars"}, &RecordedEvent::detail},
            }};
}

RowLayout<RecordedStimulus> stimuli_layout(const SharedColumns& shared, const SessionHeader& header) {
    RowLayout<RecordedStimulus> layout{"stimuli", "What was shown: one row for each stimulus.", {}};
    layout.add<RecordedStimulus>(
        shared.of_stimulus<RecordedStimulus>([](const RecordedStimulus& row) { return row.stimulus; }));
    if (!header.display.stereo.empty())
        layout.add<RecordedStimulus>({{eye_column(), [&header](auto& row) {
                                           const auto view = static_cast<std::size_t>(row.stimulus.view);
                                           return word_of_eye(view < header.views_of_an_eye() ? Eye::left
                                                                                              : Eye::right);
                                       }}});
    layout.add<RecordedStimulus>({
        {{"source", "How the frames were made"}, &RecordedStimulus::source},
        {{"frames_sha256", "SHA-256 of the frames' pixels; n/a in sessions of earlier programs"},
         &RecordedStimulus::frames_sha256},
        {{"made_from_sha256", "SHA-256 of what the frames are made from"},
         &RecordedStimulus::made_from_sha256},
        {{"drawn_by", "Of frames that OpenGL drew, what it says of its renderer"},
         &RecordedStimulus::drawn_by},
        {{"mesh_file", "The object's mesh, relative to the session's directory"},
         of_object(header, &RecordedObject::mesh_file)},
        {{"mesh_sha256", "SHA-256 of the mesh"}, of_object(header, &RecordedObject::mesh_sha256)},
        {{"surface_sha256", "SHA-256 of how the object's surface looks by its file, which materials of kind "
                            "or base `own` show; empty where none does"},
         of_object(header, &RecordedObject::surface_sha256)},
        {{"surface_files", "What says it: the mesh's file, then its pictures, with `; ` between them"},
         of_object(header, &RecordedObject::surface_files)},
        {{"mm_per_unit",
          "Millimetres of the object in a unit of surface_x, surface_y, surface_z and depth; "
          "where the unit of the mesh is not known, the object is taken to be as large as "
          "its picture",
          "mm"},
         of_scale(header, &ObjectScale::mm_per_unit)},
        {{"shown_size", "Millimetres that the picture on the display has for a millimetre of the object, "
                        "in the depth of the axis of its turn"},
         of_scale(header, &ObjectScale::shown_size)},
        {origin_column("x",
                       "Added to surface_x, it gives the place in the coordinates of the mesh's file, turned "
                       "and scaled as the protocol says; 0 unless the mesh lies far from its file's origin"),
         of_origin(header, 0)},
        {origin_column("y", "The same of surface_y"), of_origin(header, 1)},
        {origin_column("z", "The same of surface_z"), of_origin(header, 2)},
    });
    return layout;
}

RowLayout<DisplayBoxRow> display_box_layout() {
    return {
        "display_box",
        "What the video signal went through: one row for each sitting.",
        {
            {{"sitting", "Counts how often the session was begun or resumed, from 1"},
             &DisplayBoxRow::sitting},
            {{"use",
              "Whether there was a display box",
              "",
              {{"box", "A Display++ or Bits# was switched to the mode"},
               {"declined", "The protocol says that there is none: its mode was not looked at"},
               {"simulated", "Nothing was shown on a real screen in real time"},
               {"not needed", "The output goes through no box"}}},
             [](auto& row) { return name_of(row.box.use); }},
            {{"product", "Name of the box"}, of_box(&RecordedBox::product)},
            {{"serial_number", "Its serial number"}, of_box(&RecordedBox::serial_number)},
            {{"firmware_date", "Date of its firmware"}, of_box(&RecordedBox::firmware_date)},
            {{"port", "Serial port at which it was found"}, of_box(&RecordedBox::port)},
            {{"mode", "To which it was switched"}, of_box(&RecordedBox::mode)},
            {{"gamma_table", "File on its disk that it was told to use"}, of_box(&RecordedBox::gamma_table)},
            {{"settled_after_s", "From the command to two equal measurements of the video rate", "s"},
             [](auto& row) { return when(row.box.use == RecordedBox::Use::box, row.box.settled_after); }},
            {{"video_rate_hz", "Rate of the video signal as the box measures it", "Hz"},
             [](auto& row) {
                 return when(row.box.use == RecordedBox::Use::box,
                             Fixed{row.box.video_rate_hz, rate_decimals});
             }},
            {{"clock_readings", "Readings of its clock and the session's"},
             [](auto& row) { return row.clock ? row.clock->readings : 0; }},
            {session_seconds("clock_zero_s", "When its clock showed 0, by the line through the readings"),
             of_clock(&BoxClockFit::zero)},
            {{"clock_uncertainty_s", "Bound on the error of times read off that line", "s"},
             of_clock(&BoxClockFit::uncertainty)},
            {{"clock_drift_ppm", "By how much a second of the session exceeds a second of the box", "ppm"},
             of_clock([](auto& clock) {
                 return Fixed{clock.drift_ppm, drift_decimals};
             })},
            {{"clock_drift_uncertainty_ppm", "Bound on the error of clock_drift_ppm", "ppm"},
             of_clock([](auto& clock) {
                 return Fixed{clock.drift_uncertainty_ppm, drift_decimals};
             })},
        }};
}

} // namespace overt
