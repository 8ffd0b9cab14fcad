#include <fmt/format.h>

#include "app/cli/interruption.h"
#include "app/cli/own_folders.h"
#include "app/cli/terminal_output.h"
#include "app/cli/this_program.h"
#include "app/inputs/prepared_stimuli.h"
#include "app/inputs/protocol_file.h"
#include "app/inputs/protocol_inputs.h"
#include "app/rig/answer_equipment.h"
#include "app/rig/marker_outputs.h"
#include "app/rig/operator_equipment.h"
#include "app/rig/rig.h"
#include "app/rig/setup_sounds.h"
#include "app/session/further_records.h"
#include "app/session/presentation_check.h"
#include "app/session/recorded_options.h"
#include "app/session/session_boxes.h"
#include "app/session/session_circumstances.h"
#include "app/session/session_commands.h"
#include "app/session/session_messages.h"
#include "app/session/session_plan.h"
#include "app/session/session_recording.h"
#include "app/session/session_room.h"
#include "devices/host/thread_priority.h"
#include "experiment/base/error.h"
#include "experiment/design/schedule.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/record/read/timing_report.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/write/session_store.h"
#include "experiment/session/session.h"

namespace overt {

namespace {

/// The session's folder with all that is recorded before the first trial; a resumed session has it already.
struct SessionFolder {
    std::filesystem::path path;
    SessionHeader header;
    std::string started_utc; ///< of this sitting
};

SessionFolder open_folder(const RunOptions& options, const SessionPlace& place, const Experiment& experiment,
                          const SessionPlan& plan, Rig& rig) {
    SessionHeader now = make_session_header(
        experiment.protocol, plan.schedule, experiment.objects, rig.library(), rig.context().description(),
        rig.tracker().description(), rig.clock_kind(), !rig.maps_are_live());
    now.display.timing = rig.timing_word();
    if (plan.resumed) {
        require_same_stimuli(*plan.resumed, now);
        std::vector<std::string> further;
        for (const Rig::Further& tracker : rig.further_trackers())
            further.push_back(tracker.id);
        require_same_trackers(plan.resumed->folder, std::move(further));
        reopen_manifest(plan.resumed->folder, plan.resumed->header, this_program());
        return {plan.resumed->folder, plan.resumed->header, now.started_utc};
    }
    SessionDirectory directory(place, options.session_number);
    now.session_number = directory.session_number();
    put_files(directory, now, experiment.objects, rig.library(), options.draws_stimuli);
    for (const Rig::Further& further : rig.further_trackers())
        put_further_record(directory.path(), header_of_further(now, further));
    directory.publish();
    const std::string started_utc = now.started_utc;
    return {directory.path(), std::move(now), started_utc};
}

/// Where the tracker's own events are wanted and it tells none, the program's stand in for them.
std::optional<SittingDetection> detection_of(const Protocol& protocol, const EyeTracker& tracker) {
    if (protocol.events.method == EventMethod::none || !tracker.measures_gaze() ||
        (protocol.events.method == EventMethod::tracker && tracker.tells_events()))
        return std::nullopt;
    return SittingDetection{protocol.events, screen_geometry_of(protocol)};
}

SessionStore::Options store_options(const RunOptions& options, const SessionFolder& folder,
                                    const PresentingAgain* again, const Protocol& protocol,
                                    const EyeTracker& tracker, const std::optional<Resumption>& resumption) {
    return {.wait_when_full = options.virtual_time,
            .ring_capacity = 65536,
            .started_utc = folder.started_utc,
            .program_version = this_program().version,
            .program_sha256 = this_program().sha256,
            .resumption = resumption,
            .detection = detection_of(protocol, tracker),
            .options = again ? again->options : recorded_options(options, folder.path)};
}

/// A socket for the operator's view, if it is wanted; said on the terminal and not in the record, which is
/// the same with and without.
void open_view(std::optional<OperatorEquipment>& view, const RunOptions& options, const SessionPlan& plan,
               const SessionFolder& folder, const Protocol& protocol, Rig& rig, SessionStore& store,
               ResponsePanel& keys) {
    if (!options.operator_socket)
        return;
    OperatorServer::Options wished =
        operator_view_of(folder.header, protocol, folder.path, rig.tracker().measures_gaze(),
                         plan.resumed ? plan.resumed->history.counted_trials : 0,
                         options.virtual_time ? nullptr : &rig.clock());
    wished.socket =
        options.operator_socket->empty() ? folder.path / operator_socket_name : *options.operator_socket;
    wished.tell = [](const std::string& sentence) { fmt::print(stderr, "{}\n", sentence); };
    view.emplace(std::move(wished), rig.clock(), rig.tracker(), store, keys);
    fmt::print("operator's view: overt watch --operator-socket {}\n", view->socket().string());
}

/// `again`: null for a session that is recorded for the first time.
int run_session_of(Experiment experiment, const RunOptions& options, const PresentingAgain* again) {
    const Observer observer = observer_labelled(options.observer);
    const std::filesystem::path cache = again ? again->cache : cache_folder();
    if (!options.tracker.empty())
        experiment.protocol.tracker.kind = tracker_kind_called(options.tracker);
    if (!options.tracker_address.empty())
        experiment.protocol.tracker.address = options.tracker_address;
    if (!options.tracker.empty() && !experiment.protocol.further_trackers.empty()) {
        fmt::print("further eye trackers are left out, for --tracker says which one there is\n");
        experiment.protocol.further_trackers.clear();
    }
    const Protocol& protocol = experiment.protocol;
    // What would refuse the session at its end is said before anything is drawn.
    const SessionPlace place{options.sessions, protocol.name, observer.label, options.is_another_person};
    if (options.resume && finish_manifest(options, place))
        return 0;
    const SessionPlan plan = plan_session(options, place, protocol, observer);
    const FoundBox found_box = find_box(protocol.display, options);

    Rig rig(protocol, experiment.objects,
            {options.context, options.virtual_time, options.windowed, options.simulate_observer.has_value(),
             seed_of_simulated(options, plan), options.maps, options.monitor, options.operator_keys,
             options.draws_stimuli, observer.label},
            cache);
    if (rig.is_on_a_real_screen() && options.refresh_check_s <= 0.0 &&
        protocol.display.timing == TimingClaim::proven)
        throw InputError(
            "--refresh-check 0 measures nothing, and so proves no times, as the protocol's [display] "
            "timing = \"proven\" asks: leave the option out, or write timing = \"unproven\" "
            "under [display]; the record then says so");
    if (found_box.identity)
        rig.check_video(*found_box.identity);
    say_before(protocol, plan.schedule, rig.context().description(), options);
    say_risks(rig.screen_findings());
    const Interruption interruption;
    const MapsNow maps = rig.maps_are_live() ? MapsNow::drawn_live : MapsNow::made;
    const auto meanwhile = [&] { rig.pump_events(); };
    if (options.draws_stimuli)
        prepare_stimuli(rig.library(), maps,
                        options.quality.value_or(protocol.bake.least(!options.simulate_observer)), meanwhile);
    else
        prepare_maps_alone(rig.library(), maps, protocol, meanwhile);
    say_frames(rig.library(), !options.simulate_observer);
    require_room(experiment, plan, rig.library(), !rig.maps_are_live(), options.sessions);
    rig.open(plan.faults, plan.resumed ? plan.resumed->clock_start : SessionTime());
    if (rig.is_on_a_real_screen() && options.refresh_check_s > 0.0)
        check_timing(rig, options.refresh_check_s);
    rig.presenter().close_on(Interruption::requested());
    BoxInUse box(found_box, protocol.display, rig);
    const auto tell = [](const std::string& sentence) { fmt::print(stderr, "{}\n", sentence); };
    const std::unique_ptr<ResponsePanel> boxes = open_button_boxes(protocol, rig, box, options, tell);
    const MarkerEquipment markers(protocol, rig.clock(), options.virtual_time,
                                  fmt::format("{} {}", protocol.name, observer.label), tell);
    for (const std::string& description : markers.descriptions())
        fmt::print("markers: {}\n", description);
    const bool beeps = protocol.calibration.beeps && rig.tracker().measures_gaze() && !options.virtual_time;
    SetupSounds sounds(beeps);
    if (beeps)
        fmt::print("sounds of the set-up: {}\n", sounds.description());
    AnswerEquipment answers = rig.answer_equipment();
    fmt::print("spoken answers: {}\n", answers.description());

    const SessionFolder folder = open_folder(options, place, experiment, plan, rig);
    const auto sitting_of = [&](const Protocol& with, const EyeTracker& tracker,
                                const std::optional<Resumption>& resumption) {
        return store_options(options, folder, again, with, tracker, resumption);
    };
    SessionStore store(folder.path / session_file_name,
                       sitting_of(protocol, rig.tracker(),
                                  plan.resumed ? std::optional(plan.resumed->resumption) : std::nullopt));
    FurtherRecords further(rig, folder.path, plan.resumed ? &*plan.resumed : nullptr, sitting_of);
    SharedLog records(store);
    further.join(records);
    const RecordedTracker own_tracker{{}, protocol.tracker, rig.tracker(), folder.path, store};
    box.write_beginning(store);
    if (!plan.earlier_sessions.empty() && !again)
        records.event({rig.clock().now(), -1, earlier_sessions_event, plan.earlier_sessions});
    note_circumstances(options, protocol, plan.schedule, rig, records);
    note_tracker(own_tracker, rig.clock());
    for (const std::string& description : markers.descriptions())
        store.event({rig.clock().now(), -1, marker_output_event, description});
    answers.keep_in(folder.path);
    store.event({rig.clock().now(), -1, answer_recording_event, answers.description()});
    ResponsePanel& keys = boxes ? *boxes : rig.panel();
    std::optional<OperatorEquipment> view;
    open_view(view, options, plan, folder, protocol, rig, store, keys);
    TrialProgress progress(protocol, plan.schedule, rig.tracker().measures_gaze(),
                           folder.header.display.is_timing_unproven());
    Session session(protocol, plan.schedule, screen_geometry_of(protocol).centre(),
                    {.clock = rig.clock(),
                     .presenter = rig.presenter(),
                     .tracker = rig.tracker(),
                     .panel = view ? view->panel() : keys,
                     .log = view ? view->log() : store,
                     .listeners = rig.listeners(),
                     .observer = observer.label,
                     .can_type = !options.simulate_observer && options.ask_at == AskAt::window,
                     .recorder = answers.recorder(),
                     .on_level = view ? view->meter_besides(answers.meter()) : answers.meter(),
                     .markers = markers.sinks(),
                     .further_trackers = further.ports(),
                     .on_beep = [&](SetupBeep beep) { sounds.play(beep); },
                     .on_camera =
                         [&](const CameraImage& image) {
                             if (view)
                                 view->show_camera(image);
                         },
                     .on_phase =
                         [&](SessionPhase phase, int trial) {
                             progress.enter(phase, trial);
                             if (view)
                                 view->entered(phase, trial);
                             if (phase == SessionPhase::task_screen || phase == SessionPhase::stimulus)
                                 if (const auto regained = regain_realtime_priority())
                                     note_thread({*regained}, rig.clock(), records);
                         }},
                    plan.fields);
    note_faults(options.faults, rig.clock(), records);
    note_thread(prepare_thread({options.realtime, options.processor}), rig.clock(), records);
    if (options.refresh_check_s > 0.0)
        check_presentation(rig, protocol, plan.schedule, folder.header, folder.path, store);
    SessionResult result;
    try {
        result = session.run(
            [&](const Trial& trial, const TrialOutcome& outcome, int done) {
                if (LiveMaps* live = rig.live_maps())
                    at_normal_priority([&] {
                        for (const RecordedMap& map :
                             record_live_maps(live->take_finished(), folder.path, folder.header)) {
                            store.map_made(map);
                            further.add_map(map);
                        }
                    });
                progress(trial, outcome, done);
                if (const VirtualRefresh* display = rig.virtual_refresh())
                    note_struck(*display, trial, rig.clock(), records);
                if (FaultyTracker* tracker = rig.faulty_tracker())
                    note_struck(*tracker, trial, rig.clock(), store);
                box.check(store);
                if (again && again->trial_done)
                    again->trial_done();
            },
            plan.resumed ? plan.resumed->history : SessionHistory());
    } catch (...) {
        rescue_tracker_file(own_tracker);
        further.rescue_files();
        throw;
    }
    view.reset();
    progress.finish();
    end_tracker(own_tracker, rig.clock());
    box.leave(store);
    // Before the session's own: what is marked as complete has all its parts.
    const bool are_finished = further.end();
    store.close();
    if (!close_manifest(folder.path) || !are_finished)
        fmt::print(stderr,
                   "the session is recorded, but its manifest is not finished, for another program has "
                   "session.sqlite open, or the disk is full: afterwards overt run … --resume finishes it\n");
    for (const std::string& warning : result.marker_warnings)
        fmt::print(stderr, "{}\n", warning);
    for (const std::string& warning : rig.closing_warnings())
        fmt::print(stderr, "{}\n", warning);
    if (boxes)
        for (const std::string& warning : boxes->closing_warnings())
            fmt::print(stderr, "{}\n", warning);
    LostRows lost = store.lost();
    lost += further.lost();
    say_after(options, result, lost, plan.schedule, folder.path, folder.header.display.is_timing_unproven());
    return result.aborted ? 1 : 0;
}

} // namespace

int run_session(const RunOptions& options) {
    output_is_only_told();
    observer_labelled(options.observer); // before anything is read
    if (options.verify_output && !options.draws_stimuli)
        throw InputError(
            "--verify-output decodes the pictures that --no-pictures leaves out: give one of them");
    if (options.operator_socket && !options.operator_socket->empty())
        check_socket_place(*options.operator_socket);
    return run_session_of(read_experiment_or_report(options.protocol, cache_folder(), InputDepth::everything),
                          options, nullptr);
}

int run_session_again(const Experiment& experiment, const RunOptions& options, const PresentingAgain& again) {
    return run_session_of(experiment, options, &again);
}

} // namespace overt
