#include "experiment/design/order_problem.h"

#include "experiment/design/order_history.h"

namespace overt {

int OrderProblem::length() const {
    int length = 0;
    for (const OrderPart& part : parts) {
        for (const OrderSegment& segment : part.segments)
            length += segment.length();
    }
    return length;
}

bool keeps_to_limits(const OrderProblem& problem, const ItemSequence& sequence) {
    if (problem.limits.empty())
        return true;
    const OrderHistory::Reach reach(problem);
    OrderHistory history(reach);
    std::vector<int> levels(problem.levels.size());
    for (std::size_t i = 0; i < sequence.items.size(); ++i) {
        for (std::size_t factor = 0; factor < levels.size(); ++factor)
            levels[factor] = problem.levels[factor][static_cast<std::size_t>(sequence.items[i])];
        if (!history.allows(levels, sequence.parts[i]))
            return false;
        history.push(levels);
    }
    return true;
}

} // namespace overt
