/// What response boxes, keyboards and outputs of markers did, as tables.
#include "experiment/record/tables/session_tables.h"

namespace overt {
namespace {

TableColumn trial_number() {
    return {"trial", "Position of the trial in the observer's order, from 1; n/a outside of trials"};
}

constexpr auto trial_cell = [](auto& row) { return when(row.trial >= 0, row.trial + 1); };

/// An output that never tried has no times of it.
auto time_of_sending(SessionTime RecordedMarker::*at) {
    return [at](const RecordedMarker& row) { return when(row.not_after != SessionTime(), row.*at); };
}

} // namespace

RowLayout<RecordedButton> buttons_layout() {
    return {"buttons",
            "What was done at response boxes, in all attempts and between trials.",
            {
                {session_seconds("time_s", "When it happened"), &RecordedButton::at},
                {{"uncertainty_s", "So far at most time_s is off", "s"}, &RecordedButton::uncertainty},
                {trial_number(), trial_cell},
                {{"box", "The box, as the protocol calls it"}, &RecordedButton::box},
                {{"used_by",
                  "In whose hand it lay",
                  "",
                  {{"observer", "Answers for the observer"}, {"operator", "Leads the session"}}},
                 [](auto& row) { return row.is_operators ? "operator" : "observer"; }},
                {{"button", "Its number, as the box has it"}, &RecordedButton::button},
                {{"name", "What is written on it"}, &RecordedButton::name},
                {{"change", "What it did", "", {{"down", "It was pressed"}, {"up", "It was let go"}}},
                 [](auto& row) { return row.is_down ? "down" : "up"; }},
                {{"meaning", "What it means by the protocol; empty: nothing"}, &RecordedButton::meaning},
                {{"device_time_us", "By the box's own clock, where it has one", "us"},
                 [](auto& row) { return of_maybe(row.device_time, microseconds_of); }},
            }};
}

RowLayout<RecordedKeyPress> key_presses_layout() {
    std::vector<std::pair<std::string, std::string>> screens;
    for (const auto& [phase, what] :
         {std::pair(SessionPhase::block, "A block's instructions"),
          std::pair(SessionPhase::trial, "Nothing: the stimulus was made ready"),
          std::pair(SessionPhase::task_screen, "The question"),
          std::pair(SessionPhase::stimulus, "The animation, or the empty screen before and after it"),
          std::pair(SessionPhase::response_screen, "The screen on which the answer is given"),
          std::pair(SessionPhase::feedback, "What is said after practice"),
          std::pair(SessionPhase::rest, "A break"), std::pair(SessionPhase::end, "The farewell")})
        screens.emplace_back(name_of(phase), what);
    return {
        "key_presses",
        "Keys and buttons that were pressed in all attempts, in practice and on the screens between trials, "
        "but in no form and at no question to the operator. A key that is held is one press.",
        {
            {session_seconds("time_s", "When it was pressed"), &RecordedKeyPress::at},
            {{"uncertainty_s",
              "Of a keyboard, which is looked at now and then: it was pressed so long before time_s at most; "
              "of "
              "a response box: so far at most time_s is off",
              "s"},
             &RecordedKeyPress::uncertainty},
            {trial_number(), trial_cell},
            {{"screen", "What stood on the screen", "", screens},
             [](auto& row) { return name_of(row.screen); }},
            {{"device", "keyboard, simulated observer, or the response box as the protocol calls it"},
             &RecordedKeyPress::device},
            {{"name", "What is written on it by the keyboard's layout, or what it is called"},
             &RecordedKeyPress::name},
            {{"code", "The keyboard's scancode, or the button's number"}, &RecordedKeyPress::code},
            {{"modifiers", "What was held with it, as shift or control+alt; empty: nothing"},
             &RecordedKeyPress::modifiers},
            {{"text", "What it wrote; empty: nothing"}, &RecordedKeyPress::text},
            {{"meaning",
              "What it means there: next goes on (on the response screen it answers, but not before "
              "response_min_s), else a key of the operator's, or a button's meaning by the protocol; empty: "
              "nothing"},
             &RecordedKeyPress::meaning},
        }};
}

RowLayout<RecordedMarker> markers_layout() {
    return {"markers",
            "What other devices were told of the session's events, and when.",
            {
                {session_seconds("time_s", "When what it marks happened"),
                 // What was never shown happened never.
                 [](auto& row) { return when(!row.planned_refresh || row.shown_refresh, row.at); }},
                {trial_number(), trial_cell},
                {{"output", "Where it was sent, as the protocol calls it"}, &RecordedMarker::output},
                {{"text", "What it marks"}, &RecordedMarker::text},
                {{"code", "The code that was sent; n/a: the text alone"},
                 [](auto& row) { return when(row.code != 0, row.code); }},
                {{"sent",
                  "What became of it",
                  "",
                  {{"yes", "The system, or the picture, took it"}, {"no", "It was not sent"}}},
                 [](auto& row) { return row.is_sent ? "yes" : "no"; }},
                {session_seconds("not_before_s", "It was sent, or that was tried, not before"),
                 time_of_sending(&RecordedMarker::not_before)},
                {session_seconds("not_after_s",
                                 "And not after; of an output that rides on the picture, the begin of "
                                 "its refresh and the protocol's offset_ms (of earlier programs "
                                 "without it)"),
                 time_of_sending(&RecordedMarker::not_after)},
                {{"planned_refresh", "The refresh of the animation that it was meant for, from 0"},
                 &RecordedMarker::planned_refresh},
                {{"shown_refresh", "The one at which it came"}, &RecordedMarker::shown_refresh},
            }};
}

} // namespace overt
