/// An order problem with items that no limit tells apart taken together: a kind is one combination of levels
/// of the factors that are limited.
#pragma once

#include <cstdint>
#include <vector>

#include "experiment/design/orders/order_problem.h"

namespace overt {

struct OrderKinds {
    explicit OrderKinds(const OrderProblem& problem);

    int count = 0;
    std::vector<int> kind_of_item;
    std::vector<std::vector<int>> levels; ///< by kind and factor
    std::vector<int> limited;             ///< the factors that any limit is on

    /// What a kind is for, beyond the segment that is being filled: kinds of equal role are interchangeable
    /// there. By part and kind; 0: for nothing.
    std::vector<std::vector<std::uint32_t>> role;

    /// By part and segment: how many items of each kind it has, or with which weights they are drawn.
    std::vector<std::vector<std::vector<int>>> counts;
    std::vector<std::vector<std::vector<double>>> weights; ///< of drawn segments; else empty
};

} // namespace overt
