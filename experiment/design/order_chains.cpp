#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/design/block_plan.h"
#include "experiment/design/latin_square.h"
#include "experiment/protocol/keys/protocol_keys.h"

namespace overt {

namespace {

constexpr OrderLimit::Kind limit_kinds[] = {OrderLimit::Kind::longest_run, OrderLimit::Kind::least_distance};

/// Keys that limit one factor each; all others are limited by name, in a table.
template <class Settings> struct OwnLimit {
    std::string_view factor;
    decltype(&Settings::max_task_run) run, distance;
};
template <class Settings>
constexpr OwnLimit<Settings> own_limits[] = {
    {"task", &Settings::max_task_run, &Settings::min_task_distance},
    {"object", &Settings::max_object_run, &Settings::min_object_distance},
    {"material", &Settings::max_material_run, &Settings::min_material_distance},
    {"stimulus", &Settings::max_stimulus_run, &Settings::min_stimulus_distance},
};

std::string limit_key(std::string_view factor, OrderLimit::Kind kind) {
    return kind == OrderLimit::Kind::longest_run ? fmt::format("max_{}_run", factor)
                                                 : fmt::format("min_{}_distance", factor);
}

/// What a block, or the schedule, asks for: the amount and the key that says it; nothing if it says nothing.
template <class Settings>
std::optional<std::pair<int, std::string>> written_limit(const Settings& settings, const Factor& factor,
                                                         OrderLimit::Kind kind) {
    const bool is_run = kind == OrderLimit::Kind::longest_run;
    const NamedNumbers& named = is_run ? settings.max_run : settings.min_distance;
    if (const auto found = std::ranges::find(named, factor.name, &NamedNumber::name); found != named.end())
        return std::pair(found->number,
                         fmt::format("{}.{}", is_run ? "max_run" : "min_distance", factor.name));
    for (const OwnLimit<Settings>& own : own_limits<Settings>) {
        if (own.factor != factor.name)
            continue;
        const std::optional<int> amount = settings.*(is_run ? own.run : own.distance);
        return amount ? std::optional(std::pair(*amount, limit_key(factor.name, kind))) : std::nullopt;
    }
    return std::nullopt;
}

/// Puts the items of one repetition of a block into parts, by the block's method.
class PartMaker {
  public:
    PartMaker(const Protocol& protocol, const Factors& factors, const BlockPlan& plan)
        : protocol_(protocol), factors_(factors), plan_(plan), block_(block_at(protocol, plan.block)),
          by_(factors.at(block_.by)) {}

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
                    if (factors_.level_of(by_, trials[static_cast<std::size_t>(item)]) == level)
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
        return static_cast<int>(std::lround(weight_of(protocol_, factors_, trial)));
    }

  private:
    void make_drawn(OrderSegment& segment, const std::vector<Trial>& trials) const {
        segment.draws = *block_.draws;
        for (const int item : segment.items) {
            const Trial& trial = trials[static_cast<std::size_t>(item)];
            const auto siblings = std::count_if(segment.items.begin(), segment.items.end(), [&](int other) {
                return factors_.level_of(by_, trials[static_cast<std::size_t>(other)]) ==
                       factors_.level_of(by_, trial);
            });
            segment.weights.push_back(weight_of(protocol_, factors_, trial) / static_cast<double>(siblings));
        }
    }

    std::vector<int> ordered_levels() const {
        std::vector<int> levels = levels_in(factors_, plan_.scope, by_);
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
    const Factors& factors_;
    const BlockPlan& plan_;
    const BlockSettings& block_;
    const Factor& by_;
};

void add_block(OrderChain& chain, const Protocol& protocol, const Factors& factors, const BlockPlan& plan) {
    const PartMaker maker(protocol, factors, plan);
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
        for (const Factor& factor : factors.all()) {
            if (!can_be_limited(factor))
                continue;
            for (const OrderLimit::Kind kind : limit_kinds) {
                const LimitSetting limit = limit_in(protocol, plan.block, factor, kind);
                // A distance of 1 is what any order has.
                const int least = kind == OrderLimit::Kind::longest_run ? 1 : 2;
                if (limit.amount >= least && levels_in(factors, plan.scope, factor).size() > 1)
                    chain.problem.limits.push_back({static_cast<int>(&factor - factors.all().data()), kind,
                                                    limit.amount, part, limit.key, factor.name});
            }
        }
    }
}

/// Only what limits look at, so that equal problems are seen to be equal: limited factors, and a limit of all
/// parts once.
void simplify(OrderProblem& problem, const Factors& factors, const std::vector<Trial>& trials) {
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
    for (const Factor& factor : factors.all()) {
        const bool is_limited = std::any_of(
            limits.begin(), limits.end(), [&](const OrderLimit& limit) { return limit.noun == factor.name; });
        if (!is_limited)
            continue;
        for (OrderLimit& limit : limits) {
            if (limit.noun == factor.name)
                limit.factor = static_cast<int>(problem.levels.size());
        }
        std::vector<int>& levels = problem.levels.emplace_back();
        for (const Trial& trial : trials)
            levels.push_back(factors.level_of(factor, trial));
    }
    problem.limits = std::move(limits);
}

} // namespace

bool can_be_limited(const Factor& factor) { return factor.source != Factor::Source::block; }

std::string own_limit_key(std::string_view factor, OrderLimit::Kind kind) {
    return std::ranges::find(own_limits<BlockSettings>, factor, &OwnLimit<BlockSettings>::factor) ==
                   std::end(own_limits<BlockSettings>)
               ? std::string()
               : limit_key(factor, kind);
}

LimitSetting limit_in(const Protocol& protocol, int block, const Factor& factor, OrderLimit::Kind kind) {
    const BlockSettings& settings = block_at(protocol, block);
    if (const auto own = written_limit(settings, factor, kind))
        return {own->first, fmt::format("block[{}].{}", block, own->second)};
    // A block by stimulus gives all that a stimulus is made of.
    const bool is_given = settings.order == OrderMethod::sequential ||
                          (settings.order == OrderMethod::blocked &&
                           (factor.name == settings.by ||
                            (settings.by == "stimulus" && factor.source != Factor::Source::task)));
    const auto common = written_limit(protocol.schedule, factor, kind).value_or(std::pair(0, std::string()));
    return {is_given ? 0 : common.first, "schedule." + common.second, is_given && common.first > 0};
}

std::vector<OrderChain> order_chains(const Protocol& protocol, int observer_number, std::uint64_t seed,
                                     RotationRule rule) {
    const Factors factors = factors_of(protocol);
    std::vector<OrderChain> chains;
    for (BlockPlan& plan : block_plans(protocol, observer_number, seed, rule)) {
        if (chains.empty() || !block_at(protocol, plan.block).continues)
            chains.emplace_back();
        add_block(chains.back(), protocol, factors, plan);
        chains.back().blocks.push_back(std::move(plan));
    }
    for (OrderChain& chain : chains)
        simplify(chain.problem, factors, chain.trials);
    return chains;
}

} // namespace overt
