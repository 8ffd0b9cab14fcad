#include "experiment/design/rules/trial_rules.h"

namespace overt {

namespace {

class EveryRule : public CombiningRule {
  public:
    using CombiningRule::CombiningRule;

    std::vector<RuleProblem> problems() const override {
        std::vector<RuleProblem> found;
        if (!request().in.empty())
            require_slot(request(), "in", request().in, found);
        else
            require_slots(request(), 1, "every", found);
        return found;
    }

  protected:
    Combinations combinations() const override {
        Combinations all(1);
        for (int stimulus = 0; stimulus < request().stimuli; ++stimulus)
            all.add({&stimulus, 1});
        return all;
    }
    RuledTrial place(std::span<const int> combination, int, RandomStream&) const override {
        RuledTrial trial;
        trial.shown.assign(request().slots.size(), -1);
        const int slot = request().in.empty() ? 0 : slot_called(request(), request().in);
        trial.shown[static_cast<std::size_t>(slot)] = combination[0];
        return trial;
    }
};

} // namespace

std::unique_ptr<TrialRule> every_rule(const RuleRequest& request) {
    return std::make_unique<EveryRule>(request);
}

} // namespace overt
