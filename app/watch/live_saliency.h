/// Where gaze has been on an object, as a map that grows while a session is watched.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/watch/area_tally.h"
#include "app/watch/watched_object.h"

namespace overt {

/// A surface to be drawn, with at most 8,000 nodes, and the density of gaze on it.
struct SaliencyMap {
    std::string object, slot;
    std::shared_ptr<const Mesh> surface;   ///< in the object's unit; the same object while it is the same
    std::vector<float> share;              ///< by vertex: of the highest density, 0 … 1; all 0 without gaze
    double gaze_s = 0.0;                   ///< that is in it
    std::vector<AreaTally::Share> areas{}; ///< of that time
};

/// Sums up gaze on a thread of its own, where surfaces are prepared as well. The kernel is the analysis'
/// default, one degree along the surface. The map is a picture for the operator: points come every 4 ms, go
/// to the nearest node, and meet the frame that was known to be lit when they came. What is published comes
/// from `overt analyze`.
class LiveSaliency {
  public:
    enum class Of : std::uint8_t { session, trial };

    LiveSaliency();
    ~LiveSaliency();
    LiveSaliency(const LiveSaliency&) = delete;
    LiveSaliency& operator=(const LiveSaliency&) = delete;

    /// Gaze rested on this place for a while, in this slot, of which each has a map of its own. Never waits
    /// for a map to be made.
    void looked(const std::shared_ptr<const WatchedObject>& object, const std::string& slot, int trial,
                const RayHit& hit, double seconds);
    /// Which gaze the map shows: all that this view has seen of the object, or that of the last trial.
    void show(Of what);
    /// Has the surface prepared, so that it can be shown before anybody looked at it.
    void prepare(const std::shared_ptr<const WatchedObject>& object, const std::string& slot = {});

    /// The newest map of an object in a slot; null while there is none.
    std::shared_ptr<const SaliencyMap> newest(const std::string& object, const std::string& slot = {}) const;

  private:
    struct Look {
        std::shared_ptr<const WatchedObject> object;
        std::string slot;
        int trial = -1;
        std::uint32_t vertex = 0; ///< of the object's mesh
        PartIndex part = 0;
        double seconds = 0.0; ///< 0: the surface is to be prepared
    };
    struct Surface;
    void work(const std::stop_token& stop);
    Surface& surface_of(const WatchedObject& object);

    mutable std::mutex lock_;
    std::condition_variable_any wakes_;
    std::vector<Look> looks_;
    Of of_ = Of::session;
    bool is_other_ = false; ///< `of_` changed
    std::map<std::pair<std::string, std::string>, std::shared_ptr<const SaliencyMap>>
        newest_; ///< by object and slot
    // Of the thread.
    std::map<std::string, std::unique_ptr<Surface>> surfaces_;
    std::jthread thread_;
};

} // namespace overt
