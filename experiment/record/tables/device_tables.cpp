/// What response boxes and outputs of markers did, as tables.
#include "experiment/record/tables/session_tables.h"

namespace overt {
namespace {

TableColumn trial_number() {
    return {"trial", "Position of the trial in the observer's order, from 1; n/a outside of trials", "", {}};
}

constexpr auto trial_cell = [](auto& to, const auto& row) {
    row.trial < 0 ? to.missing() : to.integer(row.trial + 1);
};

void optional_refresh(TableCells& to, const std::optional<int>& refresh) {
    refresh ? to.integer(*refresh) : to.missing();
}

} // namespace

RowLayout<RecordedButton> buttons_layout() {
    return {
        "buttons",
        "What was done at response boxes, in all attempts and between trials.",
        {
            {session_seconds("time_s", "When it happened"), [](auto& to, auto& row) { to.seconds(row.at); }},
            {{"uncertainty_s", "So far at most time_s is off", "s", {}},
             [](auto& to, auto& row) { to.seconds(row.uncertainty); }},
            {trial_number(), trial_cell},
            {{"box", "The box, as the protocol calls it", "", {}},
             [](auto& to, auto& row) { to.text(row.box); }},
            {{"used_by",
              "In whose hand it lay",
              "",
              {{"observer", "Answers for the observer"}, {"operator", "Leads the session"}}},
             [](auto& to, auto& row) { to.word(row.is_operators ? "operator" : "observer"); }},
            {{"button", "Its number, as the box has it", "", {}},
             [](auto& to, auto& row) { to.integer(row.button); }},
            {{"name", "What is written on it", "", {}}, [](auto& to, auto& row) { to.text(row.name); }},
            {{"change", "What it did", "", {{"down", "It was pressed"}, {"up", "It was let go"}}},
             [](auto& to, auto& row) { to.word(row.is_down ? "down" : "up"); }},
            {{"meaning", "What it means by the protocol; empty: nothing", "", {}},
             [](auto& to, auto& row) { to.text(row.meaning); }},
            {{"device_time_us", "By the box's own clock, where it has one", "us", {}},
             [](auto& to, auto& row) {
                 row.device_time ? to.integer(row.device_time->time_since_epoch().count()) : to.missing();
             }},
        }};
}

RowLayout<RecordedMarker> markers_layout() {
    return {"markers",
            "What other devices were told of the session's events, and when.",
            {
                {session_seconds("time_s", "When what it marks happened"),
                 [](auto& to, auto& row) {
                     // What was never shown happened never.
                     row.planned_refresh && !row.shown_refresh ? to.missing() : to.seconds(row.at);
                 }},
                {trial_number(), trial_cell},
                {{"output", "Where it was sent, as the protocol calls it", "", {}},
                 [](auto& to, auto& row) { to.text(row.output); }},
                {{"text", "What it marks", "", {}}, [](auto& to, auto& row) { to.text(row.text); }},
                {{"code", "The code that was sent; n/a: the text alone", "", {}},
                 [](auto& to, auto& row) { row.code == 0 ? to.missing() : to.integer(row.code); }},
                {{"sent",
                  "What became of it",
                  "",
                  {{"yes", "The system, or the picture, took it"}, {"no", "It was not sent"}}},
                 [](auto& to, auto& row) { to.word(row.is_sent ? "yes" : "no"); }},
                {session_seconds("not_before_s", "It was sent, or that was tried, not before"),
                 [](auto& to, auto& row) {
                     row.not_after == SessionTime() ? to.missing() : to.seconds(row.not_before);
                 }},
                {session_seconds("not_after_s",
                                 "And not after; of an output that rides on the picture, the begin of "
                                 "its refresh and the protocol's offset_ms (of earlier programs "
                                 "without it)"),
                 [](auto& to, auto& row) {
                     row.not_after == SessionTime() ? to.missing() : to.seconds(row.not_after);
                 }},
                {{"planned_refresh", "The refresh of the animation that it was meant for, from 0", "", {}},
                 [](auto& to, auto& row) { optional_refresh(to, row.planned_refresh); }},
                {{"shown_refresh", "The one at which it came", "", {}},
                 [](auto& to, auto& row) { optional_refresh(to, row.shown_refresh); }},
            }};
}

} // namespace overt
