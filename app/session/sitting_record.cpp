#include "app/session/sitting_record.h"

#include "app/cli/this_program.h"
#include "app/rig/rig_page.h"
#include "app/session/recorded_options.h"
#include "app/session/session_recording.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/record/session_schema.h"

namespace overt {

namespace {

/// Where the tracker's own events are wanted and it tells none, the program's stand in for them.
std::optional<SittingDetection> detection_of(const Protocol& protocol, const EyeTracker& tracker) {
    if (protocol.events.method == EventMethod::none || !tracker.measures_gaze() ||
        (protocol.events.method == EventMethod::tracker && tracker.tells_events()))
        return std::nullopt;
    return SittingDetection{protocol.events, screen_geometry_of(protocol)};
}

} // namespace

SittingRecord::Folder SittingRecord::open_folder(const RunOptions& options, const SessionPlace& place,
                                                 const Experiment& experiment, const SessionPlan& plan,
                                                 Rig& rig) {
    SessionHeader now = make_session_header(
        experiment.protocol, plan.schedule, experiment.objects, rig.library(), rig.context().description(),
        rig.tracker().description(), rig.clock_kind(), !rig.maps_are_live(), options.draws_stimuli);
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

SittingRecord::SittingRecord(const Experiment& experiment, const RunOptions& options,
                             const SessionPlace& place, const SessionPlan& plan, SessionEquipment& equipment,
                             const PresentingAgain* again)
    : protocol_(experiment.protocol), equipment_(equipment),
      folder_(open_folder(options, place, experiment, plan, equipment.rig())) {
    open_files(options, plan, again);
    write_beginning(options, plan, again != nullptr);
}

void SittingRecord::open_files(const RunOptions& options, const SessionPlan& plan,
                               const PresentingAgain* again) {
    Rig& rig = equipment_.rig();
    const auto options_of = [&](const Protocol& protocol, const EyeTracker& tracker,
                                const std::optional<Resumption>& resumption) -> SessionStore::Options {
        return {.wait_when_full = options.virtual_time,
                .ring_capacity = 65536,
                .started_utc = folder_.started_utc,
                .program_version = this_program().version,
                .program_sha256 = this_program().sha256,
                .resumption = resumption,
                .detection = detection_of(protocol, tracker),
                .options = again ? again->options : recorded_options(options, folder_.path)};
    };
    store_.emplace(folder_.path / session_file_name,
                   options_of(protocol_, rig.tracker(),
                              plan.resumed ? std::optional(plan.resumed->resumption) : std::nullopt));
    further_.emplace(rig, folder_.path, plan.resumed ? &*plan.resumed : nullptr, options_of);
    shared_.emplace(*store_);
    further_->join(*shared_);
}

void SittingRecord::write_beginning(const RunOptions& options, const SessionPlan& plan, bool is_again) {
    Rig& rig = equipment_.rig();
    equipment_.box().write_beginning(*store_);
    if (!plan.earlier_sessions.empty() && !is_again)
        shared_->event({rig.clock().now(), -1, earlier_sessions_event, plan.earlier_sessions});
    note_circumstances(options, protocol_, plan.schedule, rig, *shared_);
    note_tracker(own_tracker(), rig.clock());
    // Time that is virtual runs on no rig.
    if (!options.virtual_time)
        note_rig_page(rig_folder(), facts_of_rig(), rig.clock(), *shared_);
    for (const std::string& description : equipment_.markers().descriptions())
        store_->event({rig.clock().now(), -1, marker_output_event, description});
    equipment_.answers().keep_in(folder_.path);
    store_->event({rig.clock().now(), -1, answer_recording_event, equipment_.answers().description()});
}

RigFacts SittingRecord::facts_of_rig() {
    Rig& rig = equipment_.rig();
    RigFacts facts = facts_of_protocol(protocol_);
    const std::optional<MonitorInfo> monitor = rig.monitor();
    add_screen_facts(facts, rig.context().description(), monitor ? &*monitor : nullptr);
    if (rig.tracker().measures_gaze())
        add_model_fact(facts, rig.tracker().description());
    if (const RecordedBox& box = equipment_.box().recorded(); box.use == RecordedBox::Use::box)
        add_box_fact(facts, box.product, box.serial_number);
    return facts;
}

RecordedTracker SittingRecord::own_tracker() {
    return {{}, protocol_.tracker, equipment_.rig().tracker(), folder_.path, *store_};
}

void SittingRecord::attempt_ended(const Trial& trial) {
    Rig& rig = equipment_.rig();
    if (LiveMaps* live = rig.live_maps())
        at_normal_priority([&] {
            for (const RecordedMap& map :
                 record_live_maps(live->take_finished(), folder_.path, folder_.header)) {
                store_->map_made(map);
                further_->add_map(map);
            }
        });
    for (const StruckFault& fault : rig.take_struck_faults()) {
        SessionLog& log = fault.is_trackers ? static_cast<SessionLog&>(*store_) : *shared_;
        log.event({rig.clock().now(), trial.index,
                   fault.is_trackers ? tracker_fault_event : display_fault_event, fault.what});
    }
    equipment_.box().check(*store_);
}

bool SittingRecord::close() {
    end_tracker(own_tracker(), equipment_.rig().clock());
    equipment_.box().leave(*store_);
    // Before the session's own: what is marked as complete has all its parts.
    const bool are_finished = further_->end();
    store_->close();
    return close_manifest(folder_.path) && are_finished;
}

void SittingRecord::rescue_tracker_files() {
    rescue_tracker_file(own_tracker());
    further_->rescue_files();
}

LostRows SittingRecord::lost() const {
    LostRows lost = store_->lost();
    lost += further_->lost();
    return lost;
}

} // namespace overt
