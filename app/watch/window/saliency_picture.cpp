#include "app/watch/window/saliency_picture.h"

#include <algorithm>
#include <cmath>

#include "experiment/base/error.h"
#include "experiment/maps/sight_lines.h"
#include "experiment/surface/colour_scale.h"
#include "watch_shaders.h"

namespace overt {

namespace {

glm::vec3 colour_of(float share) {
    const ColourTable& table = colour_table(ColourMap::viridis);
    const auto& [red, green, blue] =
        table[static_cast<std::size_t>(std::lround(255.0f * std::clamp(share, 0.0f, 1.0f)))];
    return glm::vec3(red, green, blue) / 255.0f;
}

bool is_same(const Orbit& a, const Orbit& b) {
    return a.turn_deg == b.turn_deg && a.elevation_deg == b.elevation_deg && a.distance == b.distance;
}

} // namespace

SaliencyPicture::SaliencyPicture(const GlContext& context)
    : context_(&context), program_(context, "surface", embedded::surface_vert, embedded::surface_frag),
      array_(context) {}

void SaliencyPicture::upload(const SaliencyMap& map) {
    const GladGLContext& gl = context_->gl();
    array_.bind();
    const auto attribute = [&](GLuint index, std::optional<Buffer>& buffer,
                               std::span<const glm::vec3> values) {
        buffer.emplace(*context_, GL_ARRAY_BUFFER, std::as_bytes(values), GL_STATIC_DRAW);
        gl.EnableVertexAttribArray(index);
        gl.VertexAttribPointer(index, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    };
    if (!map_ || map_->surface != map.surface) {
        attribute(0, positions_, map.surface->positions);
        attribute(1, normals_, map.surface->vertex_normals());
        triangles_.emplace(*context_, GL_ELEMENT_ARRAY_BUFFER,
                           std::as_bytes(std::span(map.surface->triangles)), GL_STATIC_DRAW);
    }
    std::vector<glm::vec3> colours(map.share.size());
    std::ranges::transform(map.share, colours.begin(), colour_of);
    attribute(2, colours_, colours);
}

GLuint SaliencyPicture::draw(const WatchedObject& object, const std::shared_ptr<const SaliencyMap>& map,
                             const Orbit& orbit, glm::ivec2 size_px) {
    const bool is_other_size = !frame_ || frame_->size_px() != size_px;
    if (map == map_ && is_same(orbit, orbit_) && !is_other_size)
        return frame_->texture().name();
    if (is_other_size)
        frame_.emplace(*context_, size_px, PixelFormat::rgba8, true);
    if (map != map_)
        upload(*map);
    map_ = map;
    orbit_ = orbit;
    SceneView scene = object.scene();
    scene.view.image_px = size_px;
    seen_ = seen_from(scene, orbit);
    const TurntablePose pose = seen_.pose_at({{orbit.turn_deg}});
    const DepthRange range = depth_range(seen_.bounds, seen_.view);
    const Ray ahead = to_object(
        {seen_.view.camera.position, glm::normalize(seen_.view.camera.position - seen_.view.camera.target)},
        pose);
    const GladGLContext& gl = context_->gl();
    frame_->bind();
    gl.Enable(GL_DEPTH_TEST);
    gl.Disable(GL_BLEND);
    gl.Disable(GL_SCISSOR_TEST);
    gl.Disable(GL_CULL_FACE);
    gl.ClearColor(0.06f, 0.06f, 0.06f, 1.0f);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    program_.use();
    program_.set("clip_from_object", glm::mat4(seen_.view.clip_from_view(range.near, range.far) *
                                               seen_.view.view_from_world() * pose.world_from_object()));
    program_.set("to_eye", glm::vec3(ahead.direction));
    array_.bind();
    gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * map->surface->triangles.size()), GL_UNSIGNED_INT,
                    nullptr);
    gl.Disable(GL_DEPTH_TEST);
    throw_on_gl_error(*context_, "drawing the map of gaze");
    return frame_->texture().name();
}

std::optional<SaliencyPicture::Place> SaliencyPicture::place_of(const WatchedObject& object,
                                                                const glm::dvec3& position) const {
    if (!map_)
        return std::nullopt;
    const SightLines lines(seen_, {{orbit_.turn_deg}});
    const glm::dvec3 projected = lines.project(position);
    if (projected.z <= 0.0)
        return std::nullopt;
    return Place{glm::dvec2(projected), object.rays().is_hidden(position, lines.origin())};
}

} // namespace overt
