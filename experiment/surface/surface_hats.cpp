#include "experiment/surface/surface_hats.h"

#include <algorithm>
#include <numeric>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/surface/geodesic_field.h"

namespace overt {

SurfaceHats::SurfaceHats(const SurfaceGeometry& geometry, double spacing_mm) {
    OVERT_EXPECTS(spacing_mm > 0.0);
    struct Value {
        std::uint32_t node;
        Share share;
    };
    const std::size_t nodes = geometry.node_count();
    std::vector<std::uint32_t> order(nodes);
    std::iota(order.begin(), order.end(), 0u);
    RandomStream random(1, "centres of hats");
    random.shuffle(std::span(order));
    std::vector<bool> is_near(nodes, false);
    std::vector<Value> values;
    GeodesicField field(geometry);
    const double reach = 2.0 * spacing_mm;
    for (const std::uint32_t node : order) {
        if (is_near[node] || geometry.triangles_at(node).empty())
            continue;
        const auto hat = static_cast<std::uint32_t>(centres_.size());
        centres_.push_back(node);
        SurfacePlace place{geometry.triangles_at(node).front(), glm::dvec3(0.0)};
        const glm::uvec3& corners = geometry.corners(place.triangle);
        place.barycentric[corners.x == node ? 0 : (corners.y == node ? 1 : 2)] = 1.0;
        field.spread_from(place, reach);
        is_near[node] = true;
        bool has_own = false;
        for (const std::uint32_t reached : field.reached()) {
            const double r = field.to_node(reached) / reach;
            if (2.0 * r < 1.0)
                is_near[reached] = true;
            const double value = 1.0 - r * r * (3.0 - 2.0 * r);
            if (value > 0.0)
                values.push_back({reached, {hat, value}});
            has_own |= reached == node;
        }
        if (!has_own)
            values.push_back({node, {hat, 1.0}});
    }
    begin_.assign(nodes + 1, 0);
    for (const Value& value : values)
        ++begin_[value.node + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    shares_.resize(values.size());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    std::vector<double> sums(nodes, 0.0);
    for (const Value& value : values) {
        shares_[next[value.node]++] = value.share;
        sums[value.node] += value.share.value;
    }
    for (std::uint32_t node = 0; node < nodes; ++node) {
        for (std::size_t i = begin_[node]; i < begin_[node + 1]; ++i)
            shares_[i].value /= sums[node];
    }
}

} // namespace overt
