#include "experiment/scene/ray_caster.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/scene/embree_tree.h"

namespace overt {

namespace {

/// A ray with its origin moved up to the sphere around the mesh: coordinates and distances are then no larger
/// than the mesh, and rounding is relative to that and not to the camera's distance.
struct NearRay {
    glm::dvec3 origin;
    glm::dvec3 direction;
    double moved = 0.0; ///< distance from the original origin
};

/// What a triangle is tested against: the mesh, and how small a volume may be before its sign is doubtful.
struct Target {
    const Mesh* mesh = nullptr;
    double doubtful_volume = 0.0;
};

struct Meeting {
    std::uint32_t triangle = 0;
    glm::dvec3 barycentric{0.0};
    double distance = std::numeric_limits<double>::infinity(); ///< from the near ray's origin
};

/// What travels with a query through Embree. The context must come first: Embree hands back its address.
struct Query {
    RTCIntersectContext context;
    Target target;
    NearRay ray;
    double limit_margin = 0.0;
    Meeting nearest;
    double hidden_within = 0.0; ///< occlusion: what is met before this distance hides
};

/// dot(ray.direction, cross(p, q)) for two corners seen from the ray's origin, in Real.
template <class Real> Real volume_in(const glm::dvec3& from, const glm::dvec3& to, const NearRay& ray) {
    const Real px = Real(from.x) - ray.origin.x, py = Real(from.y) - ray.origin.y,
               pz = Real(from.z) - ray.origin.z;
    const Real qx = Real(to.x) - ray.origin.x, qy = Real(to.y) - ray.origin.y, qz = Real(to.z) - ray.origin.z;
    return ray.direction.x * (py * qz - pz * qy) + ray.direction.y * (pz * qx - px * qz) +
           ray.direction.z * (px * qy - py * qx);
}

/// Volume spanned by the ray and an edge: its sign says on which side the ray passes. The edge's ends swapped
/// change the sign and nothing else, so both triangles at an edge agree. Where rounding could have turned the
/// sign it is computed again with 113 bits, lest a ray slip out between all the triangles around a corner.
double volume(const glm::dvec3& from, const glm::dvec3& to, const NearRay& ray, double doubtful) {
    const auto in_double = volume_in<double>(from, to, ray);
    return std::abs(in_double) > doubtful ? in_double
                                          : static_cast<double>(volume_in<__float128>(from, to, ray));
}

std::optional<Meeting> meet(const Target& target, std::uint32_t triangle, const NearRay& ray) {
    const Mesh& mesh = *target.mesh;
    const glm::uvec3 corners = mesh.triangles[triangle];
    const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]), c(mesh.positions[corners.z]);
    const glm::dvec3 volumes(volume(b, c, ray, target.doubtful_volume),
                             volume(c, a, ray, target.doubtful_volume),
                             volume(a, b, ray, target.doubtful_volume));
    const bool inside = (volumes.x >= 0.0 && volumes.y >= 0.0 && volumes.z >= 0.0) ||
                        (volumes.x <= 0.0 && volumes.y <= 0.0 && volumes.z <= 0.0);
    const double sum = volumes.x + volumes.y + volumes.z;
    if (!inside || sum == 0.0)
        return std::nullopt;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double approach = glm::dot(normal, ray.direction);
    if (approach == 0.0)
        return std::nullopt; // along the plane
    return Meeting{triangle, volumes / sum, glm::dot(normal, a - ray.origin) / approach};
}

} // namespace

struct RayCaster::Tree {
    const Mesh* mesh = nullptr;
    glm::dvec3 centre{0.0};
    double radius = 0.0; ///< of a sphere about the centre that holds the mesh
    double margin = 0.0; ///< that boxes are widened by
    EmbreeTree embree;

    explicit Tree(const Mesh& of_mesh);
    Tree(const Tree&) = delete; // Embree holds its address
    Tree& operator=(const Tree&) = delete;

    std::optional<NearRay> brought_near(const Ray& ray) const noexcept;
    Query query(const NearRay& ray) const noexcept;
    RTCRay tree_ray(const NearRay& ray, double limit) const noexcept;

    // Called by Embree.
    static void give_bounds(const RTCBoundsFunctionArguments* arguments);
    static void meet_first(const RTCIntersectFunctionNArguments* arguments);
    static void meet_any(const RTCOccludedFunctionNArguments* arguments);
};

void RayCaster::Tree::give_bounds(const RTCBoundsFunctionArguments* arguments) {
    const Tree& tree = *static_cast<const Tree*>(arguments->geometryUserPtr);
    *arguments->bounds_o = box_of(*tree.mesh, arguments->primID, tree.centre, tree.margin);
}

void RayCaster::Tree::meet_first(const RTCIntersectFunctionNArguments* arguments) {
    if (arguments->valid[0] == 0)
        return;
    Query& query = *reinterpret_cast<Query*>(arguments->context);
    const std::optional<Meeting> meeting = meet(query.target, arguments->primID, query.ray);
    if (!meeting || !(meeting->distance + query.ray.moved > 0.0))
        return;
    Meeting& nearest = query.nearest;
    if (meeting->distance > nearest.distance ||
        (meeting->distance == nearest.distance && meeting->triangle > nearest.triangle))
        return;
    nearest = *meeting;
    RTCRayN* ray = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
    RTCRayN_tfar(ray, arguments->N, 0) = static_cast<float>(nearest.distance + query.limit_margin);
}

