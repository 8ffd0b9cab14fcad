#include "render/bake/surface_tree.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

struct DeviceRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

void refuse(RTCDevice device) {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE) {
        throw GraphicsError(fmt::format(
            "Embree cannot build the tree of a stimulus (its error {}): check that enough memory is free",
            static_cast<int>(error)));
    }
}

RTCRayHit cast_into(RTCScene scene, const PathRay& ray, float limit, bool coherent) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    RTCRayHit cast{};
    cast.ray.org_x = ray.origin.x;
    cast.ray.org_y = ray.origin.y;
    cast.ray.org_z = ray.origin.z;
    cast.ray.dir_x = ray.direction.x;
    cast.ray.dir_y = ray.direction.y;
    cast.ray.dir_z = ray.direction.z;
    cast.ray.tfar = limit;
    cast.ray.mask = ~0u;
    cast.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    cast.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &cast);
    return cast;
}

template <class Item>
void give(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const std::vector<Item>& items) {
    void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Item), items.size());
    if (buffer != nullptr)
        std::memcpy(buffer, items.data(), items.size() * sizeof(Item));
}

/// Square of the distance from the origin to a triangle: to its plane where that is met inside, else to the
/// nearest of its edges.
float squared_distance(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const glm::vec3 normal = glm::cross(b - a, c - a);
    const float length_squared = glm::dot(normal, normal);
    const auto is_within = [&](glm::vec3 from, glm::vec3 to) {
        return glm::dot(glm::cross(to - from, -from), normal) >= 0.0f;
    };
    if (length_squared > 0.0f && is_within(a, b) && is_within(b, c) && is_within(c, a)) {
        const float height = glm::dot(a, normal);
        return height * height / length_squared;
    }
    const auto to_edge = [](glm::vec3 from, glm::vec3 to) {
        const glm::vec3 along = to - from;
        const float squared = glm::dot(along, along);
        const float share = squared > 0.0f ? glm::clamp(-glm::dot(from, along) / squared, 0.0f, 1.0f) : 0.0f;
        const glm::vec3 nearest = from + share * along;
        return glm::dot(nearest, nearest);
    };
    return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
}

struct ClearanceQuery {
    const std::vector<const TracedSurface*>* surfaces;
    glm::vec3 point;
    float squared;
};

bool comes_nearer(RTCPointQueryFunctionArguments* arguments) {
    ClearanceQuery& query = *static_cast<ClearanceQuery*>(arguments->userPtr);
    const TracedSurface& surface = *(*query.surfaces)[arguments->geomID];
    const glm::uvec3& corners = surface.triangles[arguments->primID];
    const float squared = squared_distance(surface.positions[corners.x] - query.point,
                                           surface.positions[corners.y] - query.point,
                                           surface.positions[corners.z] - query.point);
    if (!(squared < query.squared))
        return false;
    query.squared = squared;
    arguments->query->radius = std::sqrt(squared);
    return true;
}

} // namespace

TracedSurface::TracedSurface(const Mesh& mesh, glm::dvec3 centre, double crease_deg)
    : triangles(mesh.triangles), normals(corner_normals(mesh, crease_deg)) {
    positions.reserve(mesh.positions.size());
    for (const glm::vec3& position : mesh.positions)
        positions.emplace_back(glm::dvec3(position) - centre);
}

struct SurfaceTree::Tree {
    std::vector<const TracedSurface*> surfaces;
    std::unique_ptr<RTCDeviceTy, DeviceRelease> device;
    std::unique_ptr<RTCSceneTy, SceneRelease> scene;
};

SurfaceTree::SurfaceTree(std::vector<const TracedSurface*> surfaces) : tree_(std::make_unique<Tree>()) {
    tree_->surfaces = std::move(surfaces);
    tree_->device.reset(rtcNewDevice("threads=1,set_affinity=0"));
    if (!tree_->device)
        refuse(nullptr);
    const RTCDevice device = tree_->device.get();
    tree_->scene.reset(rtcNewScene(device));
    rtcSetSceneFlags(tree_->scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(tree_->scene.get(), RTC_BUILD_QUALITY_HIGH);
    for (const TracedSurface* surface : tree_->surfaces) {
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        give(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, surface->positions);
        give(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, surface->triangles);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(tree_->scene.get(), geometry);
        rtcReleaseGeometry(geometry); // the scene keeps it
    }
    rtcCommitScene(tree_->scene.get());
    refuse(device);
}

SurfaceTree::~SurfaceTree() = default;
SurfaceTree::SurfaceTree(SurfaceTree&&) noexcept = default;
SurfaceTree& SurfaceTree::operator=(SurfaceTree&&) noexcept = default;

SurfaceHit SurfaceTree::first_hit(const PathRay& ray, float limit, bool coherent) const noexcept {
    const RTCRayHit cast = cast_into(tree_->scene.get(), ray, limit, coherent);
    SurfaceHit hit;
    if (cast.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return hit;
    hit.surface = static_cast<int>(cast.hit.geomID);
    hit.triangle = cast.hit.primID;
    hit.place = {cast.hit.u, cast.hit.v};
    hit.distance = cast.ray.tfar;
    hit.position = ray.origin + cast.ray.tfar * ray.direction;
    hit.triangle_normal = glm::normalize(glm::vec3(cast.hit.Ng_x, cast.hit.Ng_y, cast.hit.Ng_z));
    const CornerNormals& corners = tree_->surfaces[cast.hit.geomID]->normals[cast.hit.primID];
    const glm::vec3 mean =
        (1.0f - cast.hit.u - cast.hit.v) * corners[0] + cast.hit.u * corners[1] + cast.hit.v * corners[2];
    const float length = glm::length(mean);
    hit.shading_normal = length > 1e-3f ? mean / length : hit.triangle_normal;
    return hit;
}

float SurfaceTree::first_distance(const PathRay& ray, bool coherent) const noexcept {
    const RTCRayHit cast =
        cast_into(tree_->scene.get(), ray, std::numeric_limits<float>::infinity(), coherent);
    return cast.hit.geomID == RTC_INVALID_GEOMETRY_ID ? -1.0f : cast.ray.tfar;
}

float SurfaceTree::clearance(glm::vec3 point, float most) const noexcept {
    ClearanceQuery found{&tree_->surfaces, point, most * most};
    RTCPointQuery query{};
    query.x = point.x;
    query.y = point.y;
    query.z = point.z;
    query.radius = most;
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(tree_->scene.get(), &query, &context, comes_nearer, &found);
    return found.squared < most * most ? std::sqrt(found.squared) : most;
}

} // namespace overt
