#include "experiment/design/rules/trial_rules.h"

namespace overt {

namespace {

class StandardRule : public CombiningRule {
  public:
    using CombiningRule::CombiningRule;

    std::vector<RuleProblem> problems() const override {
        std::vector<RuleProblem> found;
        require_slots(request(), 2, "standard", found);
        require_one_factor(request(), "standard", found);
        if (request().standards.empty())
            found.push_back({"standard", "the rule \"standard\" needs a standard",
                             "write standard = \"LEVEL\": what all others are compared with"});
        require_levels(request(), "standard", request().standards, found);
        return found;
    }

  protected:
    Combinations combinations() const override {
        Combinations all(2);
        for (const std::vector<int>& stimuli : stimuli_by_context(request())) {
            for (const int standard : stimuli) {
                if (!has_level(request(), standard, request().standards))
                    continue;
                for (const int other : stimuli) {
                    const bool does_differ = do_differ(request().of, standard, other) &&
                                             do_differ(request().differs, standard, other);
                    const int pair[] = {standard, other};
                    if (does_differ || (request().with_identical && other == standard))
                        all.add(pair);
                }
            }
        }
        return all;
    }
    int ways() const override { return 2; }
    RuledTrial place(std::span<const int> pair, int way, RandomStream&) const override {
        RuledTrial trial;
        trial.shown = {pair[static_cast<std::size_t>(way)], pair[static_cast<std::size_t>(1 - way)]};
        trial.side = way;
        return trial;
    }
};

} // namespace

std::unique_ptr<TrialRule> standard_rule(const RuleRequest& request) {
    return std::make_unique<StandardRule>(request);
}

} // namespace overt
