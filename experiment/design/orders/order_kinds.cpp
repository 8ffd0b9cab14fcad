#include "experiment/design/orders/order_kinds.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace overt {

namespace {

std::vector<int> limited_factors(const OrderProblem& problem) {
    std::vector<int> factors;
    for (const OrderLimit& limit : problem.limits)
        factors.push_back(limit.factor);
    std::sort(factors.begin(), factors.end());
    factors.erase(std::unique(factors.begin(), factors.end()), factors.end());
    return factors;
}

} // namespace

OrderKinds::OrderKinds(const OrderProblem& problem) : limited(limited_factors(problem)) {
    std::size_t items = 0;
    for (const OrderPart& part : problem.parts) {
        for (const OrderSegment& segment : part.segments) {
            for (const int item : segment.items)
                items = std::max(items, static_cast<std::size_t>(item) + 1);
        }
    }
    std::map<std::vector<int>, int> numbers;
    for (std::size_t item = 0; item < items; ++item) {
        std::vector<int> seen;
        for (const int factor : limited)
            seen.push_back(problem.levels[static_cast<std::size_t>(factor)][item]);
        const auto [known, is_new] = numbers.try_emplace(seen, count);
        if (is_new) {
            ++count;
            std::vector<int> all;
            for (const auto& factor : problem.levels)
                all.push_back(factor[item]);
            levels.push_back(std::move(all));
        }
        kind_of_item.push_back(known->second);
    }
    const auto kinds = static_cast<std::size_t>(count);
    for (const OrderPart& part : problem.parts) {
        counts.emplace_back();
        weights.emplace_back();
        for (const OrderSegment& segment : part.segments) {
            std::vector<int>& number = counts.back().emplace_back(kinds);
            std::vector<double>& weight = weights.back().emplace_back();
            if (segment.is_drawn())
                weight.assign(kinds, 0.0);
            for (std::size_t i = 0; i < segment.items.size(); ++i) {
                const auto kind =
                    static_cast<std::size_t>(kind_of_item[static_cast<std::size_t>(segment.items[i])]);
                ++number[kind];
                if (segment.is_drawn())
                    weight[kind] += segment.weights[i];
            }
            const double sum = std::accumulate(weight.begin(), weight.end(), 0.0);
            for (double& share : weight)
                share /= sum;
        }
    }
    // From the end: a place's role of a kind is the number of all that follows. Within a part of several
    // segments, all of the part's count as following.
    std::vector<std::vector<double>> following(kinds);
    role.resize(problem.parts.size());
    for (std::size_t part = problem.parts.size(); part-- > 0;) {
        const bool is_one = problem.parts[part].segments.size() == 1;
        const auto add = [&] {
            for (std::size_t segment = 0; segment < counts[part].size(); ++segment) {
                const bool drawn = !weights[part][segment].empty();
                for (std::size_t kind = 0; kind < kinds; ++kind)
                    following[kind].push_back(drawn ? weights[part][segment][kind]
                                                    : counts[part][segment][kind]);
            }
        };
        if (!is_one || problem.parts[part].segments.front().is_drawn())
            add();
        std::map<std::vector<double>, std::uint32_t> classes;
        for (std::size_t kind = 0; kind < kinds; ++kind) {
            const bool is_idle = std::all_of(following[kind].begin(), following[kind].end(),
                                             [](double number) { return number == 0.0; });
            role[part].push_back(
                is_idle ? 0
                        : classes.try_emplace(following[kind], static_cast<std::uint32_t>(classes.size()) + 1)
                              .first->second);
        }
        if (is_one && !problem.parts[part].segments.front().is_drawn())
            add();
    }
}

} // namespace overt
