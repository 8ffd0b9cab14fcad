/// The operator's view of a session, if it has one.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "devices/operator/gaze_tap.h"
#include "devices/operator/operator_panel.h"
#include "devices/operator/operator_server.h"
#include "devices/operator/watched_log.h"
#include "experiment/base/error.h"
#include "experiment/ports/clock.h"
#include "experiment/ports/eye_tracker.h"
#include "experiment/record/session_header.h"

namespace overt {

struct Protocol;

/// What a session's view is told of what does not change. `folder`: of the session. `header`: its record's.
/// `steady`: the session's clock; null where time is virtual.
OperatorServer::Options operator_view_of(const SessionHeader& header, const Protocol& protocol,
                                         const std::filesystem::path& folder, bool has_tracker, int completed,
                                         const Clock* steady);

/// Stands between a session and its log and panel. Without a socket it is not made.
class OperatorEquipment {
  public:
    /// All references must outlive this. Throws as OperatorServer does.
    OperatorEquipment(OperatorServer::Options options, const Clock& clock, EyeTracker& tracker,
                      SessionLog& record, ResponsePanel& panel)
        : tracker_(tracker), server_(std::move(options)), panel_(server_, clock, panel),
          gaze_(server_, clock),
          log_(record, server_, panel_, clock, tracker.tell_samples_to(&gaze_) ? nullptr : &gaze_) {}
    ~OperatorEquipment() {
        try {
            tracker_.stop_recording(); // a session that failed may have left one under way
        } catch (const Error&) {
        }
        tracker_.tell_samples_to(nullptr);
    }
    OperatorEquipment(const OperatorEquipment&) = delete;
    OperatorEquipment& operator=(const OperatorEquipment&) = delete;

    SessionLog& log() { return log_; }
    ResponsePanel& panel() { return panel_; }
    const std::filesystem::path& socket() const { return server_.socket(); }

    void show_camera(const CameraImage& image) { server_.show_camera(image); }
    void entered(SessionPhase phase, int trial) noexcept { log_.entered(phase, trial); }
    /// `meter`, which may be empty, and the view.
    std::function<void(const AudioLevel&)> meter_besides(std::function<void(const AudioLevel&)> meter) {
        return [this, meter = std::move(meter)](const AudioLevel& level) {
            if (meter)
                meter(level);
            log_.level(level);
        };
    }

  private:
    EyeTracker& tracker_;
    OperatorServer server_;
    OperatorPanel panel_;
    GazeTap gaze_;
    WatchedLog log_;
};

} // namespace overt
