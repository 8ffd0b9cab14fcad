/// What is asked in a trial and how it is answered, as [[task.answer]] states it. Explained key by key in
/// experiment/protocol/keys/answer_keys.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiment/base/enum_names.h"
#include "experiment/base/named_words.h"
#include "experiment/ports/given_answer.h"

namespace overt {

enum class AnswerKind : std::uint8_t {}; ///< counts the rows of its table, answer_kinds.h

/// With what it is answered.
enum class AnsweredWith : std::uint8_t { keys, mouse, both };
template <>
inline constexpr auto names_of<AnsweredWith> = enum_names<AnsweredWith>("keys", "mouse", "keys-and-mouse");

/// Whether what was chosen stands at once, or when a further key accepts it.
enum class AnswerAccept : std::uint8_t { at_once, by_key };
template <> inline constexpr auto names_of<AnswerAccept> = enum_names<AnswerAccept>("at-once", "by-key");

/// Which of several presses in the window is the answer.
enum class AnswerCounts : std::uint8_t { first, last };
template <> inline constexpr auto names_of<AnswerCounts> = enum_names<AnswerCounts>("first", "last");

enum class ScaleDirection : std::uint8_t { left_to_right, right_to_left };
template <>
inline constexpr auto names_of<ScaleDirection> = enum_names<ScaleDirection>("left-to-right", "right-to-left");

/// Whether keys mean the same in all trials of all observers; else choices go round over the keys, and the
/// ends of a scale change sides.
enum class AnswerMapping : std::uint8_t {
    fixed,
    crossed, ///< over trials: each equally often, drawn
    observer ///< from observer to observer, by number: the same in all their sessions
};
template <>
inline constexpr auto names_of<AnswerMapping> = enum_names<AnswerMapping>("fixed", "crossed", "observer");

enum class ItemOrder : std::uint8_t { fixed, drawn };
template <> inline constexpr auto names_of<ItemOrder> = enum_names<ItemOrder>("fixed", "drawn");

/// What becomes of a missing answer's correctness.
enum class MissedAnswer : std::uint8_t { apart, wrong };
template <> inline constexpr auto names_of<MissedAnswer> = enum_names<MissedAnswer>("apart", "wrong");

/// What tells the place of an answer that is a point.
enum class PointedBy : std::uint8_t {
    mouse,   ///< a click on it
    gaze,    ///< where gaze was when a key was pressed
    fixation ///< the last fixation that began before
};
template <> inline constexpr auto names_of<PointedBy> = enum_names<PointedBy>("mouse", "gaze", "fixation");

/// When presses begin to count.
struct AnswerOpening {
    enum class From : std::uint8_t {
        usual,  ///< with the stimulus where that waits for the answer, else with the answer's screen
        onset,  ///< of the stimulus, and `after_s` later
        offset, ///< of the stimulus
        screen
    };
    From from = From::usual;
    double after_s = 0.0;
};

/// What simulated observers answer, for a study to find: `simulated` of [[task.answer]].
struct AnswerTruth {
    std::string by; ///< a factor whose levels are numbers; empty: none
    // Of choices. Among slots: the one with the largest slope x level + noise, of which the difference of two
    // has a standard deviation of 1; the first has `bias` on top. Among words: the middle one, and as many
    // further as slope x (level - offset) + bias + noise says.
    double slope = 1.0, bias = 0.0;
    double lapses = 0.0;        ///< share of answers by chance
    double share_correct = 0.9; ///< without `by`, where something is correct
    // Of scales and numbers: offset + gain x level + noise x normal.
    std::optional<double> offset;
    double gain = 1.0, noise = 0.0;
    /// Of a gauge, two numbers that are added to the depth's rise to the right and upwards, of which `gain`
    /// is a factor and `noise` the standard deviation; empty: 0.
    std::vector<double> shear;
    /// Of matches: offset + gain x reference + noise x normal, drawn towards the start by this share.
    double start_bias = 0.0;
    std::vector<double> cuts; ///< of a scale with steps: as many steps up as cuts lie below that
    // From the window's begin: shift + log-normal + time_gain_s x level.
    double shift_s = 0.25, median_s = 0.6, log_sd = 0.35;
    std::string time_by; ///< a factor whose levels are numbers; empty: none
    double time_gain_s = 0.0;
    // Shares of trials.
    double early = 0.0;   ///< with a press before the window, too
    double late = 0.0;    ///< answered after the window closed
    double missing = 0.0; ///< not answered
    /// Standard deviation over observers of what is on top of the judgement: of choices in standard
    /// deviations of the judgement, else in units of the answer.
    double observer_sd = 0.0;
    // Where they look while they come to a choice.
    std::optional<double>
        look_share;         ///< of the fixations, on the slot that will be chosen; nothing: all alike
    std::string look_area;  ///< looked at more, or less, before the first choice than before others
    double look_odds = 1.0; ///< times the odds of a fixation on it before the first choice
};

/// Where a match begins.
struct MatchStart {
    enum class From : std::uint8_t {
        drawn, ///< each level equally probable, for each trial
        low,
        high,
        values ///< those of `values`, one for each column
    };
    From from = From::drawn;
    std::vector<double> values;
};

struct TaskAnswer {
    std::string id;
    AnswerKind kind{};
    std::string question;    ///< empty: none stands above it
    bool is_required = true; ///< it is not passed over; time can still be up
    // Of key and choice; ids of slots or words, as the record has them, and as the observer reads them.
    std::vector<std::string> choices, labels;
    std::vector<std::string> keys; ///< one for each choice, or for each step of a scale
    AnsweredWith with = AnsweredWith::keys;
    /// Of what can be given while the stimulus is shown: how high it stands beside it; nothing: unseen.
    std::optional<double> beside_up_deg;
    std::optional<AnswerAccept> accept; ///< left out: see accepts_by_key()
    std::string accept_key = "enter";
    // Of scale and number.
    std::optional<int> steps; ///< nothing: a line without steps
    std::optional<double> min, max, step;
    std::vector<std::string> ends;
    std::vector<std::string> items; ///< `of`: each is asked on the same scale
    ItemOrder order = ItemOrder::fixed;
    int per_screen = 0; ///< 0: all at once
    int ticks = 0;
    ScaleDirection direction = ScaleDirection::left_to_right;
    bool shows_value = false;
    std::string unit;  ///< of a number
    int longest = 500; ///< characters of a text
    // Of a gauge.
    std::string probe;             ///< whose place it stands at: an id; empty: the task's only one
    double size_deg = 0.6;         ///< radius of its circle, seen from the front, and length of its rod
    double slant_per_px_deg = 1.0; ///< that a drag of the mouse by a pixel gives
    double key_step_deg = 3.0;     ///< that an arrow leans it
    std::string undo_key = "backspace";
    PointedBy by = PointedBy::mouse; ///< of a point
    // Of a match.
    std::string slot;               ///< id of the slot whose stimulus is set
    std::vector<std::string> along; ///< columns with numbers, one or two
    NamedWords shows;               ///< the entries in a slot that trials leave empty, by list
    MatchStart start;
    std::vector<std::string> coarse_keys; ///< empty: see match_keys()
    int coarse_steps = 5;
    // The window.
    AnswerOpening opens;
    std::optional<double> limit_s; ///< after it opened
    std::optional<AnswerZero> zero;
    AnswerCounts counts = AnswerCounts::first;
    bool ends_stimulus = true, ends_step = true;
    AnswerMapping mapping = AnswerMapping::fixed;
    std::string correct; ///< a value, "column:NAME", "none"; empty: as the trial has it
    MissedAnswer missed = MissedAnswer::apart;
    AnswerTruth truth;

    /// Lines, numbers and texts are accepted by a key of their own unless the protocol says otherwise.
    bool accepts_by_key() const;
    /// Values of a scale's ends, and of the steps between: of `steps` 1 … steps, else 0 … 100.
    double low() const { return min.value_or(steps ? 1.0 : 0.0); }
    double high() const { return max.value_or(steps ? low() + *steps - 1 : 100.0); }
    /// Of a step, from 0 at the low end.
    double number_of_step(int index) const {
        return *steps > 1 ? low() + (high() - low()) * index / (*steps - 1) : low();
    }
    /// That chooses a step: as written, else the digits from 1. Empty: none does.
    std::string key_of_step(int index) const;
    bool is_choice() const { return !choices.empty(); }
    /// Of a match: for each column the key to less and the key to more, as written, else the arrows.
    std::vector<std::string> match_keys() const;
    /// The same by `coarse_steps` levels; where nothing is written, of one column page down and page up.
    std::vector<std::string> match_coarse_keys() const;
};

} // namespace overt
