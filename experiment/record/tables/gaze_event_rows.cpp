#include "experiment/record/tables/gaze_event_rows.h"

#include "experiment/record/tables/joined_cells.h"
#include "experiment/record/tables/shared_columns.h"

namespace overt {
namespace {

/// By the session's clock.
auto session_time_of(TrackerTime GazeEvent::*at) {
    return [at](const GazeEventRow& row) {
        return of_maybe(row.clock_map, [&](auto& map) { return map.to_session(row.event.*at).time; });
    };
}
auto tracker_us_of(TrackerTime GazeEvent::*at) {
    return [at](const GazeEventRow& row) { return microseconds_of(row.event.*at); };
}

std::string_view detector_of(const GazeEventRow& row) {
    using From = SessionRecord::EventOrigin::From;
    return !is_eye_event(row.event.kind)   ? ""
           : row.origin == From::recording ? "overt"
           : row.origin == From::reading   ? "overt at export"
                                           : "tracker";
}

// Of a fixation's place.
constexpr const char* no_presentation = "outside of the presentation";
constexpr int share_decimals = 4;

bool has_point(const GazeEventRow& row) { return row.fixation && row.fixation->part; }

/// Where a fixation met the surface, as `overt analyze` finds it.
std::vector<RowLayout<GazeEventRow>::Column> surface_columns(const SessionHeader& header) {
    const LengthWords length = length_words(header);
    const auto axis = [&](const char* name, int which, const char* more) {
        return RowLayout<GazeEventRow>::Column{
            {name,
             fmt::format("Place of a fixation on the unturned surface{}: that of its samples that is nearest "
                         "to all others; n/a as place says{}",
                         more, length.remark),
             length.unit},
            [which](const GazeEventRow& row) {
                return when(has_point(row),
                            surface_coordinate(has_point(row) ? row.fixation->position[which] : 0.0));
            }};
    };
    const auto share = [](double StudyFixation::*of) {
        return [of](const GazeEventRow& row) {
            const bool is_known = row.fixation && row.fixation->samples > 0 &&
                                  row.fixation->why != NotCounted::no_surface &&
                                  row.fixation->why != NotCounted::no_stimulus;
            return when(is_known, Fixed{is_known ? (*row.fixation).*of : 0.0, share_decimals});
        };
    };
    TableColumn part = part_column(header);
    part.meaning = "Part of the figure with most samples of a fixation";
    TableColumn place{
        "place",
        "Whether a fixation counts, by the rules that `overt analyze` has without options, or why not, which "
        "is also why it has no place; n/a of what is no fixation",
        "",
        {{no_presentation, "it ended before the presentation, or began after it"}}};
    for (const auto& [why, meaning] :
         {std::pair{NotCounted::counted, "it counts, and has a place"},
          std::pair{NotCounted::began_before_onset, "it was under way when the presentation began"},
          std::pair{NotCounted::no_frame_lit, "no frame is known to have been lit during it"},
          std::pair{NotCounted::no_stimulus, "the session knows of no stimulus, as an imported recording"},
          std::pair{NotCounted::not_on_surface, "fewer than half of its samples met the object, or missed it "
                                                "by no more than the error that the validation found"},
          std::pair{NotCounted::no_surface, "the session has no maps of the object"}})
        place.levels.emplace_back(name_of(why), meaning);
    return {
        axis("surface_x", 0, ""),
        axis("surface_y", 1, ""),
        axis("surface_z", 2, ", upwards"),
        {{"triangle",
          "Index of the mesh's triangle at that place, from 0; n/a where maps were given without a "
          "mesh"},
         [](auto& row) { return row.fixation ? row.fixation->triangle : std::optional<std::uint32_t>(); }},
        {part,
         [](auto& to, auto& row) {
             const std::size_t index = has_point(row) ? *row.fixation->part : row.part_cells.size();
             index < row.part_cells.size() ? to.ready(row.part_cells[index]) : to.missing();
         }},
        {{"on_surface", "Share of a fixation's samples that met the object, of those with a lit frame"},
         share(&StudyFixation::on_surface)},
        {{"within_reach", "Share that missed it by no more than the error that the validation found"},
         share(&StudyFixation::within_reach)},
        {place,
         [](auto& row) -> std::string_view {
             return row.event.kind != GazeEvent::Kind::fixation ? ""
                    : row.fixation                              ? name_of(row.fixation->why)
                                                                : no_presentation;
         }},
    };
}

} // namespace

std::vector<RowLayout<TrackerEventRow>::Column>
event_value_columns(const std::string& pixels, const std::string& of_pupil, const std::string& pupil) {
    using PlaceOfEvent = std::optional<ScreenPoint> GazeEvent::*;
    using Number = std::optional<double> GazeEvent::*;
    const auto coordinate = [](PlaceOfEvent place, double ScreenPoint::*axis) {
        return [=](const TrackerEventRow& row) {
            return of_maybe(row.event.*place, [axis](auto& point) {
                return Fixed{point.*axis, pixel_decimals};
            });
        };
    };
    const auto number = [](Number value, int decimals) {
        return [=](const TrackerEventRow& row) { return Fixed{row.event.*value, decimals}; };
    };
    return {
        {{"x_px", "Mean place of a fixation, start of a saccade, to the right", pixels},
         coordinate(&GazeEvent::place, &ScreenPoint::x_px)},
        {{"y_px", "The same, downwards", pixels}, coordinate(&GazeEvent::place, &ScreenPoint::y_px)},
        {{"end_x_px", "End of a saccade, to the right", pixels},
         coordinate(&GazeEvent::arrival, &ScreenPoint::x_px)},
        {{"end_y_px", "The same, downwards", pixels}, coordinate(&GazeEvent::arrival, &ScreenPoint::y_px)},
        {{"pupil", "Mean pupil size of a fixation" + (pupil.empty() ? pupil : ". " + pupil), of_pupil},
         number(&GazeEvent::pupil, pupil_decimals)},
        {{"amplitude_deg", "Size of a saccade", "deg"}, number(&GazeEvent::amplitude_deg, pixel_decimals)},
        {{"peak_velocity_deg_s", "Peak velocity of a saccade", "deg/s"},
         number(&GazeEvent::peak_velocity_deg_s, pixel_decimals)},
    };
}

RowLayout<GazeEventRow> gaze_events_layout(const SessionHeader& header, const std::string& origins,
                                           const PupilWords& pupil) {
    RowLayout<GazeEventRow> layout{
        "gaze_events",
        "Fixations, saccades and blinks in the completed trials, and what the tracker's file said besides "
        "them, "
        "where gaze was imported from one. " +
            origins,
        {
            {{"trial", "Position of the trial in the observer's order, from 1; n/a outside of trials"},
             [](auto& row) { return when(row.trial > 0, row.trial); }},
            {{"kind",
              "What it was",
              "",
              {{"fixation", "the eye rested"},
               {"saccade", "the eye jumped"},
               {"blink", "there was no pupil"},
               {"message", "a message to the tracker, or by it"},
               {"button", "a button of the tracker's own box: number and state"},
               {"input", "the tracker's own input port: value"},
               {"started", "a recording began: its eyes"},
               {"ended", "a recording ended: pixels per degree, to the right and downwards"},
               {"note", "a line without a time, which stands after the line of that time"}}},
             [](auto& row) { return name_of(row.event.kind); }},
            {{"detector",
              "Who found a fixation, saccade or blink; n/a of all else",
              "",
              {{"tracker", "the eye tracker itself"},
               {"overt", "the program, while it recorded the session"},
               {"overt at export", "the program, from the recorded samples"}}},
             detector_of},
            {eye_column(), [](auto& row) { return of_maybe(row.event.eye, word_of_eye); }},
            {{"start_s", "When it began; session clock, nine decimals keep each nanosecond", "s"},
             session_time_of(&GazeEvent::start)},
            {{"end_s", "When its last sample was taken; of what does not last, start_s", "s"},
             session_time_of(&GazeEvent::end)},
            {{"duration_s", "From its begin to the end of its last sample, as its detector gives it", "s"},
             [](auto& row) {
                 return when(is_eye_event(row.event.kind), SessionDuration(row.event.duration));
             }},
            {{"tracker_start_us", "start_s by the tracker's own clock", "us"},
             tracker_us_of(&GazeEvent::start)},
            {{"tracker_end_us", "end_s by the tracker's own clock", "us"}, tracker_us_of(&GazeEvent::end)},
        }};
    if (const SharedColumns shared(header); shared.has_slots)
        layout.add<GazeEventRow>({{shared.slot, [](auto& row) { return row.slot; }}});
    layout.add<TrackerEventRow>(event_value_columns("px", pupil.unit, pupil.meaning));
    layout.add<GazeEventRow>(surface_columns(header));
    layout.add<GazeEventRow>({
        {{"text", "Words and numbers of what is no fixation, saccade or blink"},
         [](auto& row) { return row.event.text; }},
    });
    return layout;
}

void write_gaze_events(TableWriter& writer, const RowLayout<GazeEventRow>& layout,
                       const SessionRecord& record, const TrialRecord& trial,
                       std::span<const GazeEvent> events,
                       std::span<const std::optional<StudyFixation>> fixations) {
    const std::optional<ClockMap> clock_map = record.clock_map(trial);
    const SessionRecord::EventOrigin::From origin = record.event_origin(trial.sitting).from;
    const std::vector<std::string> parts =
        part_cells_of(record.header(), trial.trial.stimulus.object, writer.format());
    const std::string_view slot = item(record.header().slots, trial.trial.slot).id;
    for (std::size_t i = 0; i < events.size(); ++i)
        layout.write(writer, {{events[i]},
                              trial.trial.index + 1,
                              clock_map,
                              origin,
                              fixations[i],
                              parts,
                              fixations[i] ? slot : std::string_view()});
}

void write_gaze_events_outside(TableWriter& writer, const RowLayout<GazeEventRow>& layout,
                               const SessionRecord& record) {
    // They are of the sitting whose gaze was imported.
    int sitting = 1;
    for (const TrialRecord& trial : record.trials())
        if (record.gaze_source(trial.sitting))
            sitting = trial.sitting;
    const std::optional<ClockMap> clock_map = record.clock_map(sitting);
    const SessionRecord::EventOrigin::From origin = record.event_origin(sitting).from;
    record.read_gaze_events_outside([&](const GazeEvent& event) {
        layout.write(writer, {{event}, 0, clock_map, origin});
    });
}

} // namespace overt
