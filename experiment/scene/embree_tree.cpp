#include "experiment/scene/embree_tree.h"

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

void refuse(RTCDevice device, const char* what) {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE) {
        throw GraphicsError(fmt::format("Embree cannot {} (its error {}): check that enough memory is free",
                                        what, static_cast<int>(error)));
    }
}

} // namespace

EmbreeTree::EmbreeTree() {
    device_.reset(rtcNewDevice(nullptr));
    if (!device_)
        refuse(nullptr, "start");
    scene_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
}

RTCGeometry EmbreeTree::user_geometry(std::size_t boxes) {
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes));
    return geometry;
}

void EmbreeTree::build(RTCGeometry geometry, const char* what) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry); // the scene keeps it
    rtcCommitScene(scene_.get());
    refuse(device_.get(), what);
}

RTCBounds box_of(const Mesh& mesh, std::size_t triangle, const glm::dvec3& centre, double margin) {
    const glm::uvec3 corners = mesh.triangles[triangle];
    const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]), c(mesh.positions[corners.z]);
    const glm::vec3 low(glm::min(a, glm::min(b, c)) - centre - margin);
    const glm::vec3 high(glm::max(a, glm::max(b, c)) - centre + margin);
    return {low.x, low.y, low.z, 0.0f, high.x, high.y, high.z, 0.0f};
}

} // namespace overt
