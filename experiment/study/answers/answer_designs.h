/// How answers that are right or wrong come about, told by what was shown, and their sensitivity.
#pragma once

#include <optional>
#include <string>

#include "experiment/fits/detection.h"
#include "experiment/study/answers/answer_counts.h"

namespace overt {

struct SensitivityEstimate {
    double d_prime = 0.0;
    std::optional<double> se = {}, criterion = {};
};

/// d' and criterion where two answers are right by turns; the first in the order of words is taken for the
/// signal. Choices of slots as two alternatives. Nothing where there are others.
std::optional<SensitivityEstimate> d_prime_of(const AnswerList& answers);

/// A design in which d' is not that of yes-no or of two alternatives.
struct AnswerDesign {
    enum class Kind : std::uint8_t {
        same_different, ///< two stimuli, and whether they are alike: differencing
        abx,            ///< which of two slots is like the one that is never right: differencing
        oddity,         ///< which of three is unlike the two others, either kind being the odd one by turns
        alternatives    ///< which of `slots` has what is looked for
    };
    Kind kind = Kind::alternatives;
    int slots = 3;
    std::string different; ///< of same_different: the answer that is right of unlike stimuli
    std::string name() const;
};

/// By the stimuli, and by which answers were right of them. Nothing where no such design fits all trials.
std::optional<AnswerDesign> answer_design(const AnswerList& answers);

/// d' by the design, with the log-linear correction; nothing without answers.
std::optional<SensitivityEstimate> d_prime_by(const AnswerDesign& design, const AnswerList& answers);

} // namespace overt
