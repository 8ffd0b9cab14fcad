#include "experiment/design/orders/order_guide.h"
#include "experiment/base/log_gamma.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace overt {

int draw_by_weight(const OrderSegment& segment, RandomStream& random) {
    double chance = random.uniform() * std::accumulate(segment.weights.begin(), segment.weights.end(), 0.0);
    int last = -1;
    for (std::size_t i = 0; i < segment.items.size(); ++i) {
        if (segment.weights[i] <= 0.0)
            continue;
        last = segment.items[i];
        if ((chance -= segment.weights[i]) < 0.0)
            break;
    }
    return last;
}

ItemSequence fill_in(const PreparedProblem& prepared, const KindSequence& order, RandomStream& random) {
    const OrderProblem& problem = *prepared.problem;
    std::vector<std::vector<std::vector<std::vector<int>>>> waiting(problem.parts.size());
    for (std::size_t part = 0; part < problem.parts.size(); ++part) {
        for (const OrderSegment& segment : problem.parts[part].segments) {
            auto& kinds = waiting[part].emplace_back(static_cast<std::size_t>(prepared.kinds.count));
            for (const int item : segment.items)
                kinds[static_cast<std::size_t>(prepared.kinds.kind_of_item[static_cast<std::size_t>(item)])]
                    .push_back(item);
            if (!segment.is_drawn()) {
                for (std::vector<int>& items : kinds) {
                    if (items.size() > 1)
                        random.shuffle(std::span(items));
                }
            }
        }
    }
    ItemSequence sequence;
    for (const KindSequence::Place& place : order.places) {
        const auto part = static_cast<std::size_t>(place.part),
                   segment = static_cast<std::size_t>(place.segment);
        const OrderSegment& from = problem.parts[part].segments[segment];
        std::vector<int>& items = waiting[part][segment][static_cast<std::size_t>(place.kind)];
        if (from.is_drawn()) {
            OrderSegment of_kind;
            for (std::size_t i = 0; i < from.items.size(); ++i) {
                if (prepared.kinds.kind_of_item[static_cast<std::size_t>(from.items[i])] == place.kind) {
                    of_kind.items.push_back(from.items[i]);
                    of_kind.weights.push_back(from.weights[i]);
                }
            }
            sequence.items.push_back(draw_by_weight(of_kind, random));
        } else {
            sequence.items.push_back(items.back());
            items.pop_back();
        }
        sequence.parts.push_back(place.part);
    }
    return sequence;
}

KindSequence in_kinds_of(const PreparedProblem& prepared, KindSequence order, const ItemSequence& sequence) {
    for (std::size_t i = 0; i < order.places.size(); ++i)
        order.places[i].kind = prepared.kinds.kind_of_item[static_cast<std::size_t>(sequence.items[i])];
    return order;
}

OrderProblem renamed(OrderProblem problem, RandomStream& random) {
    for (std::vector<int>& levels : problem.levels) {
        if (levels.empty())
            continue;
        std::vector<int> names(static_cast<std::size_t>(*std::max_element(levels.begin(), levels.end())) + 1);
        std::iota(names.begin(), names.end(), 0);
        random.shuffle(std::span(names));
        for (int& level : levels)
            level = names[static_cast<std::size_t>(level)];
    }
    return problem;
}

OrderProblem OrderGuide::restricted(OrderProblem problem, int factor) {
    std::erase_if(problem.limits, [&](const OrderLimit& limit) { return limit.factor != factor; });
    return problem;
}

OrderGuide::OrderGuide(const OrderProblem& whole, int factor, std::size_t most_states)
    : most_states_(most_states), problem_(restricted(whole, factor)), prepared_(problem_),
      counter_(prepared_, most_states), ways_(counter_.count()) {}

double OrderGuide::share() const {
    if (!ways_)
        return INFINITY;
    double all = 0.0;
    for (const auto& part : prepared_.kinds.counts) {
        for (const std::vector<int>& counts : part) {
            all += log_gamma(1.0 + std::accumulate(counts.begin(), counts.end(), 0));
            for (const int count : counts)
                all -= log_gamma(1.0 + count);
        }
    }
    return ways_->is_zero() ? -INFINITY : ways_->log() - all;
}

ItemSequence OrderGuide::draw(RandomStream& random) {
    return fill_in(prepared_, counter_.draw(random), random);
}

std::optional<KindSequence> OrderGuide::start(const PreparedProblem& whole, RandomStream& random) {
    KindSequence order;
    ItemSequence items;
    if (is_counted()) {
        order = counter_.draw(random);
        items = fill_in(prepared_, order, random);
    } else {
        const OrderProblem other = renamed(problem_, random);
        const PreparedProblem prepared(other);
        OrderSearch search(prepared, most_states_);
        if (search.find() != OrderSearch::Answer::found)
            return std::nullopt;
        order = search.order();
        items = fill_in(prepared, order, random);
    }
    return in_kinds_of(whole, std::move(order), items);
}

} // namespace overt
