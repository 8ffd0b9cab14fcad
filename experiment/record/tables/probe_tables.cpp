#include "experiment/record/tables/probe_tables.h"

#include <fmt/format.h>

#include "experiment/record/tables/attempt_cells.h"
#include "experiment/record/tables/joined_cells.h"

namespace overt {

namespace {

auto point_coordinate(int axis) {
    return [axis](const RecordedPoint& point) { return surface_coordinate(point.position[axis]); };
}

Fixed angle_cell(Degrees angle) { return Fixed{angle.value, angle_decimals}; }

constexpr std::string_view slant_meaning = "angle between the normal and the line of sight";
constexpr std::string_view tilt_meaning =
    "direction on the screen in which the normal leans, from the right counter-clockwise";

/// Slant and tilt of something, two columns. `of(row)` gives an Attitude, or an optional one.
template <class Row>
void add_attitude(RowLayout<Row>& layout, const std::string& prefix, const std::string& what, auto of) {
    layout.template add<Row>({
        {{prefix + "slant_deg", fmt::format("{}: {}", what, slant_meaning), "deg"},
         [of](const Row& row) {
             const std::optional<Attitude> attitude = of(row);
             return attitude ? std::optional(angle_cell(attitude->slant)) : std::nullopt;
         }},
        {{prefix + "tilt_deg", fmt::format("{}: {}", what, tilt_meaning), "deg"},
         [of](const Row& row) {
             const std::optional<Attitude> attitude = of(row);
             return attitude ? std::optional(angle_cell(attitude->tilt)) : std::nullopt;
         }},
    });
}

TableColumn yes_or_no(std::string name, std::string meaning) {
    return {std::move(name), std::move(meaning), "", {{"yes", ""}, {"no", ""}}};
}
std::string_view said(bool is) { return is ? "yes" : "no"; }

} // namespace

RowLayout<RecordedPoint> points_layout(const SessionHeader& header) {
    const LengthWords length = length_words(header);
    return {"points",
            "The places on surfaces that the protocol names, as levels of the factors that probes are.",
            {
                {{"object", "On which object it is"},
                 [&header](auto& point) { return item(header.objects, point.object).id; }},
                {{"point", "Name of the place"}, [](auto& point) { return point.name; }},
                {{"triangle", "Index of the mesh's triangle, from 0"},
                 [](auto& point) { return point.triangle; }},
                {{"weight_a", "Weight of the triangle's first corner; the weights sum to 1"},
                 [](auto& point) {
                     return Fixed{point.barycentric.x, 6};
                 }},
                {{"weight_b", "The same of the second"},
                 [](auto& point) {
                     return Fixed{point.barycentric.y, 6};
                 }},
                {{"weight_c", "The same of the third"},
                 [](auto& point) {
                     return Fixed{point.barycentric.z, 6};
                 }},
                {{"x", fmt::format("Place on the unturned surface{}", length.remark), length.unit},
                 point_coordinate(0)},
                {{"y", fmt::format("Place on the unturned surface{}", length.remark), length.unit},
                 point_coordinate(1)},
                {{"z", fmt::format("Place on the unturned surface, upwards{}", length.remark), length.unit},
                 point_coordinate(2)},
                {{"vertex", "Index of the mesh's vertex that it is, from 0; n/a: it is none"},
                 [](auto& point) { return point.vertex; }},
                {{"part", "Part of the surface"}, [](auto& point) { return point.part; }},
            }};
}

RowLayout<ProbeRow> probes_layout(const SharedColumns& shared, const SessionHeader& header) {
    RowLayout<ProbeRow> layout{
        "probes",
        "Marks at places of the surface: a row for each probe in each step that showed it, of each attempt "
        "that "
        "ended.",
        {
            {{"trial", "Position of the trial in the observer's order, from 1"}, number_of_trial},
            {{"attempt", "Which attempt at this trial, from 1"}, attempt_number},
            {{"counts", "Whether this is the attempt that counts"}, attempt_counts},
            {shared.task, task_of(header)},
        }};
    layout.add<ProbeRow>({
        {{"step", "Position of the step that showed it, from 1"}, [](auto& row) { return row.probe.step; }},
        {{"probe", "As the protocol calls it"}, [](auto& row) { return row.probe.id; }},
        {{"point", "Name of its place"}, [](auto& row) { return row.probe.point; }},
        {{"object", "On which object it stood"},
         [&header](auto& row) {
             const auto place = static_cast<std::size_t>(row.probe.place);
             return item(header.objects, row.attempt.trial.shown(place).stimulus.object).id;
         }},
        {{"slot", "In which slot that was shown"},
         [&header](auto& row) {
             const auto place = static_cast<std::size_t>(row.probe.place);
             return item(header.slots, row.attempt.trial.shown(place).slot).id;
         }},
        {yes_or_no("visible", "Whether the place was seen at the first flip, and the mark drawn"),
         [](auto& row) { return said(row.probe.was_visible); }},
        {{"shown_refreshes", "Flips while its stimulus was lit"},
         [](auto& row) { return row.probe.shown_refreshes; }},
        {{"visible_refreshes", "Of these, at which the place was seen"},
         [](auto& row) { return row.probe.visible_refreshes; }},
        {{"screen_x_px",
          "Where it was at the first flip, also where it was hidden, from the screen's left edge", "px"},
         [](auto& row) {
             return Fixed{row.probe.at.x_px, pixel_decimals};
         }},
        {{"screen_y_px", "The same, from its upper edge", "px"},
         [](auto& row) {
             return Fixed{row.probe.at.y_px, pixel_decimals};
         }},
    });
    add_attitude(layout, "", "Of the surface there",
                 [](const ProbeRow& row) { return std::optional(row.probe.truth); });
    return layout;
}

RowLayout<GaugeRow> gauges_layout(const SharedColumns& shared, const SessionHeader& header) {
    RowLayout<GaugeRow> layout{
        "gauge_settings",
        "What was set with gauges, beside the surface itself: a row for each that was asked in each attempt "
        "that "
        "ended, those that were not set too. Slant and tilt are of the line of sight through the place.",
        {
            {{"trial", "Position of the trial in the observer's order, from 1"}, number_of_trial},
            {{"attempt", "Which attempt at this trial, from 1"}, attempt_number},
            {{"counts", "Whether this is the attempt that counts"}, attempt_counts},
            {shared.task, task_of(header)},
        }};
    layout.add<TrialRecord>(shared.of_stimulus<TrialRecord>(shown_in));
    layout.add<TrialRecord>(own_columns<RowLayout<TrialRecord>::Column>(header));
    layout.add<GaugeRow>({
        {{"id", "As the protocol calls the answer"}, [](auto& row) { return row.given.id; }},
        {{"probe", "The probe at which it stood"}, [](auto& row) { return row.gauge.probe; }},
        {{"point", "Name of that place"}, [](auto& row) { return row.gauge.point; }},
        {yes_or_no("set", "Whether it was set and accepted"),
         [](auto& row) { return said(!row.given.is_missed); }},
    });
    add_attitude(layout, "", "As it was set, or left when time was up",
                 [](const GaugeRow& row) { return std::optional(row.gauge.set); });
    add_attitude(layout, "true_", "Of the surface in the frame that was lit then",
                 [](const GaugeRow& row) { return row.gauge.truth; });
    layout.add<GaugeRow>({
        {{"deviation_deg", "Between the normal that was set and the true one; n/a: not set, or not known",
          "deg"},
         [](auto& row) {
             const std::optional<Degrees> off = row.given.is_missed ? std::nullopt : row.gauge.deviation();
             return off ? std::optional(angle_cell(*off)) : std::nullopt;
         }},
    });
    add_attitude(layout, "start_", "As it stood at first, drawn",
                 [](const GaugeRow& row) { return std::optional(row.gauge.start); });
    layout.add<GaugeRow>({
        {yes_or_no("at_limit", "Whether it could not be slanted further"),
         [](auto& row) { return said(row.gauge.is_at_limit); }},
        {{"frame", "Animation frame that was lit when it was accepted"},
         [](auto& row) { return row.gauge.frame; }},
        {yes_or_no("visible", "Whether the place was seen in that frame; n/a: not known"),
         [](auto& row) {
             return of_maybe(row.gauge.is_visible, [](bool is) { return std::string(said(is)); });
         }},
        {{"changes", "How often it was changed before it stood"},
         [](auto& row) { return row.given.changes; }},
        {{"response_time_s", "As in given_answers", "s"},
         [](auto& row) { return row.given.response_time(); }},
    });
    return layout;
}

RowLayout<GaugeChangeRow> gauge_changes_layout() {
    RowLayout<GaugeChangeRow> layout{
        "gauge_changes",
        "How gauges were turned after each input.",
        {
            {{"trial", "Position of the trial in the observer's order, from 1"}, number_of_trial},
            {{"attempt", "Which attempt at this trial, from 1"}, attempt_number},
            {{"input", "Which of the attempt's inputs, as in answer_inputs"}, &GaugeChangeRow::input},
            {{"id", "As the protocol calls the answer"}, [](auto& row) { return row.taken.id; }},
            {session_seconds("at_s", "When"), [](auto& row) { return row.taken.input.at; }},
        }};
    add_attitude(layout, "", "After it", [](const GaugeChangeRow& row) { return row.taken.attitude; });
    return layout;
}

} // namespace overt
