#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/record/asc/asc_import.h"
#include "experiment/record/asc/asc_rows.h"
#include "experiment/record/asc/asc_trial.h"
#include "experiment/record/asc/imported_session.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/schema_migration.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/sql.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

/// A session's clock readings speak for a file if they were made not longer than this before or after it.
constexpr std::chrono::minutes most_beyond_readings{10};

/// A message has whole milliseconds: it was sent somewhere within its own.
constexpr std::chrono::microseconds half_message_tick{500};

/// Which attempts of a sitting the trials of the file are.
struct Match {
    int sitting = 1;
    std::map<int, const TrialRecord*> attempt_of; ///< by the file's trial
};

/// In the order of the attempts: a trial that was repeated is named again.
Match match_sitting(const SessionRecord& record, int sitting, const std::vector<std::optional<int>>& numbers,
                    int first_number) {
    Match match{sitting, {}};
    auto next = record.trials().begin();
    for (int trial = 0; trial < static_cast<int>(numbers.size()); ++trial) {
        const std::optional<int>& number = numbers[static_cast<std::size_t>(trial)];
        if (!number)
            continue;
        const auto found = std::find_if(next, record.trials().end(), [&](const TrialRecord& attempt) {
            return attempt.sitting == sitting && attempt.trial.index == *number - first_number;
        });
        if (found == record.trials().end())
            continue;
        match.attempt_of[trial] = &*found;
        next = found + 1;
    }
    return match;
}

Match best_match(const SessionRecord& record, const std::vector<std::optional<int>>& numbers) {
    const bool counts_from_0 = std::find(numbers.begin(), numbers.end(), 0) != numbers.end();
    std::set<int> sittings;
    for (const TrialRecord& trial : record.trials())
        sittings.insert(trial.sitting);
    Match best;
    for (const int sitting : sittings)
        if (Match match = match_sitting(record, sitting, numbers, counts_from_0 ? 0 : 1);
            match.attempt_of.size() > best.attempt_of.size())
            best = std::move(match);
    return best;
}

bool speak_for(const std::vector<ClockPair>& pairs, const AscSurvey& survey) {
    if (pairs.empty())
        return false;
    const auto [first, last] = std::minmax_element(
        pairs.begin(), pairs.end(), [](const ClockPair& a, const ClockPair& b) { return a.other < b.other; });
    return survey.first >= first->other - most_beyond_readings &&
           survey.last <= last->other + most_beyond_readings;
}

/// The same instant by both clocks, from the screens that a trial's messages name.
std::vector<ClockPair> pairs_of(const TrialRecord& attempt, const AscTrialTimes& times) {
    std::vector<ClockPair> pairs;
    for (const auto& [word, at] : screens_of(attempt))
        if (const auto found = times.screens.find(word); found != times.screens.end())
            pairs.push_back(
                {at - half_message_tick, found->second + half_message_tick, at + half_message_tick});
    return pairs;
}

/// Beside the folder that holds the sessions, not in it: a pattern such as sessions/NAME/* takes each
/// observer's session once.
fs::path place_of_copy(const fs::path& session) {
    const fs::path sessions = session.parent_path();
    return sessions.parent_path() / fmt::format("{}_imports", sessions.filename().string()) /
           session.filename();
}

void copy_files(const fs::path& from, const fs::path& to) {
    for (auto entry = fs::recursive_directory_iterator(from); entry != fs::recursive_directory_iterator();
         ++entry) {
        const std::string name = entry->path().filename().string();
        const bool is_of_database = name.starts_with(session_file_name);
        if (entry->symlink_status().type() == fs::file_type::directory &&
            (name.starts_with("export_") || name.starts_with("."))) {
            entry.disable_recursion_pending();
            continue;
        }
        const fs::path target = to / entry->path().lexically_relative(from);
        // Links, pipes and devices stay where they are: what they lead to is none of the session.
        const fs::file_type type = entry->symlink_status().type();
        if (type == fs::file_type::directory)
            fs::create_directories(target);
        else if (type == fs::file_type::regular && !is_of_database)
            fs::copy_file(entry->path(), target);
    }
}

/// With what is still in its log, whoever may be reading or writing it.
void copy_session_file(const fs::path& from, const fs::path& to) {
    try {
        SQLite::Database database(from.string(), SQLite::OPEN_READONLY);
        SQLite::Statement copy(database, "VACUUM INTO ?");
        run_statement(copy, to.string());
    } catch (const SQLite::Exception& reason) {
        throw_record_error(from, "copying the session", reason);
    }
}

