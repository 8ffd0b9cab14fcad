/// What was answered in a block, in words of the protocol.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/ports/given_answer.h"

namespace overt {

/// What was answered in each trial of a block that counts.
using AnsweredTrials = std::vector<std::vector<GivenAnswer>>;

struct AnswerSummary {
    int trials = 0;   ///< in which something was asked
    int answered = 0; ///< all of it was
    int missed = 0;
    int known = 0, correct = 0;     ///< trials that are right or wrong, and those that are right
    std::optional<double> median_s; ///< of the response times of all first answers; nothing: there is none
};
AnswerSummary summary_of(const AnsweredTrials& trials);

/// The words with numbers in place of {percent_correct}, {correct}, {answered}, {missed}, {trials} and
/// {median_s}; a dash where there is none.
std::string in_numbers(std::string words, const AnsweredTrials& trials);

} // namespace overt
