#include "experiment/surface/geodesic_field.h"

#include <algorithm>
#include <cmath>

#include "experiment/base/error.h"

namespace overt {
namespace {

/// Nodes around the source, at most, for which the mesh's own triangles are asked, too.
constexpr std::size_t near_nodes = 64;

// Distance of the third corner of a triangle from a source beyond the side between two corners a and b, whose
// distances are known; `ab` and so on are the lengths of its sides. Where the way does not cross that side,
// it leads along one of the others.
double across_side(double from_a, double from_b, double ab, double ac, double bc) {
    const double along_sides = std::min(from_a + ac, from_b + bc);
    if (ab <= 0.0)
        return along_sides;
    // a at the origin, b on the x axis, the third corner above, the source below.
    const double source_x = (from_a * from_a - from_b * from_b + ab * ab) / (2.0 * ab);
    const double source_y_squared = from_a * from_a - source_x * source_x;
    const double x = (ac * ac - bc * bc + ab * ab) / (2.0 * ab);
    const double y = std::sqrt(std::max(0.0, ac * ac - x * x));
    if (source_y_squared < 0.0)
        return along_sides;
    const double source_y = std::sqrt(source_y_squared);
    if (source_y + y <= 0.0)
        return along_sides;
    const double crossing = source_x + (x - source_x) * source_y / (source_y + y);
    if (crossing < 0.0 || crossing > ab)
        return along_sides;
    // std::hypot would take a tenth of all the time, and these are millimetres.
    const double across = x - source_x, along = y + source_y;
    return std::min(along_sides, std::sqrt(across * across + along * along));
}

} // namespace

GeodesicField::GeodesicField(const SurfaceGeometry& geometry)
    : geometry_(geometry), known_in_(geometry.node_count(), 0), offered_in_(geometry.node_count(), 0),
      distances_(geometry.node_count(), 0.0) {}

void GeodesicField::offer(std::uint32_t node, double distance) {
    if (is_known(node) || distance >= reach_mm_)
        return;
    if (offered_in_[node] == run_ && distances_[node] <= distance)
        return;
    offered_in_[node] = run_;
    distances_[node] = distance;
    heap_.push_back({distance, node});
    std::push_heap(heap_.begin(), heap_.end());
}

void GeodesicField::offer_across(std::uint32_t node, std::uint32_t b, std::uint32_t c, double to_b,
                                 double to_c, double b_to_c) {
    // A side may lead from a node back to itself: that says nothing of where the source is.
    if (b == node || c == node)
        return;
    const double here = distances_[node];
    offer(c, is_known(b) ? across_side(here, distances_[b], to_b, to_c, b_to_c) : here + to_c);
    offer(b, is_known(c) ? across_side(here, distances_[c], to_c, to_b, b_to_c) : here + to_b);
}

void GeodesicField::offer_around(std::uint32_t node) {
    const IntrinsicTriangulation& triangulation = geometry_.triangulation();
    for (const auto [index, corner] : triangulation.corners_at(node)) {
        const IntrinsicTriangulation::Triangle& t = triangulation.triangles()[index];
        const std::size_t next = (corner + 1) % 3, last = (corner + 2) % 3;
        offer_across(node, t.nodes[next], t.nodes[last], t.lengths_mm[corner], t.lengths_mm[last],
                     t.lengths_mm[next]);
    }
    // Near the source it is the mesh's own triangles that say on which side of an edge it lies.
    if (reached_.size() > near_nodes)
        return;
    const std::span<const glm::dvec3> positions = geometry_.node_positions_mm();
    for (const std::uint32_t triangle : geometry_.triangles_at(node)) {
        const glm::uvec3& t = geometry_.corners(triangle);
        const int corner = t.x == node ? 0 : t.y == node ? 1 : 2;
        const std::uint32_t b = t[(corner + 1) % 3], c = t[(corner + 2) % 3];
        offer_across(node, b, c, glm::distance(positions[node], positions[b]),
                     glm::distance(positions[node], positions[c]), glm::distance(positions[b], positions[c]));
    }
}

void GeodesicField::spread_from(const SurfacePlace& source, double reach_mm) {
    spread_until(source, reach_mm, {});
}

void GeodesicField::spread_until(const SurfacePlace& source, double reach_mm, const IsEnough& is_enough) {
    source_ = source;
    reach_mm_ = reach_mm;
    ++run_;
    reached_.clear();
    heap_.clear();
    const glm::dvec3 place = geometry_.position_mm(source);
    const glm::uvec3& corners = geometry_.corners(source.triangle);
    for (int k = 0; k < 3; ++k)
        offer(corners[k], glm::distance(place, geometry_.node_positions_mm()[corners[k]]));
    while (!heap_.empty()) {
        std::pop_heap(heap_.begin(), heap_.end());
        const Candidate nearest = heap_.back();
        heap_.pop_back();
        if (is_known(nearest.node) || nearest.distance > distances_[nearest.node])
            continue;
        known_in_[nearest.node] = run_;
        reached_.push_back(nearest.node);
        if (is_enough && is_enough(nearest.node, nearest.distance))
            return;
        offer_around(nearest.node);
    }
}

double GeodesicField::to(const SurfacePlace& place) const {
    const glm::dvec3 position = geometry_.position_mm(place);
    if (place.triangle == source_.triangle)
        return glm::distance(position, geometry_.position_mm(source_));
    const glm::uvec3& corners = geometry_.corners(place.triangle);
    double nearest = unreached;
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = corners[k], b = corners[(k + 1) % 3];
        const std::span<const glm::dvec3> positions = geometry_.node_positions_mm();
        if (!is_known(a))
            continue;
        const double from_a = glm::distance(position, positions[a]);
        nearest = std::min(nearest, distances_[a] + from_a);
        if (is_known(b))
            nearest = std::min(nearest, across_side(distances_[a], distances_[b],
                                                    glm::distance(positions[a], positions[b]), from_a,
                                                    glm::distance(position, positions[b])));
    }
    return nearest;
}

} // namespace overt
