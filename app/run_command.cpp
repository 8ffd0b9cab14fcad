#include <fstream>
#include <iostream>
#include <random>

#include <fmt/format.h>
#include <unistd.h>

#include "app/answer_equipment.h"
#include "app/cache_folder.h"
#include "app/commands.h"
#include "app/display_box_session.h"
#include "app/interruption.h"
#include "app/observer_questions.h"
#include "app/output_verification.h"
#include "app/progress_bar.h"
#include "app/protocol_file.h"
#include "app/protocol_inputs.h"
#include "app/resumed_session.h"
#include "app/rig.h"
#include "app/session_recording.h"
#include "devices/thread_priority.h"
#include "experiment/error.h"
#include "experiment/protocol/fault_file.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/session_store.h"
#include "experiment/record/timing_report.h"
#include "experiment/schedule.h"
#include "experiment/session.h"

namespace overt {

namespace {

std::uint64_t fresh_seed() {
    std::random_device device;
    return (std::uint64_t{device()} << 32) | device();
}

Schedule new_schedule(const RunOptions& options, const Protocol& protocol, const Observer& observer) {
    const std::uint64_t seed = options.seed             ? *options.seed
                               : protocol.schedule.seed ? *protocol.schedule.seed
                                                        : fresh_seed();
    Schedule schedule = make_schedule(protocol, observer, seed);
    if (options.trials && *options.trials < static_cast<int>(schedule.trials.size()))
        schedule.trials.resize(static_cast<std::size_t>(*options.trials));
    return schedule;
}

/// Prints where the session stands after each trial.
class TrialProgress {
  public:
    TrialProgress(const Protocol& protocol, int total) : protocol_(&protocol), total_(total) {
        bar_.update("trials", 0, total_);
    }

    void operator()(const Trial& trial, const TrialOutcome& outcome, int done) {
        const auto name = [](const auto& list, int index) {
            return list[static_cast<std::size_t>(index)].id;
        };
        bar_.update("trials", done, total_);
        if (outcome.missed_refreshes > 0) {
            bar_.finish();
            fmt::print(stderr, "trial {} ({}, {}, {}): {} refreshes missed\n", trial.index + 1,
                       name(protocol_->tasks, trial.task),
                       name(protocol_->sculptures, trial.condition.sculpture),
                       name(protocol_->materials, trial.condition.material), outcome.missed_refreshes);
        }
    }
    void finish() { bar_.finish(); }

