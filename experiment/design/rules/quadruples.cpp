#include <algorithm>

#include "experiment/design/rules/ascending_levels.h"
#include "experiment/design/rules/trial_rules.h"

namespace overt {

namespace {

/// Maloney and Yang, "Maximum likelihood difference scaling", Journal of Vision 3(8), 2003: do a and b differ
/// more, or c and d? The intervals do not overlap, since the larger of two that do can be seen without
/// judging either.
class QuadruplesRule : public CombiningRule {
  public:
    using CombiningRule::CombiningRule;

    std::vector<RuleProblem> problems() const override {
        std::vector<RuleProblem> found;
        require_slots(request(), 4, "quadruples", found);
        require_one_factor(request(), "quadruples", found);
        return found;
    }

  protected:
    Combinations combinations() const override { return ascending_sets(request(), 4); }
    int ways() const override { return 2; }
    /// The order within each pair, too.
    int drawn_ways() const override { return 8; }
    RuledTrial place(std::span<const int> quadruple, int way, RandomStream&) const override {
        RuledTrial trial;
        trial.shown.assign(quadruple.begin(), quadruple.end());
        if ((way & 2) != 0)
            std::swap(trial.shown[0], trial.shown[1]);
        if ((way & 4) != 0)
            std::swap(trial.shown[2], trial.shown[3]);
        const bool is_upper_first = (way & 1) != 0;
        if (is_upper_first)
            std::rotate(trial.shown.begin(), trial.shown.begin() + 2, trial.shown.end());
        trial.side = is_upper_first ? 2 : 0;
        return trial;
    }
};

} // namespace

std::unique_ptr<TrialRule> quadruples_rule(const RuleRequest& request) {
    return std::make_unique<QuadruplesRule>(request);
}

} // namespace overt
