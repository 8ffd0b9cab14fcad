#include "app/session/sitting_run.h"

#include <fmt/format.h>

#include "app/rig/operator_equipment.h"
#include "app/session/presentation_check.h"
#include "app/session/session_messages.h"
#include "devices/host/thread_priority.h"

namespace overt {

namespace {

/// A socket for the operator's view, if it is wanted; said on the terminal and not in the record, which is
/// the same with and without.
void open_view(std::optional<OperatorEquipment>& view, const Protocol& protocol, const RunOptions& options,
               const SessionPlan& plan, SessionEquipment& equipment, SittingRecord& record) {
    if (!options.operator_socket)
        return;
    Rig& rig = equipment.rig();
    OperatorServer::Options wished =
        operator_view_of(record.header(), protocol, record.folder(), rig.tracker().measures_gaze(),
                         plan.resumed ? plan.resumed->history.counted_trials : 0,
                         options.virtual_time ? nullptr : &rig.clock());
    wished.socket =
        options.operator_socket->empty() ? record.folder() / operator_socket_name : *options.operator_socket;
    wished.tell = [](const std::string& sentence) { fmt::print(stderr, "{}\n", sentence); };
    view.emplace(std::move(wished), rig.clock(), rig.tracker(), record.own(), equipment.keys());
    fmt::print("operator's view: overt watch --operator-socket {}\n", view->socket().string());
}

/// Stands between the equipment and the session, and tells the view and the terminal what happens.
class WatchedSitting {
  public:
    WatchedSitting(const Protocol& protocol, const RunOptions& options, const SessionPlan& plan,
                   SessionEquipment& equipment, SittingRecord& record)
        : equipment_(equipment), record_(record),
          has_proven_times_(options.virtual_time || record.header().display.timing == "proven"),
          progress_(protocol, plan.schedule, equipment.rig().tracker().measures_gaze(), !has_proven_times_) {
        open_view(view_, protocol, options, plan, equipment, record);
    }

    SessionPorts ports(const RunOptions& options, const std::string& observer) {
        Rig& rig = equipment_.rig();
        AnswerEquipment& answers = equipment_.answers();
        return {
            .clock = rig.clock(),
            .presenter = rig.presenter(),
            .tracker = rig.tracker(),
            .panel = view_ ? view_->panel() : equipment_.keys(),
            .log = view_ ? view_->log() : record_.own(),
            .listeners = rig.listeners(),
            .observer = observer,
            .can_type = !options.simulate_observer && options.ask_at == AskAt::window,
            .recorder = answers.recorder(),
            .on_level = view_ ? view_->meter_besides(answers.meter()) : answers.meter(),
            .markers = equipment_.markers().sinks(),
            .further_trackers = record_.further_ports(),
            .on_beep = [this](Beep beep) { equipment_.sounds().play(beep); },
            .on_camera = [this](const CameraImage& image) { show(image); },
            .area_of = [this](const PlacedStimulus& stimulus,
                              const std::string& area) { return equipment_.rig().area_of(stimulus, area); },
            .probe_of =
                [this](const PlacedStimulus& stimulus, const std::string& point) {
                    return equipment_.rig().point_of(stimulus, point);
                },
            .on_phase = [this](SessionPhase phase, int trial) { enter(phase, trial); },
            .screen_changes = [this] { return equipment_.rig().screen_changes(); },
            .has_proven_times = has_proven_times_};
    }

    void attempt_ended(const Trial& trial, const TrialOutcome& outcome, int done) {
        progress_(trial, outcome, done);
    }
    void end() {
        view_.reset();
        progress_.finish();
    }

  private:
    void show(const CameraImage& image) {
        if (view_)
            view_->show_camera(image);
    }
    void enter(SessionPhase phase, int trial) {
        progress_.enter(phase, trial);
        if (view_)
            view_->entered(phase, trial);
        if (phase == SessionPhase::task_screen || phase == SessionPhase::stimulus)
            if (const auto regained = regain_realtime_priority())
                note_thread({*regained}, equipment_.rig().clock(), record_.shared());
    }

    SessionEquipment& equipment_;
    SittingRecord& record_;
    bool has_proven_times_; ///< or made-up ones
    TrialProgress progress_;
    std::optional<OperatorEquipment> view_;
};

} // namespace

SessionResult run_sitting(const Protocol& protocol, const RunOptions& options, const SessionPlan& plan,
                          SessionEquipment& equipment, SittingRecord& record, const PresentingAgain* again) {
    Rig& rig = equipment.rig();
    WatchedSitting watched(protocol, options, plan, equipment, record);
    Session session(protocol, plan.schedule, screen_geometry_of(protocol).centre(),
                    watched.ports(options, plan.schedule.observer.label), plan.fields);
    note_faults(options.faults, rig.clock(), record.shared());
    note_thread(prepare_thread({options.realtime, options.processor}), rig.clock(), record.shared());
    if (options.refresh_check_s > 0.0)
        check_presentation(rig, protocol, plan.schedule, record.header(), record.folder(), record.own());
    const auto attempt_ended = [&](const Trial& trial, const TrialOutcome& outcome, int done) {
        watched.attempt_ended(trial, outcome, done);
        record.attempt_ended(trial);
        if (again && again->trial_done)
            again->trial_done();
    };
    try {
        SessionResult result =
            session.run(attempt_ended, plan.resumed ? plan.resumed->history : SessionHistory());
        watched.end();
        return result;
    } catch (const Error&) {
        record.rescue_tracker_files();
        // Such as frames that have gone from the cache: what is said of them does not name the session.
        if (!again)
            fmt::print(
                stderr,
                "session: {}: it ends here. What was recorded is kept; once what is said below is put right, "
                "overt run … --resume goes on with it.\n",
                record.folder().string());
        throw;
    } catch (...) {
        record.rescue_tracker_files();
        throw;
    }
}

} // namespace overt
