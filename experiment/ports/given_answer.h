/// What an observer answered in an attempt at a trial, and every press that was made meanwhile.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiment/attitude.h"
#include "experiment/base/enum_names.h"
#include "experiment/ports/observer_input.h"
#include "experiment/session_time.h"
#include "experiment/trial.h"

namespace overt {

/// Kind of an answer that is a choice among what is shown: of the one that does not belong. Its name in
/// protocols and records.
inline constexpr std::string_view odd_one_out_kind = "odd-one-out";

/// From where a response time counts.
enum class AnswerZero : std::uint8_t {
    stimulus, ///< the onset of the stimulus shown last
    window,   ///< when answers began to count
    screen    ///< the onset of the answer's own screen
};
template <>
inline constexpr auto names_of<AnswerZero> = enum_names<AnswerZero>("stimulus", "window", "screen");

/// What was set with a gauge figure, beside what is true.
struct GaugeAnswer {
    std::string probe, point; ///< the probe's id and the name of its place
    Attitude start;           ///< drawn
    Attitude set;             ///< when it was accepted, or when time was up
    bool is_at_limit = false; ///< it could not be slanted further
    /// Of the surface at its place in the frame that was lit then; nothing where the object has no mesh.
    std::optional<Attitude> truth = {};
    std::optional<int> frame = {};       ///< that was lit then, where it stands
    std::optional<bool> is_visible = {}; ///< the place was, in that frame

    /// Between the normal that was set and the true one.
    std::optional<Degrees> deviation() const {
        return truth ? std::optional(angle_between(set, *truth)) : std::nullopt;
    }
};

/// What was set along one column of a match.
struct MatchSetting {
    std::string along;                     ///< the column
    double start = 0.0;                    ///< that the slot began with
    double final = 0.0;                    ///< that it was left at
    double low = 0.0, high = 0.0;          ///< the ends of its levels
    std::optional<double> reference = {};  ///< of the stimulus beside it; nothing: that has no such number
    int changes = 0;                       ///< of this column, undoing ones too
    int reversals = 0;                     ///< changes against the direction of the one before
    int stopped_low = 0, stopped_high = 0; ///< inputs that would have gone beyond an end
    friend bool operator==(const MatchSetting&, const MatchSetting&) = default;
};

/// A level of a match: what the slot showed, and which of the columns' values that is.
struct MatchLevel {
    int level = 0;
    Stimulus stimulus;
    std::vector<double> values; ///< one for each column
    friend bool operator==(const MatchLevel&, const MatchLevel&) = default;
};

/// One answer of [[task.answer]], of a scale with several items one of its items. It is a row also where
/// nothing was answered: then it is missed, which is not the same as wrong.
struct GivenAnswer {
    std::string id;   ///< as the protocol has it
    std::string item; ///< of a scale with several; else empty
    std::string kind; ///< as in `answer_kinds`
    bool is_missed = true;
    std::string value = {};            ///< what was meant: a choice, a step's label or number, what was typed
    std::optional<double> number = {}; ///< of a scale and of a number
    std::string key = {}, device = {}; ///< by which it was given, or accepted where it is accepted apart
    /// What a trial says is right, as a value; empty: nothing is, or nobody knows it.
    std::string correct = {};
    std::optional<bool> is_correct = {}; ///< nothing: missed, or nothing is correct

    AnswerZero zero = AnswerZero::window;
    std::optional<SessionTime> stimulus_onset = {}, window_onset = {}, window_end = {}, screen_onset = {};
    std::optional<SessionTime> first_input_at = {};  ///< the first that changed it, in time
    std::optional<SessionTime> answered_at = {};     ///< when it was given, or accepted
    std::optional<SessionDuration> uncertainty = {}; ///< of answered_at; nothing: missed
    bool is_tied = false; ///< two keys that answer differently were pressed at the same time

    int place = 0;   ///< which of the trial's answers and items it was in turn, from 0
    int mapping = 0; ///< by how many places keys, or the sides of a scale, are turned; 0: as written
    int changes = 0; ///< how often it was changed before it stood
    std::optional<GaugeAnswer> gauge = {}; ///< of a gauge, given or missed

    // Of a match, also where it was missed.
    std::vector<MatchSetting> settings = {}; ///< one for each column
    std::vector<MatchLevel> levels = {};     ///< all that could be set
    int slot = -1;                           ///< of the protocol, whose stimulus was set

    /// The instant that its response time counts from; nothing if the trial did not come to it.
    std::optional<SessionTime> zero_at() const {
        return zero == AnswerZero::stimulus ? stimulus_onset
               : zero == AnswerZero::window ? window_onset
                                            : screen_onset;
    }
    /// Negative: before what it counts from. Nothing: missed.
    std::optional<SessionDuration> response_time() const {
        const std::optional<SessionTime> from = zero_at();
        return answered_at && from ? std::optional(*answered_at - *from) : std::nullopt;
    }
};

/// Of a trial as a whole: every answer for which something is correct was; nothing where nothing is, or where
/// one of them is missed and does not count as wrong.
inline std::optional<bool> correctness_of(const std::vector<GivenAnswer>& answers) {
    std::optional<bool> all;
    for (const GivenAnswer& answer : answers) {
        if (answer.correct.empty())
            continue;
        if (!answer.is_correct)
            return std::nullopt;
        all = all.value_or(true) && *answer.is_correct;
    }
    return all;
}

/// Names and values for viewers of a tracker's file, in which a trial has variables: the answer by its id,
/// its time "which_time_ms", and "which_correct" as 1 or 0; of a gauge also "which_slant_deg",
/// "which_tilt_deg" and "which_deviation_deg". Names are without blanks.
std::vector<std::pair<std::string, std::string>> answer_variables(const std::vector<GivenAnswer>& answers);

/// Where an input fell.
enum class InputState : std::uint8_t {
    before, ///< the window opened
    open,
    late ///< after the window closed
};
template <> inline constexpr auto names_of<InputState> = enum_names<InputState>("before", "open", "late");

/// An input of an attempt, as one answer saw it.
struct AnswerInput {
    std::string id, item; ///< of the answer
    ObserverInput input;
    InputState state = InputState::open;
    bool has_counted = false;              ///< it changed the answer, or gave it
    std::optional<double> number;          ///< where a scale's marker stood after it
    std::optional<Attitude> attitude = {}; ///< of a gauge, after it
};

} // namespace overt
