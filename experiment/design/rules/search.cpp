#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/design/rules/trial_rules.h"

namespace overt {

namespace {

/// The least whole numbers of trials with and without the target that have this share without; nothing where
/// it takes more than 20 trials.
std::optional<std::pair<int, int>> shares_of(double absent) {
    for (int all = 1; all <= 20; ++all) {
        const double without = absent * all;
        if (std::abs(without - std::round(without)) < 1e-9)
            return std::pair(all - static_cast<int>(std::lround(without)),
                             static_cast<int>(std::lround(without)));
    }
    return std::nullopt;
}

class SearchRule : public CombiningRule {
  public:
    using CombiningRule::CombiningRule;

    std::vector<RuleProblem> problems() const override {
        std::vector<RuleProblem> found;
        require_one_factor(request(), "search", found);
        require_levels(request(), "target", request().targets, found);
        require_levels(request(), "distractors", request().distractors, found);
        if (request().targets.empty())
            found.push_back({"target", "the rule \"search\" needs a target", "write target = \"LEVEL\""});
        for (const std::string& level : request().targets)
            if (std::ranges::find(request().distractors, level) != request().distractors.end())
                found.push_back(
                    {"distractors", fmt::format("\"{}\" is a target and a distractor", level), ""});
        const auto slots = static_cast<int>(request().slots.size());
        for (const int size : request().set_sizes)
            if (size < 1 || size > slots)
                found.push_back(
                    {"set_sizes",
                     fmt::format("a set of {} does not go into the {} slots of the task", size, slots),
                     "give the task more slots, or search among fewer"});
        if (!shares_of(request().absent))
            found.push_back(
                {"absent",
                 fmt::format("a share of {} takes more than 20 trials to come out", request().absent),
                 "take one such as 0.5, 0.25 or 0.1"});
        return found;
    }

  protected:
    /// Target, set size, and whether it is there.
    Combinations combinations() const override {
        Combinations all(3);
        const auto [with, without] = shares_of(request().absent).value_or(std::pair(1, 1));
        for (int target = 0; target < request().stimuli; ++target) {
            if (!has_level(request(), target, request().targets))
                continue;
            for (const int size : sizes()) {
                for (int copy = 0; copy < with + without; ++copy) {
                    const bool is_there = copy < with;
                    const std::size_t others = distractors_beside(target).size();
                    if (others > 0 || (is_there && size == 1))
                        all.add(std::vector{target, size, is_there ? 1 : 0});
                }
            }
        }
        return all;
    }
    /// Each slot that the target can have.
    int ways() const override { return static_cast<int>(request().slots.size()); }
    RuledTrial place(std::span<const int> combination, int way, RandomStream& random) const override {
        const int target = combination[0], size = combination[1];
        const bool is_there = combination[2] == 1;
        RuledTrial trial;
        trial.shown.assign(request().slots.size(), -1);
        std::vector<int> taken;
        for (int slot = 0; slot < static_cast<int>(request().slots.size()); ++slot)
            if (slot != way)
                taken.push_back(slot);
        random.shuffle(std::span(taken));
        taken.insert(taken.begin(), way);
        std::vector<int> others = distractors_beside(target);
        for (int i = 0; i < size; ++i) {
            const auto slot = static_cast<std::size_t>(taken[static_cast<std::size_t>(i)]);
            if (i == 0 && is_there) {
                trial.shown[slot] = target;
                continue;
            }
            // All kinds of distractors once, in an order by chance, before any comes again.
            const std::size_t next = static_cast<std::size_t>(i - (is_there ? 1 : 0)) % others.size();
            if (next == 0)
                random.shuffle(std::span(others));
            trial.shown[slot] = others[next];
        }
        if (is_there)
            trial.side = way;
        trial.correct = is_there ? "present" : "absent";
        trial.levels = {{"set_size", fmt::format("{}", size)}, {"target", trial.correct}};
        return trial;
    }

  private:
    std::vector<int> sizes() const {
        return request().set_sizes.empty() ? std::vector{static_cast<int>(request().slots.size())}
                                           : request().set_sizes;
    }
    /// The distractors of the target's context; without any named, all that is no target.
    std::vector<int> distractors_beside(int target) const {
        std::vector<int> found;
        for (int stimulus = 0; stimulus < request().stimuli; ++stimulus) {
            if (request().context[static_cast<std::size_t>(stimulus)] !=
                request().context[static_cast<std::size_t>(target)])
                continue;
            const bool is_one = request().distractors.empty()
                                    ? !has_level(request(), stimulus, request().targets)
                                    : has_level(request(), stimulus, request().distractors);
            if (is_one)
                found.push_back(stimulus);
        }
        return found;
    }
};

} // namespace

std::unique_ptr<TrialRule> search_rule(const RuleRequest& request) {
    return std::make_unique<SearchRule>(request);
}

} // namespace overt
