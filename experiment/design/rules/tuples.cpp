#include <algorithm>

#include <fmt/format.h>

#include "experiment/design/rules/trial_rules.h"

namespace overt {

namespace {

class TuplesRule : public CombiningRule {
  public:
    using CombiningRule::CombiningRule;

    std::vector<RuleProblem> problems() const override {
        constexpr std::size_t most_crossed = 6; // 720 ways
        std::vector<RuleProblem> found;
        if (size() < 2)
            found.push_back({"size", fmt::format("a tuple of {} is none", size()), "2 is the least"});
        require_slots(request(), size(), "tuples", found);
        if (request().side == SideRule::crossed && size() > most_crossed)
            found.push_back(
                {"side", fmt::format("{} stimuli go into their slots in too many ways to cross them", size()),
                 "take side = \"drawn\""});
        return found;
    }

  protected:
    std::size_t size() const {
        return request().size > 0 ? static_cast<std::size_t>(request().size) : request().slots.size();
    }
    Combinations combinations() const override {
        Combinations all(size());
        for (const std::vector<int>& stimuli : stimuli_by_context(request())) {
            std::vector<int> set;
            extend(stimuli, 0, set, all);
        }
        return all;
    }
    int ways() const override {
        int ways = 1;
        for (int i = 2; i <= static_cast<int>(std::min<std::size_t>(size(), 12)); ++i)
            ways *= i;
        return ways;
    }
    /// The factorial digits of `way` say which of those left comes next.
    RuledTrial place(std::span<const int> tuple, int way, RandomStream&) const override {
        std::vector<int> left(tuple.begin(), tuple.end());
        RuledTrial trial;
        int ways_of_rest = ways();
        const std::size_t named = std::min<std::size_t>(size(), 12);
        for (std::size_t i = 0; i < named; ++i) {
            ways_of_rest /= static_cast<int>(named - i);
            const auto next = left.begin() + way / ways_of_rest;
            way %= ways_of_rest;
            if (*next == tuple[0])
                trial.side = static_cast<int>(i);
            trial.shown.push_back(*next);
            left.erase(next);
        }
        trial.shown.insert(trial.shown.end(), left.begin(), left.end());
        return trial;
    }

  private:
    void extend(const std::vector<int>& stimuli, std::size_t from, std::vector<int>& set,
                Combinations& all) const {
        if (set.size() == size()) {
            all.add(set);
            return;
        }
        for (std::size_t i = from; i < stimuli.size() && !all.is_full(); ++i) {
            const bool fits = std::ranges::all_of(set, [&](int member) {
                return do_differ(request().of, member, stimuli[i]) &&
                       do_differ(request().differs, member, stimuli[i]);
            });
            if (!fits)
                continue;
            set.push_back(stimuli[i]);
            extend(stimuli, i + 1, set, all);
            set.pop_back();
        }
    }
};

} // namespace

std::unique_ptr<TrialRule> tuples_rule(const RuleRequest& request) {
    return std::make_unique<TuplesRule>(request);
}

} // namespace overt
