#include "experiment/statistics/threshold_free.h"

#include <algorithm>
#include <cmath>

namespace overt {

ThresholdFree::ThresholdFree(const Adjacency& adjacency, std::span<const double> areas)
    : adjacency_(adjacency), areas_(areas), parent_(areas.size()), members_(areas.size()), sum_(areas.size()),
      area_(areas.size()), height_(areas.size()), best_(areas.size()), is_in_(areas.size()) {}

std::uint32_t ThresholdFree::root_of(std::uint32_t vertex) const {
    while (parent_[vertex] != vertex)
        vertex = parent_[vertex];
    return vertex;
}

/// Adds what the component gives from its height down to this one.
void ThresholdFree::settle(std::uint32_t root, double height) {
    const double from = height_[root];
    sum_[root] += std::sqrt(area_[root]) * (from * from * from - height * height * height) / 3.0;
    height_[root] = height;
}

double ThresholdFree::of_sign(std::span<const float> t, float sign, std::vector<float>* enhanced) {
    order_.clear();
    for (std::uint32_t v = 0; v < t.size(); ++v)
        if (sign * t[v] > 0.0f)
            order_.push_back(v);
    std::ranges::sort(order_, [&](std::uint32_t a, std::uint32_t b) {
        return t[a] != t[b] ? sign * t[a] > sign * t[b] : a < b;
    });
    is_in_.assign(is_in_.size(), false);
    for (const std::uint32_t v : order_) {
        const double height = static_cast<double>(sign * t[v]);
        parent_[v] = v;
        members_[v] = 1;
        sum_[v] = best_[v] = 0.0;
        area_[v] = areas_[v];
        height_[v] = height;
        is_in_[v] = true;
        std::uint32_t own = v;
        for (std::uint32_t i = adjacency_.begin[v]; i < adjacency_.begin[v + 1]; ++i) {
            if (!is_in_[adjacency_.neighbours[i]])
                continue;
            std::uint32_t other = root_of(adjacency_.neighbours[i]);
            if (other == own)
                continue;
            settle(own, height);
            settle(other, height);
            if (members_[own] < members_[other])
                std::swap(own, other);
            best_[own] = std::max(best_[own], best_[other] + sum_[other] - sum_[own]);
            sum_[other] -= sum_[own];
            parent_[other] = own;
            members_[own] += members_[other];
            area_[own] += area_[other];
        }
    }
    double largest = 0.0;
    for (const std::uint32_t v : order_)
        if (parent_[v] == v) {
            settle(v, 0.0);
            largest = std::max(largest, best_[v] + sum_[v]);
        }
    for (const std::uint32_t v : order_) {
        if (!enhanced)
            break;
        double sum = sum_[v];
        for (std::uint32_t at = v; parent_[at] != at;) {
            at = parent_[at];
            sum += sum_[at];
        }
        (*enhanced)[v] = static_cast<float>(static_cast<double>(sign) * sum);
    }
    return largest;
}

double ThresholdFree::enhance(std::span<const float> t, std::vector<float>* enhanced) {
    if (enhanced)
        enhanced->assign(t.size(), 0.0f);
    return std::max(of_sign(t, 1.0f, enhanced), of_sign(t, -1.0f, enhanced));
}

} // namespace overt
