#include "experiment/record/read/session_record.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/record/header_checks.h"
#include "experiment/record/header_rows.h"
#include "experiment/record/read/trial_rows.h"
#include "experiment/record/session_file.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/sql.h"

namespace overt {
namespace {

/// Indices that lead out of the header's lists would be undefined behaviour in every reader.
void check_indices(const SessionHeader& header, const std::vector<TrialRecord>& trials,
                   const std::filesystem::path& file) {
    const auto within = [](int index, std::size_t count) {
        return index >= 0 && static_cast<std::size_t>(index) < count;
    };
    const auto entries = entry_counts(header);
    for (const TrialRecord& record : trials) {
        const Trial& trial = record.trial;
        bool is_known = within(trial.task, header.tasks.size());
        for (std::size_t i = 0; i < trial.shown_count(); ++i) {
            const auto [stimulus, slot] = trial.shown(i);
            for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
                is_known = is_known && within(stimulus.*stimulus_lists[list].index, entries[list]);
            is_known = is_known && within(stimulus.object, header.objects.size()) &&
                       within(stimulus.motion, header.animations.size()) &&
                       within(stimulus.view,
                              header.objects[static_cast<std::size_t>(stimulus.object)].cameras.size()) &&
                       within(slot, header.slots.size());
        }
        if (!is_known)
            throw RecordError(
                fmt::format("{}: table trial, trial_id {}: it names a task, an entry of a list or a slot "
                            "that the session does not have: the file is damaged.",
                            file.string(), record.id));
    }
}

} // namespace

SessionRecord::SessionRecord(const std::filesystem::path& session)
    : directory_(std::filesystem::is_directory(session) ? session : session.parent_path()),
      file_(std::filesystem::is_directory(session) ? session / session_file_name : session),
      database_(std::make_unique<SQLite::Database>(open_session_file(file_, SessionFileUse::read))) {
    make_ready_to_find();
    reading_session(file_, [&] {
        header_ = read_session_header(database());
        trials_ = read_trials(database());
        for (TrialRecord& trial : trials_) {
            const auto planned = static_cast<std::size_t>(trial.trial.index);
            if (trial.trial.index >= 0 && planned < header_.schedule.trials.size()) {
                const Trial& of = header_.schedule.trials[planned];
                trial.trial.block = of.block;
                trial.trial.levels = of.levels;
                trial.trial.correct = of.correct;
                trial.trial.role = of.role;
            }
        }
    });
    check_header(header_, file_);
    check_indices(header_, trials_, file_);
}
const SQLite::Database& SessionRecord::database() const {
    if (!database_)
        database_ = std::make_unique<SQLite::Database>(open_session_file(file_, SessionFileUse::read));
    return *database_;
}

void SessionRecord::rest() const noexcept { database_.reset(); }

SessionRecord::~SessionRecord() = default;
SessionRecord::SessionRecord(SessionRecord&&) noexcept = default;
SessionRecord& SessionRecord::operator=(SessionRecord&&) noexcept = default;

TrialRecord TrialRecord::seen_in(std::size_t i) const {
    OVERT_EXPECTS(place == 0 && i < trial.shown_count());
    TrialRecord seen = *this;
    seen.place = static_cast<int>(i);
    seen.trial.beside.clear();
    for (std::size_t k = 0; k < trial.shown_count(); ++k) {
        const PlacedStimulus shown = trial.shown(k);
        if (k != i) {
            seen.trial.beside.push_back(shown);
        } else {
            seen.trial.stimulus = shown.stimulus;
            seen.trial.slot = shown.slot;
        }
    }
    if (i < refreshes.size()) {
        seen.outcome.shown_refreshes = refreshes[i].shown;
        seen.outcome.missed_refreshes = refreshes[i].missed;
    }
    const bool tells_places =
        std::ranges::any_of(outcome.steps, [](const AttemptStep& step) { return step.places.has_value(); });
    if (tells_places && has_outcome()) {
        const auto spans = seen.lit_spans();
        const SessionTime never = started - SessionDuration(1);
        seen.outcome.presentation_onset = spans.empty() ? never : spans.front().first;
        seen.outcome.presentation_end = spans.empty() ? never : spans.back().second;
    }
    return seen;
}

std::vector<std::pair<SessionTime, SessionTime>> TrialRecord::lit_spans() const {
    std::vector<std::pair<SessionTime, SessionTime>> spans;
    for (const AttemptStep& step : outcome.steps)
        if (step.lights(place) && step.begin)
            spans.emplace_back(*step.begin, step.end.value_or(*step.begin));
    return spans;
}

std::vector<TrialRecord> SessionRecord::presentations() const {
    std::vector<TrialRecord> all;
    for (const TrialRecord& trial : trials_)
        for (std::size_t i = 0; i < trial.trial.shown_count(); ++i)
            all.push_back(trial.seen_in(i));
    return all;
}

std::vector<RecordedEvent> SessionRecord::events() const {
    std::vector<RecordedEvent> events;
    read_events([&](const RecordedEvent& event) { events.push_back(event); });
    return events;
}

void SessionRecord::read_events(const std::function<void(const RecordedEvent&)>& take) const {
    reading_session(file_, [&] {
        for (Query row(database(), "SELECT sitting, at_ns, trial, kind, detail FROM event ORDER BY id");
             row.step();)
            take(
                {row.small(), row.session_time(), row.optional_small().value_or(-1), row.text(), row.text()});
    });
}

SessionTime SessionRecord::last_time() const {
    return reading_session(file_, [&] {
        Query row(database(),
                  "SELECT MAX((SELECT COALESCE(MAX(at_ns), 0) FROM event), "
                  "(SELECT COALESCE(MAX(MAX(started_ns, COALESCE(responded_ns, 0))), 0) FROM trial), "
                  "(SELECT COALESCE(MAX(after_ns), 0) FROM clock_pair), "
                  "(SELECT COALESCE(MAX(vertical_blank_ns), 0) FROM flip))");
        row.step();
        SessionTime last = row.session_time();
        for (const SessionTime of_box : read_later_rows(
                 database(), "box_clock_pair", "SELECT COALESCE(MAX(after_ns), 0) FROM box_clock_pair",
                 [](Query& box) { return box.session_time(); }))
            last = std::max(last, of_box);
        for (const SessionTime of_key :
             read_later_rows(database(), "key_press", "SELECT COALESCE(MAX(at_ns), 0) FROM key_press",
                             [](Query& key) { return key.session_time(); }))
            last = std::max(last, of_key);
        return last;
    });
}

bool SessionRecord::is_complete() const {
    std::set<int> done;
    for (const int trial : skipped_trials())
        done.insert(trial);
    for (const TrialRecord& attempt : trials_)
        if (attempt.counts || (attempt.status == TrialRecord::Status::aborted && !attempt.is_superseded &&
                               attempt.outcome.afterwards == TrialOutcome::Afterwards::never))
            done.insert(attempt.trial.index);
    return done.size() == header_.schedule.trials.size() && closed_in_order();
}

std::vector<std::string> SessionRecord::damages() const {
    std::vector<std::string> damages;
    try {
        for (Query row(database(), "PRAGMA integrity_check"); row.step();)
            if (const std::string finding = row.text(); finding != "ok")
                damages.push_back(fmt::format("{}: {}", file_.string(), finding));
    } catch (const SQLite::Exception& reason) {
        damages.push_back(fmt::format("{}: {}", file_.string(), reason.what()));
    }
    if (hash_of_text(header_.protocol.text) != header_.protocol.sha256)
        damages.push_back(
            fmt::format("{}: the protocol's text does not have the hash recorded with it.", file_.string()));
    return damages;
}

} // namespace overt
