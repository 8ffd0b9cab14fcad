#include "experiment/scene/making/area_painting.h"

#include <algorithm>
#include <tuple>

#include "experiment/base/error.h"

namespace overt {

namespace {

/// By triangle, those that share its edges; of an edge of three triangles or more some two.
std::vector<std::array<std::uint32_t, 3>> neighbours_of(const Mesh& mesh, std::uint32_t none) {
    struct Side {
        std::uint32_t low, high, triangle, edge;
    };
    std::vector<Side> sides;
    sides.reserve(3 * mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t edge = 0; edge < 3; ++edge) {
            const std::uint32_t a = mesh.triangles[t][static_cast<int>(edge)],
                                b = mesh.triangles[t][static_cast<int>((edge + 1) % 3)];
            sides.push_back({std::min(a, b), std::max(a, b), t, edge});
        }
    }
    std::ranges::sort(sides, [](const Side& one, const Side& other) {
        return std::tie(one.low, one.high, one.triangle) < std::tie(other.low, other.high, other.triangle);
    });
    std::vector<std::array<std::uint32_t, 3>> neighbours(mesh.triangles.size(), {none, none, none});
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
        const Side &one = sides[i], &other = sides[i + 1];
        if (one.low != other.low || one.high != other.high)
            continue;
        neighbours[one.triangle][one.edge] = other.triangle;
        neighbours[other.triangle][other.edge] = one.triangle;
    }
    return neighbours;
}

} // namespace

AreaPainting::AreaPainting(const Mesh& mesh, std::vector<Paint> paints)
    : mesh_(&mesh), sites_(mesh), neighbours_(neighbours_of(mesh, none)), paints_(std::move(paints)) {
    paints_.resize(mesh.triangles.size(), 0);
}

glm::dvec3 AreaPainting::middle(std::uint32_t triangle) const {
    return position_of(*mesh_, {triangle, glm::dvec3(1.0 / 3.0)});
}

double AreaPainting::share(Paint paint) const {
    double own = 0.0, all = 0.0;
    for (std::uint32_t t = 0; t < paints_.size(); ++t) {
        const glm::uvec3& of = mesh_->triangles[t];
        const glm::dvec3 a(mesh_->positions[of.x]), b(mesh_->positions[of.y]), c(mesh_->positions[of.z]);
        const double area = glm::length(glm::cross(b - a, c - a));
        all += area;
        own += paints_[t] == paint ? area : 0.0;
    }
    return all > 0.0 ? own / all : 0.0;
}

void AreaPainting::begin_step() {
    if (steps_.empty() || !steps_.back().empty())
        steps_.emplace_back();
}

bool AreaPainting::undo() {
    while (!steps_.empty() && steps_.back().empty())
        steps_.pop_back();
    if (steps_.empty())
        return false;
    // Backwards: a triangle may have been painted twice.
    for (auto change = steps_.back().rbegin(); change != steps_.back().rend(); ++change)
        paints_[change->first] = change->second;
    steps_.pop_back();
    return true;
}

void AreaPainting::set(std::uint32_t triangle, Paint paint) {
    if (paints_[triangle] == paint)
        return;
    if (steps_.empty())
        steps_.emplace_back();
    steps_.back().emplace_back(triangle, paints_[triangle]);
    paints_[triangle] = paint;
}

void AreaPainting::dab(const SurfaceSite& at, double radius, Paint paint) {
    const glm::dvec3 place = position_of(*mesh_, at);
    std::vector<bool> is_reached(paints_.size());
    std::vector<std::uint32_t> open{at.triangle};
    is_reached[at.triangle] = true;
    while (!open.empty()) {
        const std::uint32_t triangle = open.back();
        open.pop_back();
        set(triangle, paint);
        for (const std::uint32_t next : neighbours_[triangle]) {
            if (next == none || is_reached[next] || glm::distance(middle(next), place) > radius)
                continue;
            is_reached[next] = true;
            open.push_back(next);
        }
    }
}

bool AreaPainting::borders(std::uint32_t triangle, Paint paint, bool on_it) const {
    return std::ranges::any_of(neighbours_[triangle], [&](std::uint32_t next) {
        return next != none && (paints_[next] == paint) == on_it;
    });
}

void AreaPainting::grow(Paint paint) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t t = 0; t < paints_.size(); ++t)
        if (paints_[t] != paint && borders(t, paint, true))
            found.push_back(t);
    for (const std::uint32_t triangle : found)
        set(triangle, paint);
}

void AreaPainting::shrink(Paint paint) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t t = 0; t < paints_.size(); ++t)
        if (paints_[t] == paint && borders(t, paint, false))
            found.push_back(t);
    for (const std::uint32_t triangle : found)
        set(triangle, 0);
}

void AreaPainting::mirror(Paint paint, double plane_x, double reach) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t t = 0; t < paints_.size(); ++t) {
        if (paints_[t] == paint)
            continue;
        glm::dvec3 place = middle(t);
        place.x = 2.0 * plane_x - place.x;
        const SurfaceSite site = sites_.nearest(place);
        if (paints_[site.triangle] == paint && glm::distance(position_of(*mesh_, site), place) <= reach)
            found.push_back(t);
    }
    for (const std::uint32_t triangle : found)
        set(triangle, paint);
}

} // namespace overt
