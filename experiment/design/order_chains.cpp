#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/design/block_plan.h"
#include "experiment/design/latin_square.h"
#include "experiment/protocol/protocol_keys.h"

namespace overt {

namespace {

constexpr TrialFactor factors[] = {TrialFactor::task, TrialFactor::object, TrialFactor::material,
                                   TrialFactor::stimulus};
constexpr OrderLimit::Kind kinds[] = {OrderLimit::Kind::longest_run, OrderLimit::Kind::least_distance};

/// A block's own limit, nothing if it has none, or the common one of the schedule.
auto limit_in(const auto& settings, TrialFactor factor, OrderLimit::Kind kind) {
    const bool is_run = kind == OrderLimit::Kind::longest_run;
    switch (factor) {
    case TrialFactor::task:
        return is_run ? settings.max_task_run : settings.min_task_distance;
    case TrialFactor::object:
        return is_run ? settings.max_object_run : settings.min_object_distance;
    case TrialFactor::material:
        return is_run ? settings.max_material_run : settings.min_material_distance;
    case TrialFactor::stimulus:
        break;
    }
    return is_run ? settings.max_stimulus_run : settings.min_stimulus_distance;
}

/// Puts the items of one repetition of a block into parts, by the block's method.
class PartMaker {
  public:
    PartMaker(const Protocol& protocol, const BlockPlan& plan)
        : protocol_(protocol), plan_(plan), block_(block_at(protocol, plan.block)) {}

    /// `items` are the block's trials, as often as they come.
    OrderPart part_of(const std::vector<int>& items, const std::vector<Trial>& trials) const {
        OrderPart part;
        switch (block_.order) {
        case OrderMethod::random:
            part.segments = {{items, 0, {}}};
            break;
        case OrderMethod::sequential:
            for (const int item : items)
                part.segments.push_back({{item}, 0, {}});
            break;
        case OrderMethod::blocked:
            part.in_any_order = block_.levels == LevelOrder::random;
            for (const int level : ordered_levels()) {
                OrderSegment segment;
                for (const int item : items) {
                    if (level_of(protocol_, trials[static_cast<std::size_t>(item)], block_.by) == level)
                        segment.items.push_back(item);
                }
                if (!segment.items.empty())
                    part.segments.push_back(std::move(segment));
            }
            break;
        case OrderMethod::weighted:
            part.segments = {{items, 0, {}}};
            if (block_.draws)
                make_drawn(part.segments.front(), trials);
            break;
        }
        return part;
    }

    /// How often a trial comes in one repetition.
    int copies(const Trial& trial) const {
        if (block_.draws)
            return 1;
        return static_cast<int>(std::lround(weight_of(protocol_, trial)));
    }

  private:
    void make_drawn(OrderSegment& segment, const std::vector<Trial>& trials) const {
        segment.draws = *block_.draws;
        for (const int item : segment.items) {
            const Trial& trial = trials[static_cast<std::size_t>(item)];
            const auto siblings = std::count_if(segment.items.begin(), segment.items.end(), [&](int other) {
                return level_of(protocol_, trials[static_cast<std::size_t>(other)], block_.by) ==
                       level_of(protocol_, trial, block_.by);
            });
            segment.weights.push_back(weight_of(protocol_, trial) / static_cast<double>(siblings));
        }
    }

    std::vector<int> ordered_levels() const {
        std::vector<int> levels = levels_in(protocol_, plan_.scope, block_.by);
        if (block_.levels == LevelOrder::random || block_.levels == LevelOrder::fixed)
            return levels;
        std::vector<int> ordered;
        for (const int place :
             row_of_square(square_of(block_.levels), static_cast<int>(levels.size()), plan_.levels_row,
                           static_cast<std::uint64_t>(protocol_.schedule.rotation_seed),
                           "levels of block " + block_.id))
            ordered.push_back(levels[static_cast<std::size_t>(place)]);
        return ordered;
    }

