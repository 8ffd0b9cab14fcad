#include "experiment/scene/nearest_sites.h"

#include <cmath>
#include <limits>
#include <vector>

#include "experiment/base/error.h"
#include "experiment/scene/embree_tree.h"

namespace overt {

struct NearestSites::Tree {
    const Mesh* mesh = nullptr;
    std::vector<std::uint32_t> triangles; ///< that are taken, rising
    glm::dvec3 centre{0.0};
    double margin = 0.0; ///< that boxes are widened by
    EmbreeTree embree;
};

namespace {

struct NearestQuery {
    const Mesh* mesh = nullptr;
    const std::vector<std::uint32_t>* triangles = nullptr;
    glm::dvec3 position{0.0};
    double margin = 0.0;
    SurfaceSite best;
    double least = std::numeric_limits<double>::infinity(); ///< squared distance of it
};

} // namespace

NearestSites::NearestSites(const Mesh& mesh,
                           const std::function<bool(std::uint32_t triangle)>& takes_triangle)
    : tree_(std::make_unique<Tree>()) {
    tree_->mesh = &mesh;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
        if (!takes_triangle || takes_triangle(i))
            tree_->triangles.push_back(i);
    OVERT_EXPECTS(!tree_->triangles.empty());
    const Bounds bounds = mesh.bounds();
    tree_->centre = bounds.centre();
    tree_->margin = tree_widening * bounds.diagonal();
    const RTCGeometry geometry = tree_->embree.user_geometry(tree_->triangles.size());
    rtcSetGeometryUserData(geometry, tree_.get());
    rtcSetGeometryBoundsFunction(
        geometry,
        [](const RTCBoundsFunctionArguments* arguments) {
            const Tree& tree = *static_cast<const Tree*>(arguments->geometryUserPtr);
            *arguments->bounds_o =
                box_of(*tree.mesh, tree.triangles[arguments->primID], tree.centre, tree.margin);
        },
        nullptr);
    tree_->embree.build(geometry, "build the tree of a surface");
}

NearestSites::~NearestSites() = default;
NearestSites::NearestSites(NearestSites&&) noexcept = default;
NearestSites& NearestSites::operator=(NearestSites&&) noexcept = default;

SurfaceSite NearestSites::nearest(const glm::dvec3& position) const noexcept {
    NearestQuery asked{tree_->mesh, &tree_->triangles, position, tree_->margin, {}};
    const glm::vec3 in_tree(position - tree_->centre);
    RTCPointQuery query{in_tree.x, in_tree.y, in_tree.z, 0.0f, std::numeric_limits<float>::infinity()};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(
        tree_->embree.scene(), &query, &context,
        [](RTCPointQueryFunctionArguments* arguments) {
            auto& of = *static_cast<NearestQuery*>(arguments->userPtr);
            const std::uint32_t triangle = (*of.triangles)[arguments->primID];
            const SurfaceSite site = nearest_of_triangle(*of.mesh, triangle, of.position);
            const glm::dvec3 off = position_of(*of.mesh, site) - of.position;
            const double squared = glm::dot(off, off);
            if (squared > of.least || (squared == of.least && triangle > of.best.triangle))
                return false;
            of.best = site;
            of.least = squared;
            // Floats far from the mesh are coarse: wider by more than they can be off.
            const double radius = std::sqrt(squared);
            arguments->query->radius = static_cast<float>(radius * (1.0 + tree_widening) + of.margin);
            return true;
        },
        &asked);
    return asked.best;
}

} // namespace overt
