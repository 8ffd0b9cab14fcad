#include "app/rig/seen_areas.h"

#include "experiment/maps/sight_lines.h"
#include "experiment/scene/areas.h"
#include "experiment/scene/ray_caster.h"

namespace overt {

namespace {

class CastArea final : public AreaView {
  public:
    CastArea(const Mesh& mesh, const SceneView& scene, const ScreenGeometry& screen, const PoseTable& poses,
             std::vector<bool> is_in_area)
        : mesh_(mesh), screen_(screen), caster_(mesh), is_in_area_(std::move(is_in_area)) {
        for (const ObjectPose& angle : poses.angles)
            lines_.emplace_back(scene, angle);
    }

    bool is_at(PoseIndex pose, ScreenPoint place) const noexcept override {
        const glm::dvec2 point = screen_.image_from_screen(place);
        if (!screen_.is_inside_image(point) || pose.value < 0 ||
            static_cast<std::size_t>(pose.value) >= lines_.size())
            return false;
        const SightLines& lines = lines_[static_cast<std::size_t>(pose.value)];
        const std::optional<RayHit> hit =
            caster_.first_hit({lines.origin(), glm::normalize(lines.direction_through(point))});
        return hit && is_in_area_[mesh_.triangle_parts[hit->triangle]];
    }

  private:
    const Mesh& mesh_;
    ScreenGeometry screen_;
    RayCaster caster_;
    std::vector<bool> is_in_area_;  ///< by PartIndex
    std::vector<SightLines> lines_; ///< by PoseIndex
};

} // namespace

SeenAreas::SeenAreas(const Protocol& protocol, std::span<const Object> objects, const PoseTable& poses)
    : protocol_(&protocol), objects_(objects), poses_(&poses) {}

std::shared_ptr<const AreaView> SeenAreas::area_of(const PlacedStimulus& placed, const std::string& area) {
    const Stimulus stimulus = protocol_->in_slot(placed);
    const auto [made, is_new] = made_.try_emplace({stimulus, placed.slot, area});
    if (!is_new)
        return made->second;
    const Object& object = objects_[static_cast<std::size_t>(stimulus.object)];
    std::vector<bool> is_in_area;
    bool has_any = false;
    for (const std::string& part : object.mesh->part_names) {
        is_in_area.push_back(part_is_in_area(part, area));
        has_any = has_any || is_in_area.back();
    }
    if (object.has_mesh() && has_any)
        made->second = std::make_shared<CastArea>(
            object.mesh, object.scene(stimulus.view),
            slot_geometry(*protocol_, protocol_->slots[static_cast<std::size_t>(placed.slot)]), *poses_,
            std::move(is_in_area));
    return made->second;
}

} // namespace overt
