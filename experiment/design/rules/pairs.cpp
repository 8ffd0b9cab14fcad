#include "experiment/design/rules/trial_rules.h"

namespace overt {

namespace {

class PairsRule : public CombiningRule {
  public:
    using CombiningRule::CombiningRule;

    std::vector<RuleProblem> problems() const override {
        std::vector<RuleProblem> found;
        require_slots(request(), 2, "pairs", found);
        if (request().is_ordered && request().side == SideRule::crossed)
            found.push_back({"side", "ordered pairs come both ways round already",
                             "leave out \"ordered\" or side = \"crossed\""});
        return found;
    }

  protected:
    Combinations combinations() const override {
        Combinations all(2);
        for (const std::vector<int>& stimuli : stimuli_by_context(request())) {
            for (std::size_t i = 0; i < stimuli.size(); ++i) {
                for (std::size_t j = request().with_identical ? i : i + 1; j < stimuli.size(); ++j) {
                    const int pair[] = {stimuli[i], stimuli[j]}, turned[] = {stimuli[j], stimuli[i]};
                    if (i != j && !(do_differ(request().of, pair[0], pair[1]) &&
                                    do_differ(request().differs, pair[0], pair[1])))
                        continue;
                    all.add(pair);
                    if (request().is_ordered && i != j)
                        all.add(turned);
                }
            }
        }
        return all;
    }
    int ways() const override { return request().is_ordered ? 1 : 2; }
    RuledTrial place(std::span<const int> pair, int way, RandomStream&) const override {
        RuledTrial trial;
        trial.shown = {pair[static_cast<std::size_t>(way)], pair[static_cast<std::size_t>(1 - way)]};
        if (!request().is_ordered)
            trial.side = way;
        return trial;
    }
};

} // namespace

std::unique_ptr<TrialRule> pairs_rule(const RuleRequest& request) {
    return std::make_unique<PairsRule>(request);
}

} // namespace overt
