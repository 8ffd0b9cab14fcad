#include "app/rig/seen_points.h"

#include <algorithm>
#include <cmath>

namespace overt {

namespace {

/// A session asks for those of the trial that runs; more are not kept.
constexpr std::size_t most_kept = 64;

class PlacedPoint final : public ProbeView {
  public:
    PlacedPoint(std::vector<SeenProbe> by_pose, std::vector<PoseIndex> pose_of_frame)
        : by_pose_(std::move(by_pose)), pose_of_frame_(std::move(pose_of_frame)) {}

    SeenProbe seen_in(AnimationFrameIndex frame) const noexcept override {
        if (frame.value < 0 || static_cast<std::size_t>(frame.value) >= pose_of_frame_.size())
            return {};
        return by_pose_[static_cast<std::size_t>(
            pose_of_frame_[static_cast<std::size_t>(frame.value)].value)];
    }

  private:
    std::vector<SeenProbe> by_pose_;
    std::vector<PoseIndex> pose_of_frame_;
};

} // namespace

SeenPoints::SeenPoints(const Protocol& protocol, std::span<const Object> objects, const PoseTable& poses)
    : protocol_(&protocol), objects_(objects), poses_(&poses) {}

std::shared_ptr<const ProbeView> SeenPoints::point_of(const PlacedStimulus& placed,
                                                      const std::string& point) {
    const Stimulus stimulus = protocol_->in_slot(placed);
    if (made_.size() > most_kept)
        made_.clear();
    const auto [made, is_new] =
        made_.try_emplace({stimulus.object, stimulus.motion, stimulus.view, placed.slot, point});
    if (!is_new)
        return made->second;
    const Object& object = objects_[static_cast<std::size_t>(stimulus.object)];
    const auto found = std::ranges::find(object.points, point, &ObjectPoint::name);
    if (!object.has_mesh() || found == object.points.end())
        return nullptr;
    std::unique_ptr<RayCaster>& caster = casters_[stimulus.object];
    if (!caster)
        caster = std::make_unique<RayCaster>(object.mesh);
    const SceneView& scene = object.scene(stimulus.view);
    const Eye other = protocol_->tracker.analysed_eye() == Eye::left ? Eye::right : Eye::left;
    const SceneView& others = object.scene(protocol_->in_slot(placed, other).view);
    const std::span<const PoseIndex> frames = poses_->frames_of(stimulus.motion);
    std::vector<SeenProbe> by_pose(poses_->angles.size());
    std::vector<bool> is_known(by_pose.size());
    for (const PoseIndex pose : frames) {
        const auto index = static_cast<std::size_t>(pose.value);
        if (is_known[index])
            continue;
        is_known[index] = true;
        by_pose[index] = seen_point(object.mesh, *caster, scene, poses_->object_of(pose), *found);
        // A mark before one eye alone would be seen in no depth.
        if (protocol_->stereo.is_on())
            by_pose[index].is_visible =
                by_pose[index].is_visible &&
                seen_point(object.mesh, *caster, others, poses_->object_of(pose), *found).is_visible;
    }
    auto view = std::make_shared<PlacedPoint>(std::move(by_pose),
                                              std::vector<PoseIndex>(frames.begin(), frames.end()));
    const ScreenGeometry screen =
        slot_geometry(*protocol_, protocol_->slots[static_cast<std::size_t>(placed.slot)]);
    const Camera& camera = scene.view.camera;
    view->middle = screen.screen_from_image(scene.view.straight_ahead_px());
    view->px_at_unit_depth = scene.view.px_at_unit_depth();
    view->aside = camera.aside;
    view->target_depth = glm::distance(camera.position, camera.target);
    made->second = view;
    return view;
}

} // namespace overt
