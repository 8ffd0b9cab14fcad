#include "app/watch/watched_object.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/path_inside.h"
#include "experiment/maps/sight_lines.h"
#include "experiment/record/read/session_record.h"
#include "experiment/scene/files/mesh_reader.h"

namespace overt {

namespace {

struct Recorded {
    RecordedObject object;
    ScreenGeometry screen;
    std::vector<ObjectPose> angles;
    Mesh mesh;
};

Recorded read_object(const std::filesystem::path& session, const std::string& id, std::size_t view) {
    const SessionRecord record(session);
    const SessionHeader& header = record.header();
    const auto found = std::ranges::find(header.objects, id, &RecordedObject::id);
    if (found == header.objects.end() || found->mesh_file.empty() || view >= found->cameras.size() ||
        found->cameras[view].vertical_fov.value <= 0.0)
        throw InputError(fmt::format("{}: has no mesh in {}", id, session.string()));
    MeshCleaningReport unused;
    return {*found, header.screen_of_view(static_cast<int>(view)), header.poses.angles,
            import_mesh(require_file_inside(session, found->mesh_file), {}, unused)};
}

} // namespace

WatchedObject::WatchedObject(const std::filesystem::path& session, const std::string& id, int view)
    : id_(id), view_(view), rays_([&] {
          Recorded recorded = read_object(session, id, static_cast<std::size_t>(view));
          unit_ = recorded.object.unit;
          mesh_ = std::move(recorded.mesh);
          screen_ = recorded.screen;
          scene_ = {{recorded.object.camera(view), screen_.image_px}, mesh_.bounds()};
          angles_ = std::move(recorded.angles);
          return RayCaster(mesh_);
      }()) {}

std::optional<RayHit> WatchedObject::met_at(ScreenPoint place, int pose, glm::ivec2 image_origin_px) const {
    ScreenGeometry screen = screen_;
    screen.image_origin_px = image_origin_px;
    const glm::dvec2 point = screen.image_from_screen(place);
    if (pose < 0 || static_cast<std::size_t>(pose) >= angles_.size() || !screen.is_inside_image(point))
        return std::nullopt;
    return rays_.first_hit(
        to_object(scene_.view.ray_through(point), scene_.pose_at(angles_[static_cast<std::size_t>(pose)])));
}

const std::string& WatchedObject::part_of(const RayHit& hit) const {
    return mesh_.part_names[mesh_.triangle_parts[hit.triangle]];
}

double WatchedObject::degree_on_surface() const {
    const double depth = scene_.view.depth_of(scene_.bounds.centre());
    return screen_.px_per_deg_at_centre() * SightLines(scene_, {{0.0}}).pixel_width_at(depth);
}

} // namespace overt
