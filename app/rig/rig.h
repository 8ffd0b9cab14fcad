/// The rig of a session: clock, display, tracker and response panel, built from the protocol and the options,
/// and handed to the session as the ports it declared.
#pragma once

#include <deque>
#include <functional>
#include <memory>

#include "app/rig/answer_equipment.h"
#include "app/rig/open_display.h"
#include "app/rig/seen_areas.h"
#include "app/rig/seen_points.h"
#include "app/rig/undrawn_frames.h"
#include "experiment/ports/eye_tracker.h"
#include "experiment/ports/presentation_listener.h"
#include "experiment/ports/response_panel.h"
#include "experiment/protocol/files/fault_file.h"
#include "experiment/record/session_header.h"
#include "render/presenter/stereo_presenter.h"
#include "render/stimulus/live_maps.h"
#include "render/stimulus/stimulus_library.h"
#include "render/window/quiet_desktop.h"
#include "render/window/screen_check.h"
#include "render/window/screen_watch.h"
#include "render/window/window_context.h"

namespace overt {

struct BoxIdentity;
class FaultyTracker;
class SimulatedAnswers;
class SimulatedObserver;
struct ScriptedOperatorKey;

/// When the hidden maps are drawn: before the session, or while their frames are shown.
enum class MapTime : std::uint8_t { automatic, prepared, live };
template <> inline constexpr auto names_of<MapTime> = enum_names<MapTime>("auto", "prepared", "live");

struct RigRequest {
    ContextChoice context;
    bool virtual_time = false;
    bool windowed = false;
    bool simulate_observer = false; ///< else the observer answers at the window's keyboard
    std::uint64_t seed = 0;         ///< of everything simulated
    MapTime maps = MapTime::automatic;
    std::string monitor = {};                    ///< see WindowRequest
    std::vector<std::string> operator_keys = {}; ///< of a simulated operator, see read_operator_key()
    bool draws_stimuli = true;      ///< without: see UndrawnFrames; for a display that only keeps time
    std::string observer = "overt"; ///< whom files on a tracker's host are for
};

/// A fault that was simulated, as the record has it.
struct StruckFault {
    bool is_trackers = false; ///< else the display's
    std::string what;
};

class Rig {
  public:
    /// `protocol` and `objects` must outlive the rig. Opens the display. Throws GraphicsError, also for a
    /// screen that would not show what the protocol says, or InputError for a request that this machine
    /// cannot meet.
    Rig(const Protocol& protocol, std::span<const Object> objects, const RigRequest& request,
        const std::filesystem::path& cache);
    ~Rig();

    const GlContext& context() const { return display_.context(); }
    StimulusLibrary& library() { return library_; }
    Clock& clock() { return display_.clock(); }
    ClockKind clock_kind() const {
        return request_.virtual_time ? ClockKind::virtual_time : ClockKind::steady;
    }

    /// Answers what the window system asks meanwhile, so that it does not take a program that prepares for
    /// one that hangs. Does nothing without a window. Main thread.
    void pump_events() {
        if (WindowContext* const window = display_.window())
            window->poll_events();
    }

    /// Stimuli are shown on a real screen in real time.
    bool is_on_a_real_screen() const { return display_.is_real(); }

    /// Which one it is; nothing unless is_on_a_real_screen().
    std::optional<MonitorInfo> monitor() const;

    /// What may change the signal on its way to the screen; nothing unless is_on_a_real_screen().
    const std::vector<ScreenFinding>& screen_findings() const { return screen_findings_; }

    /// What the record says of the flips' times, see RecordedDisplay::timing.
    std::string timing_word() const;

    /// Whether the hidden maps are drawn while their frames are shown; else they are to be prepared.
    bool maps_are_live() const;

    /// Makes presenter, tracker and panel. To be called once, when all stimuli are prepared: the session
    /// clock starts here, with `start`. `faults`: what goes wrong with a display that only keeps time, and
    /// with a tracker that is no hardware. Throws InputError for faults of a real screen in real time.
    void open(SimulatedFaults faults = {}, SessionTime start = {});