    const Protocol& protocol_;
    const BlockPlan& plan_;
    const BlockSettings& block_;
};

void add_block(OrderChain& chain, const Protocol& protocol, const BlockPlan& plan) {
    const PartMaker maker(protocol, plan);
    const BlockSettings& block = block_at(protocol, plan.block);
    const bool is_mixed = block.repetition_order == RepetitionOrder::mixed;
    const auto first_part = static_cast<int>(chain.problem.parts.size());
    std::vector<int> items;
    for (int repetition = 0; repetition < block.repetitions; ++repetition) {
        if (!is_mixed)
            items.clear();
        for (const Trial& trial : plan.trials) {
            for (int copy = 0; copy < maker.copies(trial); ++copy) {
                items.push_back(static_cast<int>(chain.trials.size()));
                chain.trials.push_back(trial);
            }
        }
        const bool is_whole = !is_mixed || repetition + 1 == block.repetitions;
        if (is_whole && !items.empty())
            chain.problem.parts.push_back(maker.part_of(items, chain.trials));
    }
    for (int part = first_part; part < static_cast<int>(chain.problem.parts.size()); ++part) {
        for (const TrialFactor factor : factors) {
            for (const OrderLimit::Kind kind : kinds) {
                const LimitSetting limit = limit_in(protocol, plan.block, factor, kind);
                // A distance of 1 is what any order has.
                const int least = kind == OrderLimit::Kind::longest_run ? 1 : 2;
                if (limit.amount >= least && levels_in(protocol, plan.scope, factor).size() > 1)
                    chain.problem.limits.push_back({static_cast<int>(factor), kind, limit.amount, part,
                                                    limit.key, std::string(name_of(factor))});
            }
        }
    }
}

/// Only what limits look at, so that equal problems are seen to be equal: limited factors, and a limit of all
/// parts once.
void simplify(OrderProblem& problem, const Protocol& protocol, const std::vector<Trial>& trials) {
    std::vector<OrderLimit> limits;
    const int parts = static_cast<int>(problem.parts.size());
    for (OrderLimit limit : problem.limits) {
        const auto same = [&](const OrderLimit& other) {
            return other.factor == limit.factor && other.kind == limit.kind && other.amount == limit.amount &&
                   other.key == limit.key;
        };
        if (std::count_if(problem.limits.begin(), problem.limits.end(), same) == parts)
            limit.part = -1;
        if (std::find(limits.begin(), limits.end(), limit) == limits.end())
            limits.push_back(limit);
    }
    for (const TrialFactor factor : factors) {
        const bool is_limited = std::any_of(limits.begin(), limits.end(), [&](const OrderLimit& limit) {
            return limit.noun == name_of(factor);
        });
        if (!is_limited)
            continue;
        for (OrderLimit& limit : limits) {
            if (limit.noun == name_of(factor))
                limit.factor = static_cast<int>(problem.levels.size());
        }
        std::vector<int>& levels = problem.levels.emplace_back();
        for (const Trial& trial : trials)
            levels.push_back(level_of(protocol, trial, factor));
    }
    problem.limits = std::move(limits);
}

} // namespace

LimitSetting limit_in(const Protocol& protocol, int block, TrialFactor factor, OrderLimit::Kind kind) {
    const BlockSettings& settings = block_at(protocol, block);
    const std::string name = kind == OrderLimit::Kind::longest_run
                                 ? fmt::format("max_{}_run", name_of(factor))
                                 : fmt::format("min_{}_distance", name_of(factor));
    if (const std::optional<int> own = limit_in(settings, factor, kind))
        return {*own, fmt::format("block[{}].{}", block, name)};
    const bool is_given =
        settings.order == OrderMethod::sequential ||
        (settings.order == OrderMethod::blocked &&
         (factor == settings.by || (settings.by == TrialFactor::stimulus && factor != TrialFactor::task)));
    const int common = limit_in(protocol.schedule, factor, kind);
    return {is_given ? 0 : common, "schedule." + name, is_given && common > 0};
}

std::vector<OrderChain> order_chains(const Protocol& protocol, int observer_number, std::uint64_t seed,
                                     RotationRule rule) {
    std::vector<OrderChain> chains;
    for (BlockPlan& plan : block_plans(protocol, observer_number, seed, rule)) {
        if (chains.empty() || !block_at(protocol, plan.block).continues)
            chains.emplace_back();
        add_block(chains.back(), protocol, plan);
        chains.back().blocks.push_back(std::move(plan));
    }
    for (OrderChain& chain : chains)
        simplify(chain.problem, protocol, chain.trials);
    return chains;
}

} // namespace overt
