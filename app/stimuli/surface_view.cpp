#include "app/stimuli/surface_view.h"

#include <vector>

#include "experiment/scene/files/mesh_reader.h"

namespace overt {

Protocol plain_protocol(const std::filesystem::path& mesh, const std::string& up, const std::string& unit) {
    const bool is_gltf = is_gltf_name(mesh);
    Protocol protocol;
    ObjectSettings object;
    object.id = mesh.stem().string();
    object.mesh = mesh;
    object.up = !up.empty() ? up : is_gltf ? "y" : "z";
    object.unit = !unit.empty() ? unit : is_gltf ? "m" : "mm";
    protocol.objects = {object};
    MaterialSettings material;
    material.id = "grey";
    material.kind = MaterialKind::diffuse;
    protocol.materials = {material};
    protocol.display.background = 0.1;
    protocol.views.front().width_px = protocol.views.front().height_px = 900;
    return protocol;
}

SurfaceView::SurfaceView(const GlContext& context, const Protocol& protocol, const Object& object,
                         glm::ivec2 image_px)
    : caster_(object.mesh), view_(context, protocol, {&object, 1}, image_px), scene_(object.scene()) {
    scene_.view.image_px = image_px;
    view_.choose({0, 0});
}

Ray SurfaceView::ray_at(glm::dvec2 image_px, const Orbit& orbit) const {
    return to_object(seen_from(scene_, orbit).view.ray_through(image_px), scene_.pose_at({{orbit.turn_deg}}));
}

std::optional<RayHit> SurfaceView::surface_at(glm::dvec2 image_px, const Orbit& orbit) const {
    return caster_.first_hit(ray_at(image_px, orbit));
}

LinearImage SurfaceView::draw(const Orbit& orbit, const Tint& tint, std::span<const glm::dvec3> marks) {
    LinearImage picture = view_.draw(orbit);
    add_tints(picture, orbit, tint);
    for (const glm::dvec3& point : marks)
        mark(picture, orbit, point);
    return picture;
}

/// In squares of two pixels, which is fine enough to judge and quick enough to follow the hand.
void SurfaceView::add_tints(LinearImage& picture, const Orbit& orbit, const Tint& tint) const {
    const View view = seen_from(scene_, orbit).view;
    const TurntablePose pose = scene_.pose_at({{orbit.turn_deg}});
    const glm::ivec2 squares = picture.size_px / 2;
    std::vector<Ray> rays;
    rays.reserve(static_cast<std::size_t>(squares.x) * static_cast<std::size_t>(squares.y));
    for (int y = 0; y < squares.y; ++y)
        for (int x = 0; x < squares.x; ++x)
            rays.push_back(to_object(view.ray_through({2.0 * x + 1.0, 2.0 * y + 1.0}), pose));
    std::vector<std::optional<RayHit>> hits(rays.size());
    caster_.first_hits(rays, hits);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const std::optional<glm::vec3> colour = hits[i] ? tint(hits[i]->triangle) : std::nullopt;
        if (!colour)
            continue;
        const glm::ivec2 corner =
            2 * glm::ivec2(static_cast<int>(i) % squares.x, static_cast<int>(i) / squares.x);
        for (const glm::ivec2 step : {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(1, 1)})
            picture.at(corner.x + step.x, corner.y + step.y) *= glm::vec4(*colour, 1.0f);
    }
}

void SurfaceView::mark(LinearImage& picture, const Orbit& orbit, glm::dvec3 point) const {
    const glm::dmat4 world_from_object = scene_.pose_at({{orbit.turn_deg}}).world_from_object();
    const View view = seen_from(scene_, orbit).view;
    const glm::ivec2 middle(view.project(glm::dvec3(world_from_object * glm::dvec4(point, 1.0))));
    for (int y = -4; y <= 4; ++y) {
        for (int x = -4; x <= 4; ++x) {
            const glm::ivec2 at = middle + glm::ivec2(x, y);
            if (x * x + y * y <= 16 && at.x >= 0 && at.y >= 0 && at.x < picture.size_px.x &&
                at.y < picture.size_px.y)
                picture.at(at.x, at.y) = glm::vec4(0.1f, 0.5f, 1.0f, 1.0f);
        }
    }
}

} // namespace overt
