#include <algorithm>

#include <fmt/format.h>

#include "experiment/design/rules/trial_rules.h"

namespace overt {

namespace {

/// Delayed or simultaneous match to sample. The match and the others stand side by side, so they are alike in
/// all but `of`; the sample has the levels of the match, under another level of `differs`.
class MatchRule : public CombiningRule {
  public:
    using CombiningRule::CombiningRule;

    std::vector<RuleProblem> problems() const override {
        std::vector<RuleProblem> found;
        if (!request().sample.empty())
            require_slot(request(), "sample", request().sample, found);
        for (const std::string& slot : request().among) {
            require_slot(request(), "among", slot, found);
            if (slot == request().sample)
                found.push_back({"among", fmt::format("slot \"{}\" shows the sample already", slot), ""});
        }
        if (found.empty() && choices().size() < 2)
            found.push_back({request().among.empty() ? "rule" : "among",
                             "the rule \"match\" needs two slots to choose among, besides that of the sample",
                             "give the task another with slots = [...]"});
        return found;
    }

  protected:
    /// Sample, match, and the others.
    Combinations combinations() const override {
        Combinations all(1 + choices().size());
        for (const std::vector<int>& stimuli : stimuli_by_context(request())) {
            for (const int sample : stimuli) {
                for (const int match : stimuli) {
                    const bool fits =
                        is_alike(request().of, sample, match) &&
                        (request().differs.empty() ? sample == match
                                                   : do_differ(request().differs, sample, match));
                    std::vector<int> set{sample, match};
                    if (fits)
                        add_others(stimuli, 0, set, all);
                }
            }
        }
        return all;
    }
    int ways() const override { return static_cast<int>(choices().size()); }
    RuledTrial place(std::span<const int> combination, int way, RandomStream&) const override {
        const std::vector<int> slots = choices();
        RuledTrial trial;
        trial.shown.assign(request().slots.size(), -1);
        trial.shown[static_cast<std::size_t>(sample_slot())] = combination[0];
        std::size_t next = 2;
        for (int i = 0; i < static_cast<int>(slots.size()); ++i)
            trial.shown[static_cast<std::size_t>(slots[static_cast<std::size_t>(i)])] =
                i == way ? combination[1] : combination[next++];
        trial.side = slots[static_cast<std::size_t>(way)];
        trial.correct = request().slots[static_cast<std::size_t>(*trial.side)];
        return trial;
    }

  private:
    int sample_slot() const {
        return request().sample.empty() ? 0 : slot_called(request(), request().sample);
    }
    std::vector<int> choices() const {
        std::vector<int> slots;
        for (const std::string& slot : request().among)
            slots.push_back(slot_called(request(), slot));
        for (int slot = 0; request().among.empty() && slot < static_cast<int>(request().slots.size()); ++slot)
            if (slot != sample_slot())
                slots.push_back(slot);
        return slots;
    }
    static bool is_alike(std::span<const RuleFactor> factors, int one, int other) {
        return std::ranges::all_of(factors, [&](const RuleFactor& factor) {
            const int level = factor.of_stimulus[static_cast<std::size_t>(one)];
            return level >= 0 && level == factor.of_stimulus[static_cast<std::size_t>(other)];
        });
    }
    void add_others(const std::vector<int>& stimuli, std::size_t from, std::vector<int>& set,
                    Combinations& all) const {
        if (set.size() == 1 + choices().size()) {
            all.add(set);
            return;
        }
        for (std::size_t i = from; i < stimuli.size() && !all.is_full(); ++i) {
            const bool fits = is_alike(request().differs, set[1], stimuli[i]) &&
                              std::all_of(set.begin() + 1, set.end(), [&](int member) {
                                  return do_differ(request().of, member, stimuli[i]);
                              });
            if (!fits)
                continue;
            set.push_back(stimuli[i]);
            add_others(stimuli, i + 1, set, all);
            set.pop_back();
        }
    }
};

} // namespace

std::unique_ptr<TrialRule> match_rule(const RuleRequest& request) {
    return std::make_unique<MatchRule>(request);
}

} // namespace overt
