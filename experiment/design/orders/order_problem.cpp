#include "experiment/design/orders/order_problem.h"

#include "experiment/design/orders/order_history.h"

namespace overt {

int OrderProblem::length() const {
    int length = 0;
    for (const OrderPart& part : parts) {
        for (const OrderSegment& segment : part.segments)
            length += segment.length();
    }
    return length;
}

bool keeps_to_limits(const OrderProblem& problem, const OrderHistory::Reach& reach,
                     const ItemSequence& sequence, std::size_t begin, std::size_t end) {
    if (problem.limits.empty())
        return true;
    OrderHistory history(reach);
    std::vector<int> levels(problem.levels.size());
    for (std::size_t i = begin; i < end; ++i) {
        for (std::size_t factor = 0; factor < levels.size(); ++factor)
            levels[factor] = problem.levels[factor][static_cast<std::size_t>(sequence.items[i])];
        if (!history.allows(levels, sequence.parts[i]))
            return false;
        history.push(levels);
    }
    return true;
}

bool keeps_to_limits(const OrderProblem& problem, const ItemSequence& sequence) {
    return keeps_to_limits(problem, OrderHistory::Reach(problem), sequence, 0, sequence.items.size());
}

} // namespace overt
