#include <nlohmann/json.hpp>

#include "experiment/answers/answer_kinds.h"
#include "experiment/protocol/keys/key_rows.h"
#include "experiment/protocol/step_settings.h"

namespace overt {

namespace {

ValueResult read_opening(const TomlValue& value, const KeyRule& rule, void* out) {
    auto& opening = *static_cast<AnswerOpening*>(out);
    using From = AnswerOpening::From;
    double seconds = 0.0;
    if (const auto* const word = std::get_if<std::string>(&value.content)) {
        if (*word == "onset" || *word == "offset" || *word == "screen") {
            opening.from = *word == "onset" ? From::onset : *word == "offset" ? From::offset : From::screen;
            return std::nullopt;
        }
        return ValueFault{value.place, fmt::format("{}: unknown value \"{}\"", rule.name, *word),
                          "write \"onset\", \"offset\", \"screen\", or seconds after the stimulus's onset"};
    }
    if (ValueResult fault = value_type(TypeTag<double>()).read(value, KeyRule{{}, rule.name, {}}, &seconds))
        return fault;
    if (seconds < 0.0 || seconds > longest_step_s)
        return ValueFault{
            value.place,
            fmt::format("{}: {:g} s after the stimulus's onset is no time of a trial", rule.name, seconds)};
    opening = {From::onset, seconds};
    return std::nullopt;
}

nlohmann::ordered_json opening_schema(const KeyRule&) {
    return {{"anyOf", {{{"enum", {"onset", "offset", "screen"}}}, {{"type", "number"}, {"minimum", 0}}}}};
}

ValueResult read_match_start(const TomlValue& value, const KeyRule& rule, void* out) {
    auto& start = *static_cast<MatchStart*>(out);
    using From = MatchStart::From;
    if (const auto* const word = std::get_if<std::string>(&value.content)) {
        if (*word == "drawn" || *word == "low" || *word == "high") {
            start = {*word == "drawn" ? From::drawn : *word == "low" ? From::low : From::high, {}};
            return std::nullopt;
        }
        return ValueFault{value.place, fmt::format("{}: unknown value \"{}\"", rule.name, *word),
                          "write \"drawn\", \"low\", \"high\", or the number of a level, of two columns two"};
    }
    start.from = From::values;
    return value_type(TypeTag<std::vector<double>>()).read(value, KeyRule{{}, rule.name, {}}, &start.values);
}

nlohmann::ordered_json match_start_schema(const KeyRule&) {
    return {{"anyOf",
             {{{"enum", {"drawn", "low", "high"}}},
              {{"type", "number"}},
              {{"type", "array"}, {"items", {{"type", "number"}}}}}}};
}

constexpr ValueType match_start_type{"a level", read_match_start, match_start_schema, nullptr};

constexpr ValueType opening_type{"a time", read_opening, opening_schema, nullptr};

} // namespace

const ValueType& value_type(TypeTag<AnswerOpening>);
const ValueType& value_type(TypeTag<AnswerOpening>) { return opening_type; }
const ValueType& value_type(TypeTag<MatchStart>);
const ValueType& value_type(TypeTag<MatchStart>) { return match_start_type; }

namespace key_rows {

std::vector<Key> answer() {
    using A = TaskAnswer;
    return {
        {"id", &A::id, identifier().required(), "Short name, by which steps and tables call it."},
        {"kind", &A::kind, required(), explanation_of_kinds<AnswerKind>()},
        {"question", &A::question, left_out("none"),
         "What stands above it; the task's own `question` is shown before the stimulus."},
        {"required", &A::is_required,
         "Whether it can be passed over by the key that accepts. Time can be up all the same."},
        {"choices", &A::choices, left_out("of a key: the keys themselves"),
         "What can be chosen: words, as tables have them, or ids of slots. In the order of the keys."},
        {"labels", &A::labels, left_out("the choices; slots by their titles"),
         "The choices, or the steps of a scale, as the observer reads them; one for each."},
        {"keys", &A::keys,
         left_out("of a scale of up to 9 steps: the digits; of a match: left, right, and down, up"),
         "A key for each choice or step, in the same order; of a match, for each column one to less and one "
         "to "
         "more: a letter or a digit, `space`, `left`, or a "
         "button "
         "as its box calls it."},
        {"with", &A::with, "Whether it is given with keys, with the mouse, or with either."},
        {"beside_up_deg", &A::beside_up_deg, range(-60, 60, "deg").left_out("it is not seen meanwhile"),
         "While the stimulus is shown, and a step with `until = \"answer\"` waits for it: it stands beside "
         "it, "
         "with its middle so high above the screen's; below are negative numbers. Needed for the mouse."},
        {"accept", &A::accept, left_out("by-key for lines, scales, numbers and texts; else at-once"),
         "Whether what was chosen stands at once, or until `accept_key` is pressed."},
        {"accept_key", &A::accept_key, "The key that accepts."},
        {"steps", &A::steps, range(2, 101).left_out("a line"),
         "Of a scale: how many steps it has. Without, it is a line with a marker."},
        {"min", &A::min, left_out("1 with steps, 0 of a line; of a number: none"),
         "Value of the low end, or the least number."},
        {"max", &A::max, left_out("`steps`, or 100 of a line; of a number: none"),
         "Value of the high end, or the largest number."},
        {"step", &A::step, range(1e-9, 1e9).left_out("a line: 1/100 by keys, any place by the mouse"),
         "To multiples of it from `min` a line or a number is kept."},
        {"ends", &A::ends, left_out("none"),
         "Words at the low and the high end of a scale; more are spread evenly over it."},
        {"of", &A::items, left_out("one"),
         "Items that are answered on this scale, each an answer of its own in the record."},
        {"order", &A::order, "Whether they come as written, or in an order drawn for each trial."},
        {"per_screen", &A::per_screen, range(0, 50), "How many of them stand on a screen; 0: all."},
        {"ticks", &A::ticks, range(0, 101), "Ticks on a line. Answers are drawn to them."},
        {"direction", &A::direction, "At which side the high end stands."},
        {"shows_value", &A::shows_value, "Whether the marker's value stands beside it."},
        {"unit", &A::unit, left_out("none"), "What stands behind a number."},
        {"longest", &A::longest, range(1, 4000), "Characters of a text."},
        {"by", &A::by,
         "Of a point: the place of a click, where gaze was when one of `keys` was pressed, or the last "
         "fixation that began before."},
        {"probe", &A::probe, identifier().left_out("the task's only one"),
         "Of a gauge: the probe whose place it stands at."},
        {"size_deg", &A::size_deg, range(0.05, 20, "deg"),
         "Of a gauge: the radius of its circle where that is seen from the front, and the length of its "
         "rod. It is drawn in the perspective of the camera."},
        {"slant_per_px_deg", &A::slant_per_px_deg, range(0.01, 20, "deg"),
         "Of a gauge: by how much the rod leans for a pixel by which the mouse is dragged, in the direction "
         "of "
         "the drag."},
        {"key_step_deg", &A::key_step_deg, range(0.1, 45, "deg"),
         "Of a gauge: by how much an arrow key leans it."},
        {"undo_key", &A::undo_key, "Of a gauge or a match: the key that takes back the last change."},
        {"slot", &A::slot, identifier().left_out("the task's only one"),
         "Of a match: id of the slot whose stimulus is set."},
        {"along", &A::along, left_out("needed for a match"),
         "Of a match: the column of materials or lights whose numbers are gone through, such as that of a "
         "series; or two, each value of the one with each of the other. What is shown are entries of the "
         "protocol, rendered beforehand like all others, with the same values in their other columns."},
        {"shows", &A::shows, left_out("as the trial has it; in an empty slot what it shows first"),
         "Of a match: the entry of a list that stands in its slot, `{ light = \"hall\" }`, whatever the "
         "trial "
         "has there."},
        {"start", &A::start, left_out("drawn"),
         "Of a match: the level that a trial begins with: `drawn` for each trial, `low`, `high`, or a "
         "level."},
        {"coarse_keys", &A::coarse_keys,
         left_out("page down, page up, where `keys` are left out, of one column"),
         "Of a match: keys that go by `coarse_steps` levels at once, in the order of `keys`."},
        {"coarse_steps", &A::coarse_steps, range(2, 1000), "Of a match: so many levels at once."},
        {"opens", &A::opens,
         left_out("onset where a step with `until = \"answer\"` shows the stimulus, else screen"),
         "When presses begin to count: with the onset of the stimulus, with its offset, with the answer's "
         "own "
         "screen, or so many seconds after the onset. Earlier ones are recorded and do not answer, nor does "
         "a "
         "key that was held since."},
        {"limit_s", &A::limit_s, range(0.01, 3600, "s").left_out("as long as the trial's steps say"),
         "How long presses count, from then on."},
        {"zero", &A::zero, left_out("stimulus where the window opens by its onset, else window"),
         "What the response time counts from. The record has all three."},
        {"counts", &A::counts, "Which of several presses in the window is the answer."},
        {"ends_stimulus", &A::ends_stimulus,
         "Whether a step with `until = \"answer\"` ends with the answer, or goes on for its time."},
        {"ends_step", &A::ends_step,
         "Whether the step `answer` ends with the answer, or when its time is up."},
        {"mapping", &A::mapping,
         "Whether keys mean the same in all trials. Else choices go round over the keys, and the ends of a "
         "scale change sides: over trials, each equally often, or from observer to observer. The record has "
         "the meaning and the key."},
        {"correct", &A::correct, left_out("what the trial says: its rule, its table, or the list drawn"),
         "The correct answer: a choice or a number, `column:NAME` for a column of the table of trials or of "
         "the stimulus's entries, or `none`."},
        {"missed", &A::missed, "Whether a missing answer is neither right nor wrong, or wrong."},
    };
}

std::vector<Key> answer_truth() {
    using T = AnswerTruth;
    return {
        {"by", &T::by, left_out("none"),
         "A factor whose levels are numbers: of choices among slots, their levels are compared."},
        {"slope", &T::slope, range(-1e6, 1e6),
         "Of choices: how many standard deviations of the judgement a unit of the factor is; among two slots "
         "that differ by d, the larger is chosen with the probability of a normal number below slope * d."},
        {"bias", &T::bias, range(-100, 100),
         "Of choices: on top of the first slot's, or of the judgement, in standard deviations."},
        {"lapses", &T::lapses, range(0, 1), "Of choices: share that is chosen by chance."},
        {"share_correct", &T::share_correct, range(0, 1),
         "Of choices without `by`, where something is correct: how often that is chosen."},
        {"offset", &T::offset, left_out("the scale's middle; 0 with `by`"),
         "Of scales and numbers: the judgement at level 0; of words, the level of indifference."},
        {"gain", &T::gain, range(-1e6, 1e6), "How much the judgement grows with a unit of the factor."},
        {"noise", &T::noise, range(0, 1e6), "Standard deviation of the judgement."},
        {"start_bias", &T::start_bias, range(0, 1),
         "Of matches: by which share of the way what is set is drawn to the level that it began with."},
        {"shear", &T::shear, range(-10, 10),
         "Of a gauge: what is added to how much the depth rises to the right and upwards. `gain` is a factor "
         "on "
         "the true rise, and `noise` stands in it as well."},
        {"cuts", &T::cuts, left_out("the nearest step"),
         "Of a scale with steps: judgements between steps, in rising order, one fewer than steps."},
        {"shift_s", &T::shift_s, range(0, 60, "s"), "Shortest response time, from the window's begin."},
        {"median_s", &T::median_s, range(0.001, 600, "s"), "Median of what is added to it, log-normal."},
        {"log_sd", &T::log_sd, range(0, 3), "Standard deviation of its logarithm."},
        {"time_by", &T::time_by, left_out("none"),
         "A factor whose levels are numbers, such as the set size of a search, with which times grow."},
        {"time_gain_s", &T::time_gain_s, range(-60, 60, "s"), "By how much, for a unit of it."},
        {"early", &T::early, range(0, 1), "Share of trials with a press before the window, too."},
        {"late", &T::late, range(0, 1), "Share that is answered after the window has closed."},
        {"missing", &T::missing, range(0, 1), "Share that is not answered."},
        {"observer_sd", &T::observer_sd, range(0, 1e6),
         "Standard deviation over observers of what is on top of each one's judgements: of choices by a "
         "factor in standard deviations of the judgement, of scales and numbers in their own units."},
        {"look_share", &T::look_share, range(0, 1).left_out("all alike"),
         "Of choices among slots: share of the fixations on the slot that is going to be chosen, while all "
         "of "
         "them are lit."},
        {"look_area", &T::look_area, identifier().left_out("none"),
         "Of choices: an area that is looked at more, or less, before the first choice than before others; "
         "the task has a share for it (`simulated_area_shares`)."},
        {"look_odds", &T::look_odds, range(0.001, 1000),
         "How many times the odds of a fixation on `look_area` before the first choice."},
    };
}

} // namespace key_rows

} // namespace overt
