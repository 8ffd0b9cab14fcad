/// What observers answered, and what follows from it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiment/statistics/estimate.h"

namespace overt {

/// One stimulus of an answered trial.
struct AnsweredStimulus {
    std::string slot; ///< id
    std::vector<std::pair<std::string, std::string>>
        levels;                                          ///< of each factor of stimuli with several levels
    std::vector<std::pair<std::string, double>> numbers; ///< of those whose levels are numbers

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
};

/// What all rows say first: of one observer, or of all (empty).
struct AnswerOf {
    std::string observer, task, answer, item;
    friend auto operator<=>(const AnswerOf&, const AnswerOf&) = default;
};

/// How often, how right and how fast.
struct AnswerSummaryRow {
    AnswerOf of;
    int trials = 0, missed = 0;
    Estimate correct; ///< share of those that are right or wrong
    /// Of two choices of which one is right in each trial; log-linear correction.
    std::optional<double> d_prime = {}, d_prime_se = {}, criterion = {};
    std::optional<double> median_response_s = {}, mean_response_s = {};
    std::optional<double> ex_mu_s = {}, ex_sigma_s = {},
                          ex_tau_s = {}; ///< ex-Gaussian, with 40 times at least
};

/// How often a choice was made.
struct AnswerChoiceRow {
    AnswerOf of;
    std::string choice;
    int chosen = 0, answered = 0;
    Estimate share;
};

/// A psychometric function over a factor.
struct AnswerCurveRow {
    AnswerOf of;
    std::string factor;
    std::string yes; ///< which answers are counted, over which level
    double guess = 0.0;
    int trials = 0, levels = 0;
    Estimate threshold; ///< where F is one half
    std::optional<double> threshold_se = {}, slope = {}, slope_se = {}, lapse = {};
    std::optional<double> deviance = {}, pearson_x2 = {}, deviance_limit = {};
    int degrees = 0, failures = 0; ///< of freedom; samples of the bootstrap without a slope
    std::string note;
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
};

struct StudyAnswers {
    std::vector<StudyAnswer> given;
    std::vector<AnswerSummaryRow> summaries;
    std::vector<AnswerChoiceRow> choices;
    std::vector<AnswerCurveRow> curves;
    std::vector<AnswerScaleRow> scales;
    std::vector<AnswerRatingRow> ratings;
};

} // namespace overt
