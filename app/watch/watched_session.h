/// A session that is watched: what has come from it, kept as long as it is shown.
#pragma once

#include <chrono>
#include <deque>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/watch/area_tally.h"
#include "app/watch/viewed_pictures.h"
#include "app/watch/watched_object.h"
#include "devices/operator/operator_client.h"
#include "experiment/watch/view_text.h"

namespace overt {

/// A point of gaze and what it met.
struct GazeOnSurface {
    ViewedGaze gaze;
    std::optional<RayHit> hit; ///< nothing beside the object, or while it is being read
};

/// For one thread.
class WatchedSession {
  public:
    /// `client` must outlive this.
    explicit WatchedSession(OperatorClient& client) : client_(client) {}

    /// Takes what has come, waiting so long for it; false once there is nothing more to come.
    bool read(std::chrono::milliseconds wait);

    /// All that is shown; valid until the next read().
    ViewText text();
    /// Events that the last read() brought.
    const std::deque<ViewedEvent>& news() const { return news_; }
    /// The points of the last fifth of a second, while an animation is shown.
    const std::deque<ViewedGaze>& gaze() const { return gaze_; }
    /// Gaze that the last read() brought, oldest first.
    const std::vector<GazeOnSurface>& new_gaze() const { return new_gaze_; }
    /// The newest point of the eye that is shown, while an animation is.
    const std::optional<GazeOnSurface>& last_gaze() const { return last_gaze_; }
    /// Of what the trial under way, or the last, shows: where gaze was last, or the first (an index into
    /// SessionView::shown).
    int looked_at() const { return looked_at_; }
    /// The object that is shown there; null while it is read or has no mesh.
    std::shared_ptr<const WatchedObject> object() const { return object_of(looked_at_); }
    std::shared_ptr<const WatchedObject> object_of(int shown) const;
    /// The id of the slot that it is shown in; empty where the session has one slot.
    std::string slot_of(int shown) const;
    /// Pictures of all that is shown; those that are not lit have no squares.
    std::vector<ViewedPicture> pictures();
    /// The tracker's camera, of the last two seconds.
    const std::optional<ViewedCamera>& camera() const { return camera_; }

  private:
    void read_objects();
    const ViewedStimulus* shown_at(int shown) const;
    std::string surface_text() const;
    std::string areas_text() const;
    std::optional<RayHit> met_by(const ViewedGaze& gaze) const;
    void tally(const GazeOnSurface& gaze);

    OperatorClient& client_;
    std::deque<ViewedEvent> news_, events_;
    std::deque<ViewedGaze> gaze_;
    std::vector<GazeOnSurface> new_gaze_;
    std::optional<GazeOnSurface> last_gaze_;
    std::vector<ViewedPictures> pictures_; ///< by what is shown
    /// An object and the view that it is seen in. Of what was read, null is what could not be.
    using SeenObject = std::pair<std::string, int>;
    std::map<SeenObject, std::shared_ptr<const WatchedObject>> objects_;
    SeenObject being_read_;
    std::future<std::shared_ptr<const WatchedObject>> reading_;
    int looked_at_ = 0;
    ViewedPicture picture_; ///< of what is looked at
    std::optional<ViewedCamera> camera_;
    std::chrono::steady_clock::time_point camera_came_{};
    ViewedPicture camera_picture_;
    std::map<std::string, AreaTally> tallies_; ///< by object and slot
    bool has_right_ = false; ///< of both eyes one is enough: their gaze would be counted twice
};

} // namespace overt
