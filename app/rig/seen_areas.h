/// The areas of objects' surfaces that a session waits for gaze on.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "experiment/animation.h"
#include "experiment/ports/area_view.h"
#include "experiment/protocol/protocol.h"
#include "experiment/stimulus/object.h"
#include "experiment/trial.h"

namespace overt {

/// Finds what is seen at a place by casting a ray, which gives what the recorded maps give: maps that are
/// drawn live are not there yet when gaze falls on them.
class SeenAreas {
  public:
    /// All must outlive this, and the views that it gives.
    SeenAreas(const Protocol& protocol, std::span<const Object> objects, const PoseTable& poses);

    /// An area of the stimulus's object, as its camera sees it in its slot; null where the object has no mesh
    /// or no such area. An object's first takes some milliseconds, for its rays are made ready.
    std::shared_ptr<const AreaView> area_of(const PlacedStimulus& placed, const std::string& area);

  private:
    const Protocol* protocol_;
    std::span<const Object> objects_;
    const PoseTable* poses_;
    std::map<std::tuple<Stimulus, int, std::string>, std::shared_ptr<const AreaView>> made_; ///< and by slot
};

} // namespace overt
