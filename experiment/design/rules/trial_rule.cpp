#include "experiment/design/rules/trial_rule.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/diagnostics.h"
#include "experiment/base/error.h"

namespace overt {

std::size_t CombiningRule::count() const {
    const std::size_t all = combinations().size();
    const std::size_t drawn = request().draw ? std::min(all, static_cast<std::size_t>(*request().draw)) : all;
    const int sides = request().side == SideRule::crossed ? ways() : 1;
    return drawn * static_cast<std::size_t>(sides) * static_cast<std::size_t>(request().repetitions);
}

std::vector<RuledTrial> CombiningRule::trials(RandomStream& random) const {
    const Combinations all = combinations();
    std::vector<std::size_t> chosen(all.size());
    std::iota(chosen.begin(), chosen.end(), std::size_t{0});
    if (request().draw && static_cast<std::size_t>(*request().draw) < chosen.size()) {
        // The first steps of a shuffle; what was drawn then stands in the order of the lists again.
        const auto count = static_cast<std::size_t>(*request().draw);
        for (std::size_t i = 0; i < count; ++i)
            std::swap(chosen[i], chosen[i + random.below(static_cast<std::uint32_t>(chosen.size() - i))]);
        chosen.resize(count);
        std::ranges::sort(chosen);
    }
    // Where sides are drawn, each comes equally often: over all combinations, and over the repetitions of
    // one.
    const int ways_of_all = request().side == SideRule::drawn ? drawn_ways() : 1;
    std::vector<int> first_ways(chosen.size());
    for (std::size_t i = 0; i < chosen.size(); ++i)
        first_ways[i] = static_cast<int>(i % static_cast<std::size_t>(ways_of_all));
    if (ways_of_all > 1)
        random.shuffle(std::span(first_ways));
    const int sides = request().side == SideRule::crossed ? ways() : 1;
    std::vector<RuledTrial> trials;
    for (int repetition = 0; repetition < request().repetitions; ++repetition) {
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            for (int side = 0; side < sides; ++side) {
                const int way = sides > 1 ? side : (first_ways[i] + repetition) % ways_of_all;
                trials.push_back(place(all.at(chosen[i]), way, random));
            }
        }
    }
    return trials;
}

std::vector<std::vector<int>> stimuli_by_context(const RuleRequest& request) {
    std::vector<std::vector<int>> contexts;
    for (int stimulus = 0; stimulus < request.stimuli; ++stimulus) {
        const auto context = static_cast<std::size_t>(request.context[static_cast<std::size_t>(stimulus)]);
        contexts.resize(std::max(contexts.size(), context + 1));
        contexts[context].push_back(stimulus);
    }
    for (std::vector<int>& stimuli : contexts) {
        for (auto factor = request.of.rbegin(); factor != request.of.rend(); ++factor)
            std::ranges::stable_sort(stimuli, {}, [&](int stimulus) {
                return factor->of_stimulus[static_cast<std::size_t>(stimulus)];
            });
    }
    return contexts;
}

bool do_differ(std::span<const RuleFactor> factors, int one, int other) {
    return std::ranges::all_of(factors, [&](const RuleFactor& factor) {
        const int first = factor.of_stimulus[static_cast<std::size_t>(one)];
        const int second = factor.of_stimulus[static_cast<std::size_t>(other)];
        return first >= 0 && second >= 0 && first != second;
    });
}

void require_slots(const RuleRequest& request, std::size_t count, std::string_view rule,
                   std::vector<RuleProblem>& problems) {
    if (request.slots.size() != count)
        problems.push_back({"rule",
                            fmt::format("the rule \"{}\" fills {} slots, and the task has {} ({})", rule,
                                        count, request.slots.size(), fmt::join(request.slots, ", ")),
                            fmt::format("give the task as many with slots = [...]")});
}

void require_one_factor(const RuleRequest& request, std::string_view rule,
                        std::vector<RuleProblem>& problems) {
    if (request.of.size() != 1)
        problems.push_back(
            {"of", fmt::format("the rule \"{}\" goes by one factor, not by {}", rule, request.of.size()),
             ""});
}

void require_levels(const RuleRequest& request, std::string_view key, std::span<const std::string> named,
                    std::vector<RuleProblem>& problems) {
    if (request.of.size() != 1)
        return; // require_one_factor() says so
    const RuleFactor& factor = request.of.front();
    const std::vector<std::string_view> known(factor.levels.begin(), factor.levels.end());
    for (const std::string& level : named) {
        if (std::ranges::find(known, level) == known.end())
            problems.push_back(
                {key, fmt::format("{} has no level \"{}\"", factor.name, level), suggest_name(level, known)});
    }
}

void require_slot(const RuleRequest& request, std::string_view key, const std::string& slot,
                  std::vector<RuleProblem>& problems) {
    const std::vector<std::string_view> known(request.slots.begin(), request.slots.end());
    if (std::ranges::find(known, slot) == known.end())
        problems.push_back(
            {key, fmt::format("the task has no slot \"{}\"", slot), suggest_name(slot, known)});
}

int slot_called(const RuleRequest& request, std::string_view id) {
    const auto found = std::ranges::find(request.slots, id);
    OVERT_EXPECTS(found != request.slots.end());
    return static_cast<int>(found - request.slots.begin());
}

bool has_level(const RuleRequest& request, int stimulus, std::span<const std::string> named) {
    const RuleFactor& factor = request.of.front();
    const int level = factor.of_stimulus[static_cast<std::size_t>(stimulus)];
    return level >= 0 &&
           std::ranges::find(named, factor.levels[static_cast<std::size_t>(level)]) != named.end();
}

} // namespace overt
