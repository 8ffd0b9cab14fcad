/// What observers answered, and what follows from it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiment/ports/given_answer.h"
#include "experiment/statistics/estimate.h"
#include "experiment/statistics/paired_evidence.h"

namespace overt {

/// One stimulus of an answered trial.
struct AnsweredStimulus {
    std::string slot; ///< id
    std::vector<std::pair<std::string, std::string>>
        levels;                                          ///< of each factor of stimuli with several levels
    std::vector<std::pair<std::string, double>> numbers; ///< of those whose levels are numbers
    std::optional<double> until_answer_s =
        {}; ///< from its onset to the answer; nothing: missed, or not lit before

    std::optional<double> number(const std::string& factor) const;
};

/// One answer, or one item of a scale, of a trial that gives results.
struct StudyAnswer {
    std::string observer, task;
    std::string answer, item; ///< ids; no item: empty
    std::string kind;
    std::string value, correct;
    bool is_missed = true;
    std::optional<bool> is_correct;
    std::optional<double> number, response_s;
    std::vector<AnsweredStimulus> shown;
    int session = 0; ///< index into StudyResults::sessions
    int trial = 0;   ///< StudyTrial::number
    /// Of each factor in which trials differ: those of their own, and those in which all that is shown is
    /// alike.
    std::vector<std::pair<std::string, std::string>> levels;
    std::string procedure, procedure_factor; ///< that chose the level of a factor; empty: none did
    int track = 0;                           ///< the condition of the task's that it was of, from 1