  private:
    const Protocol* protocol_;
    int total_;
    ProgressBar bar_;
};

void say_before(const Protocol& protocol, const Schedule& schedule, const GlDescription& graphics,
                const RunOptions& options) {
    fmt::print("{}: observer {} (number {}), {} trials, seed {}\n",
               protocol.title.empty() ? protocol.name : protocol.title, schedule.observer.label,
               schedule.observer.number, schedule.trials.size(), schedule.seed);
    fmt::print("display: {} ({}), {}\n", name_of(graphics.kind), graphics.renderer,
               options.virtual_time ? "in virtual time" : "in real time");
    if (!options.simulate_observer)
        fmt::print("tracker: simulated; the gaze in this session is nobody's\n");
}

void say_frames(const StimulusLibrary& library) {
    const std::vector<Condition> rendered = library.rendered_stimuli();
    if (!rendered.empty())
        fmt::print("frames: {}\n", library.source_of(rendered.front()));
}

/// Draws and renders what the cache lacks. Ctrl-C ends it with what is finished.
void prepare_stimuli(Rig& rig, const RunOptions& options) {
    ProgressBar bar;
    const Progress show = [&](std::string_view what, int done, int total, double share) {
        bar.update(what, done, total, share);
        if (Interruption::requested())
            throw Error(
                "interrupted while the stimuli were made ready: no trial was begun. What was finished "
                "is kept, and the same command goes on from there.");
    };
    if (!rig.maps_are_live())
        rig.library().prepare_maps(show);
    rig.library().prepare_given_maps(show);
    rig.library().prepare_frames(show, options.quality);
}

void say_risks(const std::vector<ScreenFinding>& findings) {
    for (const ScreenFinding& finding : findings)
        if (finding.weight == ScreenFinding::Weight::risk)
            fmt::print(stderr, "risk: {}: {}\n", finding.what, finding.finding);
}

void check_timing(Rig& rig, double seconds) {
    ProgressBar bar;
    const std::vector<ScreenFinding> findings = rig.check_timing(
        seconds, [&](int done, int total) { bar.update("measuring the screen's refresh, s", done, total); });
    bar.finish();
    for (const ScreenFinding& finding : findings)
        if (finding.what == "measured refresh" || finding.what == "vertical blank")
            fmt::print("{}: {}\n", finding.what, finding.finding);
    say_risks(findings);
}

/// The faults of --faults, or none. What is wrong with the file is printed, with its places.
DisplayFaults read_faults_or_report(const std::filesystem::path& file) {
    if (file.empty())
        return {};
    Diagnostics diagnostics;
    const std::optional<DisplayFaults> faults = read_fault_file(file, diagnostics);
    print_findings(diagnostics);
    if (!faults)
        throw FindingsPrinted(fmt::format("{}: no session was begun", file.string()));
    return *faults;
}

/// So that nobody takes the session for one on a real display.
void note_faults(const std::filesystem::path& file, const Clock& clock, SessionStore& store) {
    if (file.empty())
        return;
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    store.event({clock.now(), -1, simulated_faults_event, text});
    fmt::print("display: with the simulated faults of {}\n", file.string());
}

void note_struck(const VirtualRefresh& display, const Trial& trial, const Clock& clock, SessionStore& store) {
    for (const DisplayFault& fault : display.struck()) {
        const bool skips = fault.kind == DisplayFault::Kind::skip;
        store.event({clock.now(), trial.index, "display fault",
                     skips ? fmt::format("skip of {} at refresh {}", fault.refreshes, fault.refresh)
                           : fmt::format("{} by {:.3f} ms at refresh {}", name_of(fault.kind),
                                         fault.amount_ms, fault.refresh)});
    }
}

/// The form as far as it is filled in outside of the window. Throws InputError for what is missing where
/// nobody can be asked.
FieldValues fill_in_form(const Protocol& protocol, const RunOptions& options) {
    const std::span<const ObserverFieldSettings> fields = protocol.observer_fields;
    FieldValues values = values_given(fields, options.observer_fields);
    if (options.simulate_observer)
        simulate_values(fields, values, *options.simulate_observer);
    const bool has_window = wants_window(options.context), has_terminal = ::isatty(STDIN_FILENO) == 1;
    const bool asks_in_window = options.ask_at == AskAt::window && has_window && !options.simulate_observer;
    if (!options.simulate_observer && has_terminal &&
        (options.ask_at == AskAt::terminal || (options.ask_at == AskAt::window && !has_window)))
        ask_for_values(fields, values, std::cin, std::cerr);
    if (!asks_in_window)
        require_values(fields, values);
    return values;
}

std::vector<ScriptedOperatorKey> operators_keys(const RunOptions& options) {
    if (!options.operator_keys.empty() && !options.simulate_observer)
        throw InputError("--simulate-operator is for sessions with --simulate-observer");
    std::vector<ScriptedOperatorKey> keys;
    for (const std::string& key : options.operator_keys)
        keys.push_back(read_operator_key(key));
    return keys;
}

void note_thread(const std::vector<ThreadWish>& wishes, const Clock& clock, SessionStore& store) {
    for (const ThreadWish& wish : wishes) {
        const std::string answer =
            fmt::format("{}: {}{}", wish.what, wish.granted ? "" : "refused: ", wish.detail);
        store.event({clock.now(), -1, "thread", answer});
        fmt::print(wish.granted ? stdout : stderr, "{}\n", answer);
    }
}

} // namespace

int run_session(const RunOptions& options) {
    const Observer observer = observer_labelled(options.observer);
    const Experiment experiment =
        read_experiment_or_report(options.protocol, cache_folder(), InputDepth::everything);
    const Protocol& protocol = experiment.protocol;
    const std::vector<Sculpture>& sculptures = experiment.sculptures;
    // What would refuse the session at its end is said before anything is drawn.
    const SessionPlace place{options.sessions, protocol.name, observer.label};
    if (options.resume && finish_manifest(options, place))
        return 0;
    std::optional<ResumedSession> resumed;
    if (options.resume)
        resumed = take_up_session(options, place, protocol);
    else
        check_session_place(place, options.session_number);
    const DisplayFaults faults = read_faults_or_report(options.faults);
    // Whoever goes on was asked already.
    const bool asks = !resumed || !resumed->so_far.is_opened;
    const FieldValues fields = asks ? fill_in_form(protocol, options) : FieldValues();
    const Schedule schedule = resumed ? resumed->header.schedule : new_schedule(options, protocol, observer);

    switch_back_what_was_left();
    const BoxPlan box_plan = plan_box(protocol.display, wants_window(options.context), options.virtual_time);
    std::optional<BoxIdentity> box_identity;
    if (box_plan.use == RecordedBox::Use::box)
        box_identity = require_box(box_plan);

    // What is simulated has a seed of its own, so that one order can be rehearsed with several observers.
    RigRequest request{options.context,
                       options.virtual_time,
                       options.windowed,
                       options.simulate_observer.has_value(),
                       options.simulate_observer.value_or(schedule.seed),
                       options.maps,
                       options.monitor,
                       operators_keys(options)};
    Rig rig(protocol, sculptures, request, cache_folder());
    say_before(protocol, schedule, rig.context().description(), options);
    say_risks(rig.screen_findings());
    const Interruption interruption;
    prepare_stimuli(rig, options);
    say_frames(rig.library());
    rig.open(faults, resumed ? resumed->clock_start : SessionTime());
    if (rig.is_on_a_real_screen() && options.refresh_check_s > 0.0)
        check_timing(rig, options.refresh_check_s);
    rig.presenter().close_on(Interruption::requested());
    std::optional<DisplayBoxSession> box;
    if (box_identity) {
        fmt::print("display box: switching {} at {} …\n", box_identity->product, box_identity->port);
        box.emplace(*box_identity, protocol.display, rig.clock(), rig.presenter());
    }
    RecordedBox recorded_box;
    recorded_box.use = box_plan.use;
    if (box)
        recorded_box = box->recorded();
    fmt::print("display box: {}\n", describe(recorded_box));

    AnswerEquipment answers(protocol.answers, rig.clock(),
                            options.simulate_observer ? &rig.simulated_observer() : nullptr,
                            options.simulate_observer.value_or(schedule.seed));
    fmt::print("spoken answers: {}\n", answers.description());

    SessionHeader header =
        make_session_header(protocol, schedule, sculptures, rig.library(), rig.context().description(),
                            rig.tracker().description(), rig.clock_kind(), !rig.maps_are_live());
    const std::string started_utc = header.started_utc;
    std::filesystem::path folder;
    if (resumed) {
        require_same_stimuli(*resumed, header);
        folder = resumed->folder;
        header = resumed->header;
        reopen_manifest(folder, header, this_program());
    } else {
        SessionDirectory directory(place, options.session_number);
        header.session_number = directory.session_number();
        put_files(directory, header, sculptures, rig.library());
        directory.publish();
        folder = directory.path();
    }

    SessionStore store(folder / session_file_name,
                       {.wait_when_full = options.virtual_time,
                        .ring_capacity = 65536,
                        .started_utc = started_utc,
                        .program_version = this_program().version,
                        .program_sha256 = this_program().sha256,
                        .resumption = resumed ? std::optional(resumed->resumption) : std::nullopt});
    if (box)
        box->write_beginning(store);
    else
        store.display_box(recorded_box);
    for (const ScreenFinding& finding : rig.screen_findings())
        store.event({rig.clock().now(), -1, "screen", fmt::format("{}: {}", finding.what, finding.finding)});
    if (options.verify_output) {
        ProgressBar bar;
        record_verification(rig.presenter(), rig.library(), protocol, schedule, rig.clock(), store,
                            [&](int done, int total) { bar.update("verifying the output", done, total); });
    }
    answers.keep_in(folder);
    store.event({rig.clock().now(), -1, "answer recording", answers.description()});
    Session session(protocol, schedule, screen_geometry_of(protocol).centre(),
                    {.clock = rig.clock(),
                     .presenter = rig.presenter(),
                     .tracker = rig.tracker(),
                     .panel = rig.panel(),
                     .log = store,
                     .witnesses = rig.witnesses(),
                     .observer = observer.label,
                     .can_type = !options.simulate_observer && options.ask_at == AskAt::window,
                     .recorder = answers.recorder(),
                     .on_level = answers.meter()},
                    fields);
    TrialProgress progress(protocol, static_cast<int>(schedule.trials.size()));
    note_faults(options.faults, rig.clock(), store);
    note_thread(prepare_thread({options.realtime, options.processor}), rig.clock(), store);
    const SessionResult result = session.run(
        [&](const Trial& trial, const TrialOutcome& outcome, int done) {
            if (LiveMaps* live = rig.live_maps())
                record_live_maps(live->take_finished(), folder, header, store);
            progress(trial, outcome, done);
            if (const VirtualRefresh* display = rig.virtual_refresh())
                note_struck(*display, trial, rig.clock(), store);
            if (box)
                box->check(store);
        },
        resumed ? resumed->so_far : SessionSoFar());
    progress.finish();
    if (box)
        box->leave(store);
    store.close();
    close_manifest(folder);
    const LostRows lost = store.lost();
    if (lost.flips + lost.samples > 0)
        fmt::print(stderr, "the disk was too slow: {} flips and {} samples were not recorded\n", lost.flips,
                   lost.samples);

    fmt::print("{} of {} trials completed, {} refreshes missed\nsession: {}\n", result.completed_trials,
               schedule.trials.size(), result.missed_refreshes, folder.string());
    if (!options.print_session_to.empty()) {
        std::ofstream file(options.print_session_to);
        file << folder.string() << "\n";
        if (!file.flush())
            throw RecordError(fmt::format("{}: cannot be written", options.print_session_to.string()));
    }
    if (result.aborted)
        fmt::print(stderr, "the session ended early: {}\n", result.reason);
    return result.aborted ? 1 : 0;
}

} // namespace overt
