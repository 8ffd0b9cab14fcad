/// Small order problems, and all their orders by trying every one.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include "experiment/base/random.h"
#include "experiment/design/orders/order_problem.h"

namespace overt::test {

/// Calls `visit` with every sequence that a problem's segments allow, whatever its limits.
inline void for_each_sequence(const OrderProblem& problem,
                              const std::function<void(const ItemSequence&)>& visit) {
    ItemSequence sequence;
    const std::function<void(std::size_t, std::vector<int>)> place = [&](std::size_t part,
                                                                         std::vector<int> segments) {
        if (segments.empty()) {
            if (++part == problem.parts.size()) {
                visit(sequence);
                return;
            }
            segments.resize(problem.parts[part].segments.size());
            std::iota(segments.begin(), segments.end(), 0);
        }
        const std::size_t choices = problem.parts[part].in_any_order ? segments.size() : 1;
        for (std::size_t choice = 0; choice < choices; ++choice) {
            std::vector<int> others = segments;
            others.erase(others.begin() + static_cast<std::ptrdiff_t>(choice));
            const OrderSegment& segment =
                problem.parts[part].segments[static_cast<std::size_t>(segments[choice])];
            const std::size_t before = sequence.items.size();
            const auto go_on = [&](const std::vector<int>& items) {
                sequence.items.insert(sequence.items.end(), items.begin(), items.end());
                sequence.parts.resize(sequence.items.size(), static_cast<int>(part));
                place(part, others);
                sequence.items.resize(before);
                sequence.parts.resize(before);
            };
            std::vector<int> items = segment.items;
            std::sort(items.begin(), items.end());
            if (!segment.is_drawn()) {
                do
                    go_on(items);
                while (std::next_permutation(items.begin(), items.end()));
                continue;
            }
            std::vector<std::size_t> drawn(static_cast<std::size_t>(segment.draws));
            while (true) {
                std::vector<int> picked;
                for (const std::size_t index : drawn)
                    picked.push_back(segment.items[index]);
                go_on(picked);
                std::size_t wheel = 0;
                while (wheel < drawn.size() && ++drawn[wheel] == segment.items.size())
                    drawn[wheel++] = 0;
                if (wheel == drawn.size())
                    break;
            }
        }
    };
    place(static_cast<std::size_t>(-1), {});
}

/// A problem of up to seven items, one or two factors, some limits, and parts of every make.
inline OrderProblem random_problem(RandomStream& random) {
    OrderProblem problem;
    const int items = 3 + static_cast<int>(random.below(5));
    const int factors = 1 + static_cast<int>(random.below(2));
    for (int factor = 0; factor < factors; ++factor) {
        const std::uint32_t levels = 2 + random.below(3);
        std::vector<int>& level = problem.levels.emplace_back();
        for (int item = 0; item < items; ++item)
            level.push_back(static_cast<int>(random.below(levels)));
    }
    std::vector<int> all(static_cast<std::size_t>(items));
    std::iota(all.begin(), all.end(), 0);
    const std::uint32_t make = random.below(4);
    if (make == 0) {
        problem.parts = {{{{all, 0, {}}}, false}};
    } else {
        const auto cut = all.begin() + 1 +
                         static_cast<std::ptrdiff_t>(random.below(static_cast<std::uint32_t>(items - 1)));
        const OrderSegment first{{all.begin(), cut}, 0, {}}, second{{cut, all.end()}, 0, {}};
        if (make == 1)
            problem.parts = {{{first}, false}, {{second}, false}};
        else
            problem.parts = {{{first, second}, make == 2}};
    }
    const std::uint32_t limits = 1 + random.below(3);
    for (std::uint32_t i = 0; i < limits; ++i) {
        const bool is_run = random.below(2) == 0;
        const int part =
            random.below(3) == 0
                ? static_cast<int>(random.below(static_cast<std::uint32_t>(problem.parts.size())))
                : -1;
        problem.limits.push_back(
            {static_cast<int>(random.below(static_cast<std::uint32_t>(factors))),
             is_run ? OrderLimit::Kind::longest_run : OrderLimit::Kind::least_distance,
             is_run ? 1 + static_cast<int>(random.below(2)) : 2 + static_cast<int>(random.below(2)), part,
             "limit " + std::to_string(i), "level"});
    }
    return problem;
}

/// Orders that keep to the limits, by trying all.
inline std::set<std::vector<int>> all_orders(const OrderProblem& problem) {
    std::set<std::vector<int>> orders;
    for_each_sequence(problem, [&](const ItemSequence& sequence) {
        if (keeps_to_limits(problem, sequence))
            orders.insert(sequence.items);
    });
    return orders;
}

} // namespace overt::test