    /// Shows a dark screen for so many seconds, watches its refreshes, and adds what it finds to
    /// screen_findings(); gives what was added. Only on a real screen, once open. Throws GraphicsError for a
    /// refresh that is not the protocol's, and InputError for times that nothing proves where the protocol
    /// says that they are proven.
    std::vector<ScreenFinding> check_timing(double seconds,
                                            const std::function<void(int done, int total)>& progress);

    /// Adds to screen_findings() what proves that a box receives the bytes that are drawn; gives it. Only on
    /// a real screen. Throws InputError if nothing does, see require_video_check().
    const ScreenFinding& check_video(const BoxIdentity& box);

    Presenter& presenter() { return stereo_ ? static_cast<Presenter&>(*stereo_) : *presenter_; }
    /// What draws the pictures: one, or those of the left and the right eye.
    std::vector<PagePresenter*> page_presenters();
    /// The one of them that shows what is drawn, and in which the screen's messages begin.
    PagePresenter& leading_presenter() { return stereo_ ? stereo_->leading() : *presenter_; }
    EyeTracker& tracker() { return *tracker_; }
    /// One that records at the same time.
    struct Further {
        std::string id;
        Protocol protocol; ///< whose [tracker] it is
        std::unique_ptr<EyeTracker> tracker;
    };
    std::deque<Further>& further_trackers() { return further_trackers_; }
    ResponsePanel& panel() { return *panels_.back(); }
    /// What spoken answers are recorded with: to be made once, after open(). Throws as its constructor.
    AnswerEquipment answer_equipment() const;
    /// What the operator should know once the session has ended, a line each.
    std::vector<std::string> closing_warnings() const;
    /// The simulated observer, the hidden pass if it is live, and a display that only keeps time.
    std::vector<PresentationListener*> listeners();
    /// The simulated faults that struck since the last call: after each attempt.
    std::vector<StruckFault> take_struck_faults();
    /// Of the object that a stimulus shows; see SeenAreas.
    std::shared_ptr<const AreaView> area_of(const PlacedStimulus& stimulus, const std::string& area) {
        return areas_.area_of(stimulus, area);
    }
    /// A place of it; see SeenPoints.
    std::shared_ptr<const ProbeView> point_of(const PlacedStimulus& stimulus, const std::string& point) {
        return points_.point_of(stimulus, point);
    }
    /// What of the screen is not as it was at the last call, a sentence each; see ScreenWatch. Nothing unless
    /// is_on_a_real_screen().
    std::vector<std::string> screen_changes() {
        return screen_watch_ ? screen_watch_->take_changes() : std::vector<std::string>();
    }
    LiveMaps* live_maps() { return live_maps_.get(); } ///< null unless maps_are_live()

  private:
    void open_further_trackers();

    const Protocol* protocol_;
    std::span<const Object> objects_;
    RigRequest request_;
    std::vector<ScriptedOperatorKey> operator_keys_;
    OpenDisplay display_; // objects of OpenGL go before the context they live in
    std::vector<ScreenFinding> screen_findings_;
    std::optional<QuietDesktop> quiet_desktop_; ///< on a real screen
    std::optional<ScreenWatch> screen_watch_;   ///< the same, once open
    StimulusLibrary library_;
    SeenAreas areas_;
    SeenPoints points_;
    std::unique_ptr<UndrawnFrames> undrawn_;   ///< in its place, if stimuli are not drawn
    std::unique_ptr<PagePresenter> presenter_; ///< or
    std::unique_ptr<StereoPresenter> stereo_;
    std::unique_ptr<LiveMaps> live_maps_;
    std::unique_ptr<SimulatedObserver> observer_;
    std::unique_ptr<SimulatedAnswers> simulated_answers_;
    std::unique_ptr<EyeTracker> tracker_;
    FaultyTracker* faulty_tracker_ = nullptr;            ///< a part of it
    std::deque<Further> further_trackers_;               ///< trackers refer to their protocols
    std::vector<std::unique_ptr<ResponsePanel>> panels_; ///< the session asks the last
};

} // namespace overt
