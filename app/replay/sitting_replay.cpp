#include "app/replay/sitting_replay.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>

#include "app/cli/interruption.h"
#include "app/replay/quiet_output.h"
#include "app/replay/session_copies.h"
#include "app/replay/stimuli_again.h"
#include "app/session/recorded_options.h"
#include "app/session/session_commands.h"
#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/ports/session_phase.h"
#include "experiment/record/manifest.h"
#include "experiment/record/session_directory.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/verify/sitting_cut.h"

namespace overt {

namespace {

namespace fs = std::filesystem;

/// All that is to be compared has been presented.
struct EnoughPresented {};

std::string faults_of(const SessionRecord& record, int sitting) {
    std::string faults;
    record.read_events([&](const RecordedEvent& event) {
        if (event.sitting == sitting &&
            (event.kind == simulated_faults_event || event.kind == simulated_tracker_faults_event))
            faults = event.detail;
    });
    return faults;
}

RunOptions options_of(const SittingRequest& request, const std::vector<RecordedOption>& recorded,
                      const fs::path& sessions) {
    const SessionRecord& record = request.record;
    const SessionHeader& header = record.header();
    RunOptions options;
    take_recorded_options(recorded, options);
    options.protocol = request.protocol;
    options.observer = header.schedule.observer.label;
    options.session_number = header.session_number;
    options.seed = header.schedule.seed;
    options.ask_at = AskAt::nobody;
    options.sessions = sessions;
    options.context = request.context;
    for (const RecordedObserverField& field : record.observer_fields())
        if (!field.value.empty())
            options.observer_fields.push_back(field.id + "=" + field.value);
    for (const auto& [sitting, word] : record.resumptions())
        if (sitting == request.sitting)
            options.resume = word == name_of(ResumePolicy::skip)            ? ResumePolicy::skip
                             : word == name_of(ResumePolicy::restart_block) ? ResumePolicy::restart_block
                                                                            : ResumePolicy::redo;
    if (const std::string faults = faults_of(record, request.sitting); !faults.empty()) {
        options.faults = request.work / "faults.toml";
        std::ofstream(options.faults, std::ios::binary) << faults;
    }
    return options;
}

/// The session as it was when this sitting took it up.
void put_back(const SessionRecord& record, int sitting, const fs::path& folder) {
    std::vector<std::string> later;
    for (const TrialRecord& attempt : record.trials())
        if (attempt.sitting >= sitting)
            if (const auto answer = record.answer_recording(attempt))
                later.push_back(answer->file);
    const auto put_record_back = [&](const fs::path& from, const fs::path& to) {
        for (const std::string& file : files_of_session(from, false))
            if (std::find(later.begin(), later.end(), file) == later.end())
                copy_file_to(from / file, to / file);
        copy_session_file(from / session_file_name, to / session_file_name);
        forget_sittings_from(to / session_file_name, sitting);
    };
    put_record_back(record.directory(), folder);
    for (const std::string& id : further_trackers_of(record.directory()))
        put_record_back(further_record(record.directory(), id), further_record(folder, id));
}

int attempts_in(const SessionRecord& record, int sitting) {
    return static_cast<int>(std::ranges::count(record.trials(), sitting, &TrialRecord::sitting));
}

bool has_crashed(const SessionRecord& record, int sitting) {
    bool has = false;
    record.read_events([&](const RecordedEvent& event) {
        has |= event.sitting == sitting && event.kind == program_crashed_event;
    });
    return has;
}

bool cuts_an_attempt(const SessionRecord& record, int sitting, const SittingCut& cut) {
    return std::ranges::any_of(record.trials(), [&](const TrialRecord& attempt) {
        return attempt.sitting == sitting && attempt.id == cut.cut.attempt;
    });
}

/// What is left of a session that failed where the recorded one did not.
[[noreturn]] void fail(const fs::path& said, const std::exception& error) {
    throw Error(fmt::format("the session could not be presented again: {}\nIt said before:\n{}", error.what(),
                            read_whole_file(said)));
}

} // namespace

int sittings_of(const SessionRecord& record) { return 1 + static_cast<int>(record.resumptions().size()); }

std::string why_not_again(const SessionRecord& record, int sitting) {
    const std::vector<RecordedOption> options = record.run_options(sitting);
    if (record.gaze_source(sitting))
        return "its gaze was imported from another recording";
    if (options.empty())
        return "a version of the program recorded it that did not write down the command's options";
    if (!recorded_value(options, "virtual-time"))
        return "it ran in real time";
    if (!recorded_value(options, "simulate-observer"))
        return "a person answered in it";
    return {};
}

std::optional<SittingCut> cut_of(const SessionRecord& record, int sitting) {
    const TrialRecord* last = nullptr;
    for (const TrialRecord& attempt : record.trials())
        if (attempt.sitting == sitting)
            last = &attempt;
    const bool is_open = last && !last->has_outcome();
    const std::int64_t after_last = (last ? last->id : 0) + 1;
    std::optional<SittingCut> cut;
    if (is_open || !record.closed_in_order(sitting))
        return SittingCut{{is_open ? last->id : after_last, {}}, "the program was killed in it"};
    if (has_crashed(record, sitting))
        return SittingCut{{after_last, {}}, "the program crashed in it"};
    std::optional<SessionTime> end;
    bool broke_off = false;
    record.read_events([&](const RecordedEvent& event) {
        if (event.sitting != sitting)
            return;
        if (event.kind == session_aborted_event && event.detail == interrupted_reason)
            cut = SittingCut{{after_last, end}, "it was ended by a signal"};
        if (event.kind == phase_event && event.detail == name_of(SessionPhase::end))
            end = event.at;
        broke_off |= last && event.kind == presentation_broken_off_event &&
                     event.trial == last->trial.index && event.at >= last->started;
    });
    if (!cut || !last || last->status != TrialRecord::Status::aborted || !last->outcome.failure.empty())
        return cut;
    cut->cut.attempt = last->id;
    if (const std::vector<FlipRecord> flips = record.flips(*last); broke_off && !flips.empty()) {
        cut->cut.from = flips.back().report.vertical_blank;
        return cut;
    }
    // A screen that waits for the observer ended early: what is recorded once it is left came sooner than it
    // comes in the replay.
    SessionTime latest = last->started;
    for (const SessionTime screen : {last->outcome.task_screen_onset, last->outcome.presentation_onset,
                                     last->outcome.presentation_end, last->outcome.response_screen_onset})
        if (last->reached(screen))
            latest = std::max(latest, screen);
    cut->cut.from = end ? std::min(*end, latest) : latest;
    return cut;
}

SittingReplay replay_sitting(const SittingRequest& request) {
    const SessionRecord& record = request.record;
    const SessionHeader& header = record.header();
    const SessionPlace place{request.work / "sessions", header.protocol.name, header.schedule.observer.label};
    SittingReplay replay{{},
                         {},
                         cut_of(record, request.sitting),
                         request.work / "recorded.sqlite",
                         session_path(place, header.session_number)};
    fs::create_directories(request.work);
    if (request.sitting > 1)
        put_back(record, request.sitting, replay.folder);
    const PresentingAgain unwatched{record.run_options(request.sitting),
                                    cache_without_maps(request.cache, request.work / "cache")};
    const RunOptions options = options_of(request, unwatched.options, place.root);

    const fs::path said = request.work / "said.txt";
    const int all = attempts_in(record, request.sitting);
    // What the record has after its last attempt, such as the begin of the next trial, comes during one more.
    const bool goes_on = replay.cut && !cuts_an_attempt(record, request.sitting, *replay.cut);
    const int enough = all + (goes_on ? 1 : 0);
    {
        QuietOutput quiet(said);
        PresentingAgain again = unwatched;
        int done = 0;
        again.trial_done = [&] {
            ++done;
            quiet.aside([&] { request.progress(std::min(done, all), all); });
            if (replay.cut && done >= enough)
                throw EnoughPresented();
        };
        try {
            run_session_again(request.experiment, options, again);
        } catch (const EnoughPresented&) {
            // The record has no more.
        } catch (const std::exception& error) {
            fail(said, error);
        }
    }
    if (Interruption::requested())
        throw Error("the replay was interrupted: nothing was compared");

    const std::optional<RecordCut> cut = replay.cut ? std::optional(replay.cut->cut) : std::nullopt;
    const auto compare = [&](const fs::path& recorded, const fs::path& copy, const fs::path& presented) {
        copy_session_file(recorded / session_file_name, copy);
        forget_sittings_from(copy, request.sitting + 1);
        return compare_records(copy, presented / session_file_name, cut);
    };
    replay.comparison = compare(record.directory(), replay.recorded_file, replay.folder);
    for (const std::string& id : further_trackers_of(record.directory()))
        replay.further[id] =
            compare(further_record(record.directory(), id), request.work / ("recorded_" + id + ".sqlite"),
                    further_record(replay.folder, id));
    return replay;
}

} // namespace overt
