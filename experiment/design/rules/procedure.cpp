#include "experiment/design/rules/trial_rules.h"

#include <span>

namespace overt {

namespace {

/// Places in the order for trials whose level is chosen when they come. Until then each shows one of the
/// levels, all of them in turn.
class ProcedureRule : public TrialRule {
  public:
    using TrialRule::TrialRule;

    std::vector<RuleProblem> problems() const override {
        std::vector<RuleProblem> found;
        require_one_factor(request(), "procedure", found);
        if (request().procedure_trials < 1)
            found.push_back({"procedure", "the rule \"procedure\" needs a procedure",
                             "write procedure = [\"ID\"], and a [[procedure]] of this id"});
        if (has_standard()) {
            require_slots(request(), 2, "procedure", found);
            require_levels(request(), "standard", request().standards, found);
            if (request().standards.size() > 1)
                found.push_back({"standard", "a procedure has one standard", ""});
        } else if (!request().in.empty()) {
            require_slot(request(), "in", request().in, found);
        } else {
            require_slots(request(), 1, "procedure", found);
        }
        return found;
    }

    std::size_t count() const override {
        return available() * static_cast<std::size_t>(request().repetitions);
    }
    std::size_t available() const override {
        std::size_t contexts = 0;
        for (const std::vector<int>& stimuli : stimuli_by_context(request()))
            contexts += is_complete(stimuli) ? 1 : 0;
        return contexts * static_cast<std::size_t>(request().procedure_trials);
    }

    std::vector<RuledTrial> trials(RandomStream& random) const override {
        std::vector<RuledTrial> all;
        for (const std::vector<int>& stimuli : stimuli_by_context(request())) {
            if (!is_complete(stimuli))
                continue;
            const int trials = request().procedure_trials * request().repetitions;
            std::vector<int> sides;
            for (int i = 0; i < trials; ++i)
                sides.push_back(request().side == SideRule::fixed ? 0 : i % 2);
            random.shuffle(std::span(sides));
            for (int i = 0; i < trials; ++i) {
                RuledTrial& trial = all.emplace_back();
                const int test = stimuli[static_cast<std::size_t>(i) % stimuli.size()];
                trial.shown.assign(request().slots.size(), -1);
                int slot = request().in.empty() ? 0 : slot_called(request(), request().in);
                if (has_standard()) {
                    slot = sides[static_cast<std::size_t>(i)];
                    trial.shown[static_cast<std::size_t>(1 - slot)] = standard_of(stimuli);
                    trial.side = slot;
                }
                trial.shown[static_cast<std::size_t>(slot)] = test;
            }
        }
        return all;
    }

  private:
    bool has_standard() const { return !request().standards.empty(); }
    int standard_of(const std::vector<int>& stimuli) const {
        for (const int one : stimuli)
            if (has_level(request(), one, request().standards))
                return one;
        return -1;
    }
    /// There is something to choose from, and what it is compared with.
    bool is_complete(const std::vector<int>& stimuli) const {
        return stimuli.size() > 1 && (!has_standard() || standard_of(stimuli) >= 0);
    }
};

} // namespace

std::unique_ptr<TrialRule> procedure_rule(const RuleRequest& request) {
    return std::make_unique<ProcedureRule>(request);
}

} // namespace overt
