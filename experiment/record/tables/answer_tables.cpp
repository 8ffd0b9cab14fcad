/// What was answered by keys, the mouse or boxes, and every press meanwhile, as tables.
#include <fmt/format.h>

#include "experiment/record/tables/attempt_cells.h"
#include "experiment/record/tables/joined_cells.h"
#include "experiment/record/tables/session_tables.h"

namespace overt {

namespace {

auto time_of_answer(std::optional<SessionTime> GivenAnswer::*at) {
    return [at](const GivenAnswerRow& row) { return row.given.*at; };
}

/// Of what was pointed at: `what(PointedAnswer)`, or what(SurfacePoint) of its place.
auto of_pointed(auto what) {
    return [what](const GivenAnswerRow& row) {
        return row.pointed ? std::optional(what(*row.pointed)) : std::nullopt;
    };
}
auto of_pointed_surface(auto what) {
    return [what](const GivenAnswerRow& row) {
        return row.pointed && row.pointed->surface ? std::optional(what(*row.pointed->surface))
                                                   : std::nullopt;
    };
}
auto pointed_coordinate(int axis) {
    return of_pointed_surface(
        [axis](const SurfacePoint& surface) { return surface_coordinate(surface.position[axis]); });
}
auto pointed_sd(double SurfaceFootprint::*sd) {
    return [sd](const GivenAnswerRow& row) {
        return row.pointed && row.pointed->footprint
                   ? std::optional(surface_coordinate(*row.pointed->footprint.*sd))
                   : std::nullopt;
    };
}

/// The place of an answer of kind "point".
void add_pointed_columns(RowLayout<GivenAnswerRow>& layout, const SessionHeader& header) {
    const LengthWords length = length_words(header);
    layout.add<GivenAnswerRow>({
        {{"point_slot", "Of a place that was pointed at, the slot whose image it lies in; n/a: in none"},
         of_pointed([](const PointedAnswer& pointed) { return pointed.slot; })},
        {{"point_image_x_px", "The place in that image, to the right", "px"},
         of_pointed([](const PointedAnswer& pointed) {
             return Fixed{pointed.image_px.x, pixel_decimals};
         })},
        {{"point_image_y_px", "The same downwards", "px"}, of_pointed([](const PointedAnswer& pointed) {
             return Fixed{pointed.image_px.y, pixel_decimals};
         })},
        {{"point_frame", "Animation frame that was lit there when it was pointed at"},
         [](auto& row) {
             return row.pointed && row.pointed->shown ? std::optional(row.pointed->shown->frame.value)
                                                      : std::nullopt;
         }},
        {{"point_x", fmt::format("Place on the unturned surface{}; n/a: beside the object", length.remark),
          length.unit},
         pointed_coordinate(0)},
        {{"point_y", fmt::format("Place on the unturned surface{}", length.remark), length.unit},
         pointed_coordinate(1)},
        {{"point_z", fmt::format("Place on the unturned surface, upwards{}", length.remark), length.unit},
         pointed_coordinate(2)},
        {{"point_triangle", "Index of the mesh's triangle, from 0"},
         of_pointed_surface([](const SurfacePoint& surface) { return surface.triangle; })},
        {{"point_part", "Part of the surface"},
         [](auto& row) {
             return when(row.pointed && row.pointed->surface,
                         row.pointed ? row.pointed->part : std::string());
         }},
        {{"point_incidence_deg", "Angle between the line of sight and the surface's normal there", "deg"},
         of_pointed_surface([](const SurfacePoint& surface) {
             return Fixed{surface.incidence.value, angle_decimals};
         })},
        {{"point_sd_major",
          fmt::format(
              "Standard deviation on the surface of a place within the pixel that was pointed at, or within "
              "the "
              "accuracy of gaze by its validation where that pointed, along the longer axis of its ellipse{}",
              length.remark),
          length.unit},
         pointed_sd(&SurfaceFootprint::largest_sd)},
        {{"point_sd_minor", fmt::format("The same along its shorter axis{}", length.remark), length.unit},
         pointed_sd(&SurfaceFootprint::smallest_sd)},
    });
}

} // namespace

RowLayout<GivenAnswerRow> given_answers_layout(const SharedColumns& shared, const SessionHeader& header) {
    RowLayout<GivenAnswerRow> layout{
        "given_answers",
        "A row for each answer that was asked in each attempt that ended, missed ones too.",
        {
            {{"trial", "Position of the trial in the observer's order, from 1"}, number_of_trial},
            {{"attempt", "Which attempt at this trial, from 1"}, attempt_number},
            {{"counts", "Whether this is the attempt that counts"}, attempt_counts},
            {shared.task, task_of(header)},
        }};
    layout.add<TrialRecord>(shared.of_stimulus<TrialRecord>(shown_in));
    layout.add<TrialRecord>(own_columns<RowLayout<TrialRecord>::Column>(header));
    layout.add<GivenAnswerRow>({
        {{"id", "As the protocol calls the answer"}, [](auto& row) { return row.given.id; }},
        {{"item", "Of a scale with several items, which; else n/a"},
         [](auto& row) { return when(!row.given.item.empty(), row.given.item); }},
        {{"kind", "How it was asked"}, [](auto& row) { return row.given.kind; }},
        {{"place", "Which of the trial's answers and items it was in turn, from 1"},
         [](auto& row) { return row.given.place + 1; }},
        {{"answer", "What was meant; n/a: nothing was answered"},
         [](auto& row) { return when(!row.given.is_missed, row.given.value); }},
        {{"number", "The same of a scale or a number, as a number"},
         [](auto& row) {
             return Fixed{row.given.number, 6};
         }},
        {{"correct_answer", "What is correct; n/a: nothing is, or nobody knows it"},
         [](auto& row) { return when(!row.given.correct.empty(), row.given.correct); }},
        {{"is_correct",
          "Whether it was",
          "",
          {{"1", "yes"}, {"0", "no"}, {"n/a", "nothing was answered, or nothing is correct"}}},
         [](auto& row) { return of_maybe(row.given.is_correct, [](bool is) { return is ? 1 : 0; }); }},
        {{"response_time_s", "From the instant that `zero` names; negative: before it; n/a: missed", "s"},
         [](auto& row) { return row.given.response_time(); }},
        {{"zero",
          "What the response time counts from",
          "",
          {{"stimulus", "the onset of the stimulus shown last"},
           {"window", "when presses began to count"},
           {"screen", "the onset of the answer's own screen"}}},
         [](auto& row) { return name_of(row.given.zero); }},
        {{"uncertainty_s",
          "The press came so long before at most at a keyboard; at a box, so long before or after", "s"},
         [](auto& row) { return row.given.uncertainty; }},
        {session_seconds("stimulus_onset_s", "Onset of the stimulus shown last"),
         time_of_answer(&GivenAnswer::stimulus_onset)},
        {session_seconds("window_onset_s", "When presses began to count"),
         time_of_answer(&GivenAnswer::window_onset)},
        {session_seconds("window_end_s", "When they counted no longer"),
         time_of_answer(&GivenAnswer::window_end)},
        {session_seconds("screen_onset_s", "Onset of the answer's own screen; n/a: it had none"),
         time_of_answer(&GivenAnswer::screen_onset)},
        {session_seconds("first_input_s", "The first press that changed it"),
         time_of_answer(&GivenAnswer::first_input_at)},
        {session_seconds("answered_s", "When it was given, or accepted"),
         time_of_answer(&GivenAnswer::answered_at)},
        {{"key", "By which it was given, or accepted"},
         [](auto& row) { return when(!row.given.key.empty(), row.given.key); }},
        {{"device", "keyboard, mouse, or the response box as the protocol calls it"},
         [](auto& row) { return when(!row.given.device.empty(), row.given.device); }},
        {{"mapping", "By how many places the choices were turned over the keys, or 1 of a scale that began "
                     "at its other side; 0: as the protocol has it"},
         [](auto& row) { return row.given.mapping; }},
        {{"changes", "How often it was changed before it stood"},
         [](auto& row) { return row.given.changes; }},
        {{"tied",
          "Whether two keys that answer differently were pressed at the same time",
          "",
          {{"yes", "which was first is not known"}, {"no", "one came first"}}},
         [](auto& row) -> std::string_view { return row.given.is_tied ? "yes" : "no"; }},
    });
    add_pointed_columns(layout, header);
    return layout;
}

RowLayout<AnswerInputRow> answer_inputs_layout() {
    using Kind = ObserverInput::Kind;
    const auto points = [](const AnswerInputRow& row) {
        const Kind kind = row.taken.input.kind;
        return kind == Kind::pointer_moved || kind == Kind::pointer_down || kind == Kind::pointer_up;
    };
    return {
        "answer_inputs",
        "Every press, release and movement by which the observer answered, or that came too early, too late "
        "or "
        "to no effect.",
        {
            {{"trial", "Position of the trial in the observer's order, from 1"}, number_of_trial},
            {{"attempt", "Which attempt at this trial, from 1"}, attempt_number},
            {{"input", "Which of the attempt's, from 1"}, &AnswerInputRow::number},
            {{"id", "The answer that it went to, as the protocol calls it"},
             [](auto& row) { return row.taken.id; }},
            {{"item", "Of a scale with several items, which; else n/a"},
             [](auto& row) { return when(!row.taken.item.empty(), row.taken.item); }},
            {{"kind",
              "What the observer did",
              "",
              {{"key down", "pressed a key or a button"},
               {"key up", "let it go"},
               {"text", "wrote a character"},
               {"pointer moved", "moved the mouse"},
               {"pointer down", "pressed its button"},
               {"pointer up", "let it go"},
               {"wheel", "turned its wheel"},
               {"dial", "turned a knob"},
               {"tilt", "tilted a knob"},
               {"let go", "what is typed went to another window"}}},
             [](auto& row) { return name_of(row.taken.input.kind); }},
            {session_seconds("at_s", "When"), [](auto& row) { return row.taken.input.at; }},
            {{"uncertainty_s", "As in given_answers", "s"},
             [](auto& row) { return row.taken.input.uncertainty; }},
            {{"device", "keyboard, mouse, or the response box as the protocol calls it"},
             [](auto& row) { return std::string(row.taken.input.device.view()); }},
            {{"key", "Name of the key or button"},
             [](auto& row) {
                 return when(!row.taken.input.key.view().empty(), std::string(row.taken.input.key.view()));
             }},
            {{"character", "Number of the character that was written, in Unicode; 8: backspace, held"},
             [](auto& row) {
                 return when(row.taken.input.kind == Kind::text, static_cast<int>(row.taken.input.character));
             }},
            {{"right_px", "Where the pointer was, from the middle of the screen", "px"},
             [points](auto& row) {
                 return Fixed{when(points(row), row.taken.input.right_px), 3};
             }},
            {{"down_px", "The same downwards", "px"},
             [points](auto& row) {
                 return Fixed{when(points(row), row.taken.input.down_px), 3};
             }},
            {{"steps", "Of a wheel or a knob, by how many steps"},
             [](auto& row) {
                 const bool turns = row.taken.input.kind == Kind::wheel ||
                                    row.taken.input.kind == Kind::dial || row.taken.input.kind == Kind::tilt;
                 return Fixed{when(turns, row.taken.input.steps), 3};
             }},
            {{"state",
              "Where in time it fell",
              "",
              {{"before", "presses did not count yet"},
               {"open", "they counted"},
               {"late", "they counted no longer"}}},
             [](auto& row) { return name_of(row.taken.state); }},
            {{"counted", "Whether it changed the answer, or gave it", "", {{"yes", ""}, {"no", ""}}},
             [](auto& row) -> std::string_view { return row.taken.has_counted ? "yes" : "no"; }},
            {{"number", "Where the marker of a scale stood after it, or what was typed of a number"},
             [](auto& row) {
                 return Fixed{row.taken.number, 6};
             }},
        }};
}

} // namespace overt
