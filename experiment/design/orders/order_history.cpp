#include "experiment/design/orders/order_history.h"

#include <algorithm>

namespace overt {

OrderHistory::Reach::Reach(const OrderProblem& problem)
    : limits(problem.limits), factors(problem.levels.size()) {
    for (const OrderLimit& limit : limits) {
        Factor& factor = factors[static_cast<std::size_t>(limit.factor)];
        int& farthest =
            limit.kind == OrderLimit::Kind::longest_run ? factor.longest_run : factor.longest_distance;
        farthest = std::max(farthest, limit.amount);
    }
    for (std::size_t i = 0; i < factors.size(); ++i) {
        factors[i].begin = size;
        if (factors[i].longest_run > 0 || factors[i].longest_distance > 0) {
            int levels = 0;
            for (const int level : problem.levels[i])
                levels = std::max(levels, level + 1);
            size += 2 + static_cast<std::size_t>(levels);
        }
        factors[i].end = size;
    }
}

bool OrderHistory::allows(std::span<const int> levels, int part) const {
    for (const OrderLimit& limit : reach_->limits) {
        if (limit.part >= 0 && limit.part != part)
            continue;
        const Reach::Factor& factor = reach_->factors[static_cast<std::size_t>(limit.factor)];
        const int level = levels[static_cast<std::size_t>(limit.factor)];
        if (limit.kind == OrderLimit::Kind::longest_run) {
            if (last(factor) == level && run(factor) >= limit.amount)
                return false;
        } else if (const int steps = since(factor, level); steps > 0 && steps < limit.amount) {
            return false;
        }
    }
    return true;
}

void OrderHistory::push(std::span<const int> levels) {
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const Reach::Factor& factor = reach_->factors[i];
        if (factor.begin == factor.end)
            continue;
        const int level = levels[i];
        if (factor.longest_distance > 0) {
            for (std::size_t at = factor.begin + 2; at < factor.end; ++at) {
                if (memory_[at] > 0 && ++memory_[at] >= factor.longest_distance)
                    memory_[at] = 0;
            }
            if (factor.longest_distance > 1)
                memory_[factor.begin + 2 + static_cast<std::size_t>(level)] = 1;
        }
        if (factor.longest_run > 0) {
            const int run_now = level == last(factor) ? std::min(run(factor) + 1, factor.longest_run) : 1;
            memory_[factor.begin] = static_cast<std::uint16_t>(level + 1);
            memory_[factor.begin + 1] = static_cast<std::uint16_t>(run_now);
        }
    }
}

int OrderHistory::mark(int index, int level) const {
    const Reach::Factor& factor = reach_->factors[static_cast<std::size_t>(index)];
    const int run_now = last(factor) == level ? run(factor) : 0;
    return run_now * (factor.longest_distance + 1) + since(factor, level);
}

int OrderHistory::wait(int index, int level, int part) const {
    int wait = 0;
    const Reach::Factor& factor = reach_->factors[static_cast<std::size_t>(index)];
    for (const OrderLimit& limit : reach_->limits) {
        if (limit.factor != index || (limit.part >= 0 && limit.part != part))
            continue;
        if (limit.kind == OrderLimit::Kind::longest_run) {
            if (last(factor) == level && run(factor) >= limit.amount)
                wait = std::max(wait, 1);
        } else if (const int steps = since(factor, level); steps > 0) {
            wait = std::max(wait, limit.amount - steps);
        }
    }
    return wait;
}

int OrderHistory::room_in_run(int index, int level, int longest) const {
    const Reach::Factor& factor = reach_->factors[static_cast<std::size_t>(index)];
    return last(factor) == level ? std::max(0, longest - run(factor)) : longest;
}

} // namespace overt