void RayCaster::Tree::meet_any(const RTCOccludedFunctionNArguments* arguments) {
    if (arguments->valid[0] == 0)
        return;
    const Query& query = *reinterpret_cast<const Query*>(arguments->context);
    const std::optional<Meeting> meeting = meet(query.target, arguments->primID, query.ray);
    if (meeting && meeting->distance + query.ray.moved > 0.0 && meeting->distance < query.hidden_within)
        RTCRayN_tfar(arguments->ray, arguments->N, 0) = -std::numeric_limits<float>::infinity();
}

RayCaster::Tree::Tree(const Mesh& of_mesh) : mesh(&of_mesh) {
    const Bounds bounds = of_mesh.bounds();
    centre = bounds.centre();
    radius = 0.501 * bounds.diagonal();
    margin = tree_widening * radius;
    const RTCGeometry geometry = embree.user_geometry(of_mesh.triangles.size());
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryBoundsFunction(geometry, give_bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, meet_first);
    rtcSetGeometryOccludedFunction(geometry, meet_any);
    embree.build(geometry, "build the tree of a mesh");
}

std::optional<NearRay> RayCaster::Tree::brought_near(const Ray& ray) const noexcept {
    const glm::dvec3 to_centre = centre - ray.origin;
    const double closest = glm::dot(to_centre, ray.direction);
    const double off_axis = glm::length(to_centre - closest * ray.direction);
    if (!(off_axis <= radius) || closest < -radius)
        return std::nullopt; // passes the mesh, leaves it behind, or is not a number
    const double moved = std::max(0.0, closest - radius);
    return NearRay{ray.origin + moved * ray.direction, ray.direction, moved};
}

Query RayCaster::Tree::query(const NearRay& ray) const noexcept {
    Query query;
    rtcInitIntersectContext(&query.context);
    // Twelve roundings of a product of two lengths of up to 2.5 radii.
    query.target = {mesh, 1e-14 * radius * radius};
    query.ray = ray;
    query.limit_margin = margin;
    return query;
}

RTCRay RayCaster::Tree::tree_ray(const NearRay& ray, double limit) const noexcept {
    const glm::vec3 origin(ray.origin - centre), direction(ray.direction);
    RTCRay tree_ray{};
    tree_ray.org_x = origin.x;
    tree_ray.org_y = origin.y;
    tree_ray.org_z = origin.z;
    tree_ray.dir_x = direction.x;
    tree_ray.dir_y = direction.y;
    tree_ray.dir_z = direction.z;
    tree_ray.tfar = static_cast<float>(limit);
    tree_ray.mask = ~0u;
    return tree_ray;
}

RayCaster::RayCaster(const Mesh& mesh) : tree_(std::make_unique<Tree>(mesh)) {}
RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

std::optional<RayHit> RayCaster::first_hit(const Ray& object_ray) const noexcept {
    const std::optional<NearRay> near_ray = tree_->brought_near(object_ray);
    if (!near_ray)
        return std::nullopt;
    Query query = tree_->query(*near_ray);
    RTCRayHit ray_hit{};
    ray_hit.ray = tree_->tree_ray(*near_ray, std::numeric_limits<double>::infinity());
    ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(tree_->embree.scene(), &query.context, &ray_hit);
    const Meeting& nearest = query.nearest;
    if (std::isinf(nearest.distance))
        return std::nullopt;
    return RayHit{nearest.triangle, nearest.barycentric, near_ray->moved + nearest.distance,
                  near_ray->origin + nearest.distance * near_ray->direction};
}

void RayCaster::first_hits(std::span<const Ray> object_rays, std::span<std::optional<RayHit>> hits) const {
    OVERT_EXPECTS(object_rays.size() == hits.size());
    constexpr std::size_t batch = 4096;
    const int batches = static_cast<int>((object_rays.size() + batch - 1) / batch);
    parallel_for(batches, [&](int index) {
        const std::size_t begin = static_cast<std::size_t>(index) * batch;
        const std::size_t end = std::min(begin + batch, object_rays.size());
        for (std::size_t i = begin; i < end; ++i)
            hits[i] = first_hit(object_rays[i]);
    });
}

bool RayCaster::is_hidden(glm::dvec3 surface_point, glm::dvec3 eye) const noexcept {
    const glm::dvec3 to_point = surface_point - eye;
    const double distance = glm::length(to_point);
    if (distance == 0.0)
        return false;
    const std::optional<NearRay> near_ray = tree_->brought_near({eye, to_point / distance});
    if (!near_ray)
        return false;
    Query query = tree_->query(*near_ray);
    query.hidden_within = distance * (1.0 - 1e-9) - near_ray->moved;
    if (!(query.hidden_within > 0.0))
        return false;
    RTCRay ray = tree_->tree_ray(*near_ray, query.hidden_within + query.limit_margin);
    rtcOccluded1(tree_->embree.scene(), &query.context, &ray);
    return ray.tfar < 0.0f;
}

} // namespace overt