void add_remarks(AscImportSummary& summary, const SessionRecord& record, const Match& match,
                 bool keeps_clock) {
    const auto add = [&](std::string remark) { summary.remarks.push_back(std::move(remark)); };
    add(fmt::format("The gaze is that of sitting {}; {}.", match.sitting,
                    keeps_clock ? "the session's own readings of the tracker's clock relate their times"
                                : "the messages of the trials' screens relate the clocks"));
    if (const std::size_t unknown = static_cast<std::size_t>(summary.survey.trials) - match.attempt_of.size();
        unknown > 0)
        add(fmt::format("{} trials of the file are none of the session's and are left out.", unknown));
    std::set<const TrialRecord*> matched;
    for (const auto& [trial, attempt] : match.attempt_of)
        matched.insert(attempt);
    for (const TrialRecord& trial : record.trials())
        if (trial.sitting == match.sitting && !matched.contains(&trial))
            add(fmt::format("Trial {}, attempt {}, is not in the file: it has no gaze now.",
                            trial.trial.index + 1, trial.attempt));
    add_asc_remarks(summary);
}

void delete_gaze(SQLite::Database& database, std::int64_t trial_id) {
    for (const char* sql :
         {"DELETE FROM sample WHERE trial_id = ?", "DELETE FROM gaze_event WHERE trial_id = ?"}) {
        for (const std::int64_t id : {trial_id, after_trial(trial_id)}) {
            SQLite::Statement statement(database, sql);
            run_statement(statement, id);
        }
    }
}

} // namespace

AscImportSummary import_asc_into(const AscFiles& files, const fs::path& session,
                                 const AscImportOptions& options) {
    const SessionRecord record(session);
    const fs::path folder = fs::absolute(record.directory()).lexically_normal();
    const fs::path named = folder.has_filename() ? folder : folder.parent_path();
    const fs::path out = options.out.empty() ? place_of_copy(named) : options.out;
    if (fs::exists(out))
        throw InputError(fmt::format(
            "{}: exists already and is not overwritten. Name another folder with --out.", out.string()));
    AscImportSummary summary;
    AscSurveyOptions reading = options.reading;
    reading.progress = part_of(options.reading.progress, 0, 2, 3);
    summary.survey = survey_asc(files, reading);
    const Match match = best_match(record, summary.survey.trial_numbers);
    if (match.attempt_of.empty())
        throw InputError(
            fmt::format("{}: no message TRIALID of this file names a trial of {}. Trials are told by "
                        "messages such as \"TRIALID 3\"; without --into the file becomes a session of "
                        "its own.",
                        files.path(), record.directory().string()));
    const bool keeps_clock = speak_for(record.clock_pairs(match.sitting), summary.survey);

    PartialDirectory partial(out);
    copy_files(record.directory(), partial.path());
    const fs::path session_file = partial.path() / session_file_name;
    copy_session_file(record.directory() / session_file_name, session_file);
    migrate_session_file(session_file, KeptCopy::none);
    write_session_rows(session_file, [&](SQLite::Database& database) {
        GazeRows rows(database);
        for (const TrialRecord& trial : record.trials())
            if (trial.sitting == match.sitting)
                delete_gaze(database, trial.id);
        SQLite::Statement forget(database, "DELETE FROM gaze_event WHERE trial_id = 0");
        run_statement(forget);
        SQLite::Statement forget_detection(database, "DELETE FROM event_detection WHERE sitting = ?");
        run_statement(forget_detection, match.sitting);
        rows.source(match.sitting, gaze_source_of(files, summary.survey));
        std::vector<ClockPair> pairs;
        AscRows sink(
            rows, match.sitting, AscTrialCutter::By::trial_ids,
            [&](int trial) {
                const auto found = match.attempt_of.find(trial);
                return found == match.attempt_of.end() ? std::nullopt : std::optional(found->second->id);
            },
            [&](const AscTrialTimes& times) {
                const auto found = match.attempt_of.find(times.trial);
                if (found == match.attempt_of.end())
                    return;
                ++summary.trials;
                if (!keeps_clock)
                    for (const ClockPair& pair : pairs_of(*found->second, times))
                        pairs.push_back(pair);
            });
        AscParser parser(sink, summary.survey.conventions);
        files.parse(parser, part_of(options.reading.progress, 2, 1, 3));
        sink.end();
        if (keeps_clock)
            return;
        if (pairs.empty())
            throw InputError(
                fmt::format("{}: nothing relates its times to those of the session: its times are "
                            "beyond the session's readings of the tracker's clock, and it has no "
                            "messages such as \"{}\" for the trials' screens.",
                            files.path(), onset_message));
        SQLite::Statement forget_pairs(database, "DELETE FROM clock_pair WHERE sitting = ?");
        run_statement(forget_pairs, match.sitting);
        for (const ClockPair& pair : pairs)
            insert_values(database, "INTO clock_pair (sitting, before_ns, tracker_us, after_ns)",
                          match.sitting, pair.before, pair.other, pair.after);
    });
    note_detection(partial.path(), match.sitting, files.path(), options, summary);
    finish_imported_session(partial.path(), options.program);
    partial.publish();
    summary.session = partial.path();
    add_remarks(summary, record, match, keeps_clock);
    return summary;
}

} // namespace overt