    /// Its level of a factor; empty: it has none.
    const std::string& level(const std::string& factor) const;
    std::vector<MatchSetting> settings = {}; ///< of a match, one for each of its columns
};

/// It is to be one of several choices, whether or not it was given.
bool asks_for_choice(const StudyAnswer& answer);

/// It was given, and is one of several choices: places, words and numbers are none.
bool is_choice(const StudyAnswer& answer);

/// A judgement in numbers. What a match or a gauge is set to is none: a number there says what was shown.
bool is_rating(const StudyAnswer& answer);

/// What all rows say first: of one observer, or of all (empty).
struct AnswerOf {
    std::string observer, task, answer, item;
    friend auto operator<=>(const AnswerOf&, const AnswerOf&) = default;
};

/// How often, how right and how fast.
struct AnswerSummaryRow {
    AnswerOf of;
    int trials = 0, missed = 0;
    Estimate correct;                           ///< share of those that are right or wrong
    std::optional<double> planted_correct = {}; ///< of simulated observers
    /// Of two choices of which one is right in each trial; log-linear correction.
    std::optional<double> d_prime = {}, d_prime_se = {}, criterion = {};
    /// How answers come about, by what was shown: "ABX", "same-different", "oddity", "3 alternatives"; and
    /// the sensitivity by that design; empty: as d_prime has it.
    std::string design = {};
    std::optional<double> design_d_prime = {}, design_d_prime_se = {};
    std::optional<double> median_response_s = {}, mean_response_s = {};
};

/// How often a choice was made.
struct AnswerChoiceRow {
    AnswerOf of;
    std::string choice;
    int chosen = 0, answered = 0;
    Estimate share;
};

/// Answers at a level of a psychometric function.
struct AnswerCurvePoint {
    double level = 0.0, trials = 0.0, yes = 0.0;
    Interval share;               ///< Wilson's interval of yes / trials
    std::optional<double> fitted; ///< what the function has there
};

/// A psychometric function over a factor.
struct AnswerCurveRow {
    AnswerOf of;
    std::string factor;
    std::string column, level; ///< of trials of this level of another factor alone; empty: of all
    std::string yes;           ///< which answers are counted, over which level
    double guess = 0.0;
    int trials = 0, levels = 0;
    Estimate threshold; ///< where F is one half
    std::optional<double> threshold_se = {}, slope = {}, slope_se = {}, lapse = {};
    std::optional<double> deviance = {}, pearson_x2 = {}, deviance_limit = {};
    int degrees = 0, failures = 0; ///< of freedom; samples of the bootstrap without a slope
    std::string note;
    std::vector<AnswerCurvePoint> points;                             ///< rising; of all observers together
    std::optional<double> planted_threshold = {}, planted_slope = {}; ///< of simulated observers
};

/// A trial of a procedure that chooses levels, and where its track came to.
struct AnswerTrackRow {
    AnswerOf of;
    std::string procedure, factor;
    int track = 0, place = 0; ///< both from 1
    int trial = 0;            ///< StudyTrial::number
    double level = 0.0;
    std::string value; ///< answer; empty: missed
    std::optional<bool> is_correct = {};
    bool is_reversal = false; ///< levels turn there
};

/// A place on a scale made of comparisons.
struct AnswerScaleRow {
    AnswerOf of;
    std::string method; ///< "Bradley-Terry", "Thurstone Case V", "MLDS", "MLCM"
    std::string factor, level;
    Estimate value;
    std::optional<double> se = {};
    std::optional<double> first_slot = {}; ///< what being in the first slot adds, of pairs
    std::optional<double> sigma = {};      ///< noise of the judgement in units of the scale, of MLDS
    int trials = 0;
    bool is_penalised = false;
    std::optional<double> planted = {}; ///< of simulated observers
};

/// Ratings of one level.
struct AnswerRatingRow {
    AnswerOf of;
    std::string factor, level;
    int ratings = 0;
    Estimate mean;
    std::optional<double> sd = {};
    /// Of whole numbers: the level's place by the cumulative probit model, its first level being 0.
    std::optional<double> place = {}, place_se = {};
    std::optional<double> planted = {}; ///< mean that simulated observers mean to give
};

/// Response times of some answers.
struct AnswerTimeRow {
    AnswerOf of;
    std::string which; ///< "all", "correct", "wrong", or a choice
    int times = 0;
    Estimate median_s; ///< of all observers the mean of their medians
    std::optional<double> mean_s = {}, sd_s = {};
    std::vector<double> quantiles_s = {}; ///< as response_quantiles
    // By maximum likelihood, with 40 times at least; the better one has the larger likelihood.
    std::optional<double> ex_mu_s = {}, ex_sigma_s = {}, ex_tau_s = {}, ex_log_likelihood = {};
    std::optional<double> shift_s = {}, log_mean = {}, log_sd = {}, log_normal_log_likelihood = {};
};
inline constexpr double response_quantiles[] = {0.1, 0.3, 0.5, 0.7, 0.9};

/// How often answers are correct by how fast they are.
struct AnswerSpeedRow {
    AnswerOf of;
    int part = 0, parts = 0; ///< fastest: 1, of as many parts of the observer's times
    int trials = 0;
    Estimate correct;
    std::optional<double> mean_response_s = {};
};

/// Two levels of a factor compared within observers by what was answered.
struct AnswerDifferenceRow {
    AnswerOf of;         ///< of all observers
    std::string measure; ///< "threshold of FACTOR", "share correct", "share of CHOICE", "mean", "d'", …
    std::string column, a, b;
    Estimate difference; ///< of a less b: mean over observers
    /// Flips of the signs of observers' differences; after Holm over the rows of the answer's measure.
    std::optional<double> p = {}, p_holm = {};
    PairedEvidence evidence = {};
    int observers = 0;
    std::vector<double> of_observers = {};
    std::optional<double> planted = {}; ///< of simulated observers
};

/// What was answered at a level of a trend's factor.
struct AnswerTrendPoint {
    double x = 0.0;
    Estimate mean;
};

/// A line of what was answered over a factor whose levels are numbers: how much longer answers take with
/// each further stimulus of a search, how memory falls with time.
struct AnswerTrendRow {
    AnswerOf of;
    std::string measure;       ///< "share correct", "mean", "mean response time / s"
    std::string along;         ///< the factor
    std::string column, level; ///< of trials of this level of another factor alone; empty: of all
    /// By least squares over the answers of an observer, of times over those that are not wrong; of all
    /// observers the means of theirs. Per unit of the factor, and at 0.
    Estimate slope, intercept;
    int answers = 0, observers = 1;
    std::vector<AnswerTrendPoint> points; ///< rising
    std::optional<double> planted = {};   ///< slope that simulated observers mean to have
};

/// How alike two levels are: how often they stay together where the odd one of several is chosen.
struct AnswerLikenessRow {
    AnswerOf of;
    std::string factor, a, b; ///< in the order of the alphabet; the same level twice, where two have it
    int trials = 0;           ///< pairs that were shown in a trial that was answered
    int together = 0;         ///< of which neither was chosen
    Estimate share; ///< of an observer Wilson's interval; of all that over observers, or Wilson's where it is
                    ///< wider
    double chance = 0.0;                ///< that they stay together if each is chosen as often
    std::optional<double> planted = {}; ///< of simulated observers
};

/// What was looked at in a trial before an answer was given.
struct AnswerGazeRow {
    std::string observer, task, answer, item, value;
    int session = 0, trial = 0;         ///< as StudyAnswer has them
    std::string slot;                   ///< id
    std::string area;                   ///< empty: all of the stimulus there
    std::optional<bool> is_chosen = {}; ///< the slot was the answer; nothing: no slots to choose from
    double until_s = 0.0;               ///< from the slot's onset to the answer, or to its end before that
    double dwell_s = 0.0;               ///< time of fixation until then
    /// Of the time of fixation on all stimuli of the trial; nothing where there is none.
    std::optional<double> dwell_share = {}, last_second_share = {};
    int visits = 0;
    bool is_first = false, is_last = false; ///< the first fixation on any stimulus, and the last one
    std::optional<double> first_arrival_s = {};
};

/// Whether where observers look goes with what they answer.
struct GazeChoiceRow {
    AnswerOf of;         ///< of an observer, or of all
    std::string measure; ///< "dwell share", "share of the last second", "first look", "last look"
    std::string area;    ///< empty: of slots
    std::string a, b;    ///< answers that are compared; empty: the slot that is chosen with the others
    Estimate value;      ///< of the chosen slot, or of a less b
    double chance = 0.0; ///< that it has if looking and answering have nothing to do with each other
    std::optional<double> p = {}, p_holm = {}; ///< flips of the signs of observers' differences from it
    PairedEvidence evidence = {};              ///< of these differences
    int observers = 0, trials = 0;
    std::vector<double> of_observers = {};
    std::optional<double> planted = {}; ///< of simulated observers
};

/// What was set to look like one level of a reference.
struct AnswerMatchRow {
    AnswerOf of;
    std::string column, level; ///< of trials with this level of a factor; empty: of all
    std::string along;         ///< the column that was set
    double reference = 0.0;
    int settings = 0;
    Estimate match; ///< mean of the settings
    std::optional<double> constant_error = {}, sd = {}, just_noticeable = {};
    double mean_start = 0.0, mean_changes = 0.0, mean_reversals = 0.0;
    int at_end = 0; ///< settings that were stopped at an end of the levels
};

/// The line of settings over references.
struct AnswerMatchLineRow {
    AnswerOf of;
    std::string column, level; ///< of trials with this level of a factor; empty: of all
    std::string along;
    int references = 0, settings = 0;
    Estimate slope, intercept; ///< by least squares
    /// With errors of the same size in both.
    std::optional<double> deming_slope = {}, deming_intercept = {};
    /// How far settings go from a match of the light at the eye to one of the reference itself (Brunswik: 0
    /// none of the way, 1 all), and the same of logarithms (Thouless), where trials say the first.
    Estimate brunswik = {}, thouless = {};
    std::optional<double> planted = {}; ///< slope that simulated observers mean to give
};

struct StudyAnswers {
    std::vector<StudyAnswer> given;
    std::vector<AnswerSummaryRow> summaries;
    std::vector<AnswerChoiceRow> choices;
    std::vector<AnswerCurveRow> curves;
    std::vector<AnswerScaleRow> scales;
    std::vector<AnswerRatingRow> ratings;
    std::vector<AnswerTrackRow> tracks;
    std::vector<AnswerTimeRow> times;
    std::vector<AnswerSpeedRow> speeds;
    std::vector<AnswerDifferenceRow> differences;
    std::vector<AnswerTrendRow> trends;
    std::vector<AnswerLikenessRow> likenesses;
    std::vector<AnswerGazeRow> gaze;
    std::vector<GazeChoiceRow> gaze_choices;
    std::vector<AnswerMatchRow> matches;
    std::vector<AnswerMatchLineRow> match_lines;
};

} // namespace overt
