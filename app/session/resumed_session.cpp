#include "app/session/resumed_session.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/base/folder_lock.h"
#include "experiment/design/trial_queue.h"
#include "experiment/record/manifest.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_file.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/write/row_writer.h"

namespace overt {

bool observer_declined(const SessionRecord& record) {
    const std::vector<RecordedConsent> consents = record.consents();
    return !consents.empty() && !consents.back().accepted;
}

namespace {

/// What may have been lost when the program was killed, and more.
constexpr SessionDuration clock_leap = std::chrono::seconds(1);

std::filesystem::path session_to_take_up(const SessionPlace& place, std::optional<int> number) {
    const std::vector<int> numbers = session_numbers(place);
    const std::string whose =
        fmt::format("observer {} in {}", place.observer_label, (place.root / place.protocol_name).string());
    if (numbers.empty())
        throw InputError(
            fmt::format("{}: there is no session to go on with. Run one without --resume.", whose));
    if (number) {
        if (!std::binary_search(numbers.begin(), numbers.end(), *number))
            throw InputError(fmt::format("{}: there is no session {}; there is {}.", whose, *number,
                                         fmt::join(numbers, ", ")));
        return session_path(place, *number);
    }
    std::vector<int> declined;
    for (auto last = numbers.rbegin(); last != numbers.rend(); ++last) {
        std::filesystem::path folder = session_path(place, *last);
        const SessionRecord record(folder);
        if (record.is_complete())
            continue;
        if (!observer_declined(record))
            return folder;
        declined.push_back(*last);
    }
    if (!declined.empty())
        throw InputError(fmt::format(
            "{}: no session was interrupted. In session {} the observer did not agree to take part, and is "
            "asked again only if that is what --resume --session {} is to do.",
            whose, fmt::join(declined, ", "), declined.front()));
    throw InputError(
        fmt::format("{}: no session was interrupted: {} {} complete. The next one is run without "
                    "--resume.",
                    whose, fmt::join(numbers, ", "), numbers.size() == 1 ? "is" : "are"));
}

/// A session goes on with exactly the texts that it was begun with: with other orders or screens its parts
/// could not be analysed as one session.
void require_same_protocol(const std::filesystem::path& folder, const RecordedProtocol& recorded,
                           const Protocol& now) {
    std::string changed;
    if (recorded.sha256 != hash_of_text(now.text))
        changed = "the protocol";
    for (const RecordedProtocol::Included& file : recorded.included) {
        const auto same =
            std::find_if(now.included.begin(), now.included.end(), [&](const IncludedText& text) {
                return text.name == file.name && hash_of_text(text.text) == file.sha256;
            });
        if (changed.empty() && same == now.included.end())
            changed = fmt::format("the included file {}", file.name);
    }
    if (!changed.empty())
        throw InputError(
            fmt::format("{}: {} has changed since this session was begun, so that it cannot go on. "
                        "The text it was begun with lies in {}: put it back, or begin another "
                        "session without --resume.",
                        folder.string(), changed, (folder / "protocol.toml").string()));
}

/// An imported session is complete, and one with imported gaze is a copy of the session that may be resumed.
void refuse_imported(const SessionRecord& record) {
    const std::string folder = record.directory().string();
    const int sittings = 1 + static_cast<int>(record.resumptions().size());
    for (int sitting = 1; sitting <= sittings; ++sitting) {
        const std::optional<GazeSource> source = record.gaze_source(sitting);
        if (source && record.header().stimuli.empty())
            throw InputError(fmt::format("{}: this session was imported from {}: there is nothing to go on "
                                         "with. Name the one that is meant with --session.",
                                         folder, source->file));
        if (source)
            throw InputError(fmt::format("{}: this is a copy of a session, with the gaze of {}, and is not "
                                         "gone on with. Go on with the session itself, and import again.",
                                         folder, source->file));
    }
}

void require_same_run(const std::filesystem::path& folder, const SessionHeader& header,
                      const RunOptions& options) {
    if (options.seed && *options.seed != header.schedule.seed)
        throw InputError(fmt::format("{}: this session has the seed {}: leave --seed out, or give that.",
                                     folder.string(), header.schedule.seed));
    if ((header.clock == ClockKind::virtual_time) != options.virtual_time)
        throw InputError(fmt::format("{}: this session was begun {} --virtual-time, and goes on so.",
                                     folder.string(), options.virtual_time ? "without" : "with"));
}

/// What the policy makes of the record's last trial.
Resumption resumption_of(const SessionRecord& record, const Protocol& protocol, const SessionHistory& history,
                         ResumePolicy policy) {
    TrialQueue queue(protocol, record.header().schedule);
    queue.go_through(history.steps);
    const ResumeEffect effect = queue.resume(policy);
    Resumption resumption{policy, effect.skipped, {}, {}};
    if (!effect.restarted_block)
        return resumption;
    for (const TrialRecord& attempt : record.trials())
        if (attempt.trial.block == *effect.restarted_block)
            resumption.superseded.push_back(attempt.id);
    for (const Trial& trial : record.header().schedule.trials)
        if (trial.block == *effect.restarted_block)
            resumption.restarted.push_back(trial.index);
    return resumption;
}

/// Whether the observer has agreed and filled in the form, as far as there is anything to.
bool is_opened(const SessionRecord& record, const Protocol& protocol) {
    const std::vector<RecordedConsent> consents = record.consents();
    return (protocol.consent.text.empty() || (!consents.empty() && consents.back().accepted)) &&
           (fields_asked(protocol.observer_fields, form_at_begin).empty() ||
            !record.observer_fields().empty());
}

void say_where_it_stands(const ResumedSession& session, const SessionHistory& before) {
    const SessionHeader& header = session.header;
    fmt::print("resuming session {} of observer {}: {}\n", header.session_number,
               header.schedule.observer.label, session.folder.string());
    fmt::print("{} of {} are done", before.counted_trials, counted(header.schedule.trials.size(), "trial"));
    const Resumption& resumption = session.resumption;
    const auto last = std::find_if(before.steps.rbegin(), before.steps.rend(), [](const RecordedStep& step) {
        return step.kind == RecordedStep::Kind::trial || step.kind == RecordedStep::Kind::resumed;
    });
    const bool was_interrupted = last != before.steps.rend() && last->kind == RecordedStep::Kind::trial &&
                                 last->fate == AttemptFate::interrupted;
    if (!resumption.restarted.empty())
        fmt::print("; a block of {} begins again with its first\n",
                   counted(resumption.restarted.size(), "trial"));
    else if (resumption.skipped)
        fmt::print("; trial {} was interrupted, and is skipped\n", *resumption.skipped + 1);
    else if (was_interrupted)
        fmt::print("; trial {} was interrupted, and is done again\n", last->trial + 1);
    else
        fmt::print("; no trial was running\n");
}

} // namespace

bool finish_manifest(const RunOptions& options, const SessionPlace& place) {
    const std::vector<int> numbers = session_numbers(place);
    if (numbers.empty())
        return false;
    const std::filesystem::path folder = session_path(place, options.session_number.value_or(numbers.back()));
    if (!std::filesystem::exists(folder) || FolderLock(folder, FolderLock::Patience::none).is_refused() ||
        !SessionRecord(folder).is_complete())
        return false;
    try {
        if (read_manifest(folder).is_closed)
            return false;
    } catch (const RecordError&) {
        return false; // damaged, or of an earlier program: overt verify says which
    }
    const auto finish = [](const std::filesystem::path& record) {
        return fold_session_file(record / session_file_name) && close_manifest(record);
    };
    bool are_finished = true;
    for (const std::string& id : further_trackers_of(folder))
        are_finished = finish(further_record(folder, id)) && are_finished;
    if (!are_finished || !finish(folder))
        throw InputError(fmt::format("{}: all trials are done, but another program has the session open, so "
                                     "that its manifest cannot be finished: close it there, and run this "
                                     "again.",
                                     folder.string()));
    fmt::print("{}: all trials were done; the manifest is finished now\n", folder.string());
    return true;
}

ResumedSession take_up_session(const RunOptions& options, const SessionPlace& place,
                               const Protocol& protocol) {
    const std::filesystem::path folder = session_to_take_up(place, options.session_number);
    // Another program that records into it just now is found before minutes are spent.
    { const SessionLock no_other_program(folder); }
    const SessionRecord record(folder);
    refuse_imported(record);
    if (record.is_complete())
        throw InputError(
            fmt::format("{}: this session is complete: there is nothing to go on with.", folder.string()));
    require_same_protocol(folder, record.header().protocol, protocol);
    require_same_run(folder, record.header(), options);
    if (observer_declined(record))
        fmt::print(stderr, "session {}: the observer did not agree to take part, and is asked again\n",
                   record.header().session_number);

    const SessionHistory before = record.history();
    ResumedSession session{folder, record.header(), before, {}, {}};
    session.history.is_opened = is_opened(record, protocol);
    for (const RecordedObserverField& field : record.observer_fields())
        session.history.forms.push_back(field.asked);
    session.resumption = resumption_of(record, protocol, before, *options.resume);
    session.history.steps.push_back({RecordedStep::Kind::resumed, -1, {}, *options.resume});
    session.history.counted_trials -= static_cast<int>(
        std::count_if(record.trials().begin(), record.trials().end(), [&](const TrialRecord& attempt) {
            const auto& superseded = session.resumption.superseded;
            return attempt.counts &&
                   std::find(superseded.begin(), superseded.end(), attempt.id) != superseded.end();
        }));
    session.clock_start = record.last_time() + clock_leap;
    say_where_it_stands(session, before);
    return session;
}

Resumption resumption_of_further(const ResumedSession& session, const std::filesystem::path& further) {
    // A kill may have left the further tracker's record one attempt ahead. Attempts began at the same time in
    // both.
    std::vector<SessionTime> counted_starts;
    const SessionRecord own(session.folder);
    const std::vector<std::int64_t>& superseded = session.resumption.superseded;
    for (const TrialRecord& attempt : own.trials())
        if (attempt.counts && std::ranges::find(superseded, attempt.id) == superseded.end())
            counted_starts.push_back(attempt.started);
    Resumption resumption = session.resumption;
    resumption.superseded.clear();
    const SessionRecord theirs(further);
    for (const TrialRecord& attempt : theirs.trials())
        if (attempt.counts && std::ranges::find(counted_starts, attempt.started) == counted_starts.end())
            resumption.superseded.push_back(attempt.id);
    return resumption;
}

void require_same_trackers(const std::filesystem::path& session, std::vector<std::string> further_ids) {
    std::ranges::sort(further_ids);
    const std::vector<std::string> recorded = further_trackers_of(session);
    if (recorded == further_ids)
        return;
    const auto list = [](const std::vector<std::string>& ids) {
        return ids.empty() ? std::string("no further eye tracker")
                           : fmt::format("the further eye trackers {}", fmt::join(ids, ", "));
    };
    throw InputError(
        fmt::format("{}: this session was begun with {}, and would go on with {}: give --tracker "
                    "as it was given then.",
                    session.string(), list(recorded), list(further_ids)));
}

void require_same_stimuli(const ResumedSession& session, const SessionHeader& now) {
    const SessionHeader& then = session.header;
    std::vector<std::string> changed;
    for (std::size_t i = 0; i < std::min(then.objects.size(), now.objects.size()); ++i)
        if (then.objects[i].mesh_sha256 != now.objects[i].mesh_sha256)
            changed.push_back("the mesh of " + then.objects[i].id);
        else if (!then.objects[i].surface_sha256.empty() &&
                 then.objects[i].surface_sha256 != now.objects[i].surface_sha256)
            changed.push_back("the colours and pictures of " + then.objects[i].id);
    for (const RecordedStimulus& stimulus : then.stimuli) {
        const auto same =
            std::find_if(now.stimuli.begin(), now.stimuli.end(), [&](const RecordedStimulus& other) {
                return other.stimulus == stimulus.stimulus && other.is_same_as(stimulus);
            });
        if (same == now.stimuli.end())
            changed.push_back("the frames of " + stimulus_name(then, stimulus.stimulus));
    }
    const auto light_of = [](const SessionHeader& header) {
        return header.characterisation ? header.characterisation->sha256 : ContentHash();
    };
    if (light_of(then) != light_of(now))
        changed.emplace_back("the display's characterisation");
    if (!changed.empty())
        throw InputError(fmt::format("{}: what would be shown is not what this session was begun with: {} "
                                     "changed. Put back the files (and give the same --quality), or begin "
                                     "another session without --resume.",
                                     session.folder.string(), fmt::join(changed, ", ")));
}

} // namespace overt
