#include <algorithm>

#include "experiment/design/rules/ascending_levels.h"
#include "experiment/design/rules/trial_rules.h"

namespace overt {

namespace {

/// Maloney and Yang, "Maximum likelihood difference scaling", Journal of Vision 3(8), 2003, with a stimulus
/// in common: does b differ more from a, or from c?
class TriadsRule : public CombiningRule {
  public:
    using CombiningRule::CombiningRule;

    std::vector<RuleProblem> problems() const override {
        std::vector<RuleProblem> found;
        require_slots(request(), 3, "triads", found);
        require_one_factor(request(), "triads", found);
        return found;
    }

  protected:
    Combinations combinations() const override { return ascending_sets(request(), 3); }
    int ways() const override { return 2; }
    RuledTrial place(std::span<const int> triad, int way, RandomStream&) const override {
        RuledTrial trial;
        trial.shown.assign(triad.begin(), triad.end());
        if (way == 1)
            std::swap(trial.shown.front(), trial.shown.back());
        trial.side = 2 * way;
        return trial;
    }
};

} // namespace

std::unique_ptr<TrialRule> triads_rule(const RuleRequest& request) {
    return std::make_unique<TriadsRule>(request);
}

} // namespace overt
