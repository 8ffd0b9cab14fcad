/// The places on objects' surfaces at which a session's probes stand.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <tuple>

#include "experiment/animation.h"
#include "experiment/ports/probe_view.h"
#include "experiment/protocol/protocol.h"
#include "experiment/stimulus/object.h"
#include "experiment/trial.h"

namespace overt {

/// Knows of each frame where a place is seen, and whether another surface hides it, by a ray to it: what the
/// recorded maps show.
class SeenPoints {
  public:
    /// All must outlive this, and the views that it gives.
    SeenPoints(const Protocol& protocol, std::span<const Object> objects, const PoseTable& poses);

    /// A place of the stimulus's object, as its camera sees it in its slot, visible where both eyes see it;
    /// null where the object has none of this name. Each place's first takes a ray for each pose, and an
    /// object's first some milliseconds.
    std::shared_ptr<const ProbeView> point_of(const PlacedStimulus& placed, const std::string& point);

  private:
    const Protocol* protocol_;
    std::span<const Object> objects_;
    const PoseTable* poses_;
    std::map<int, std::unique_ptr<RayCaster>> casters_; ///< by object
    /// By object, motion, view, slot and place; those of a trial or two.
    std::map<std::tuple<int, int, int, int, std::string>, std::shared_ptr<const ProbeView>> made_;
};

} // namespace overt
