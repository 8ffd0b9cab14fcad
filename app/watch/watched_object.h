/// An object of a session that is watched: what gaze on its picture meets.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiment/scene/mesh.h"
#include "experiment/scene/ray_caster.h"
#include "experiment/scene/viewing.h"
#include "experiment/screen_geometry.h"

namespace overt {

/// May be read from any thread once it is made.
class WatchedObject {
  public:
    /// As it is seen in a view, by its index. From the session's folder, also while the session runs. Throws
    /// InputError for an object without a mesh or of an unknown camera, and RecordError for what cannot be
    /// read.
    WatchedObject(const std::filesystem::path& session, const std::string& id, int view = 0);

    const std::string& id() const { return id_; }
    int view() const { return view_; }
    const Mesh& mesh() const { return mesh_; }
    const SceneView& scene() const { return scene_; }
    const RayCaster& rays() const { return rays_; }
    /// "mm" or "own".
    const std::string& unit() const { return unit_; }

    /// What the line of sight through a place of the screen meets in a pose: the same surface point as the
    /// session's coordinate maps give. Nothing beside the object.
    std::optional<RayHit> met_at(ScreenPoint place, int pose) const {
        return met_at(place, pose, screen_.image_origin_px);
    }
    /// The same in a slot whose image begins there.
    std::optional<RayHit> met_at(ScreenPoint place, int pose, glm::ivec2 image_origin_px) const;

    /// Of the object where it was met.
    const std::string& part_of(const RayHit& hit) const;

    /// What a degree of visual angle is on a surface at the turntable's axis, in the mesh's unit.
    double degree_on_surface() const;

  private:
    std::string id_, unit_;
    int view_ = 0;
    Mesh mesh_;
    ScreenGeometry screen_;
    SceneView scene_;
    std::vector<ObjectPose> angles_; ///< by pose
    RayCaster rays_;
};

} // namespace overt
