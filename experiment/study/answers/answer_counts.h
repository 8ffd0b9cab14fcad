/// Answers as counts over the levels of a factor: what psychometric functions are fitted to.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "experiment/fits/difference_scaling.h"
#include "experiment/fits/psychometric_fit.h"
#include "experiment/study/results/answer_rows.h"

namespace overt {

using AnswerList = std::vector<const StudyAnswer*>;

/// The counts of one curve.
struct CurveCounts {
    std::string factor;
    std::string yes;        ///< which answers are counted, over which level, in words
    bool is_forced = false; ///< at its worst the answer is a guess between two slots
    std::vector<LevelCount> trials;
};

/// Factors of numbers of which an observer's answers can be a function: those with three levels at least, of
/// answers about one stimulus or two. None where trials show different numbers of stimuli.
std::set<std::string> curve_factors(const AnswerList& answers);

/// Choices among three or four slots as judged differences: the levels there are, rising, and how often the
/// upper pair of places among them was chosen.
struct DifferenceCounts {
    std::vector<double> series;
    std::vector<DifferenceCount> counts;
    int judged = 0;
};

/// `weights`: how much each answer counts; empty: one each. Answers without an order of levels are left out.
DifferenceCounts difference_counts(const AnswerList& answers, const std::string& factor,
                                   std::span<const double> weights);

/// Of choices between two slots one curve, of choices about one stimulus one for each choice but the last of
/// two; none where there is nothing to count. See answer_curves().
std::vector<CurveCounts> curve_counts(const AnswerList& answers, const std::string& factor);

/// By maximum likelihood; the guess rate one half and the lapse rate free where they are forced, else both 0.
/// Nothing with fewer than three levels.
std::optional<PsychometricFit> fit_curve(const CurveCounts& counts);

/// The fit's threshold, unless it has no slope or lies farther beyond the levels than these reach: a number
/// that means nothing would spoil any mean.
std::optional<double> sound_threshold(const PsychometricFit& fit, std::span<const LevelCount> levels);

} // namespace overt
