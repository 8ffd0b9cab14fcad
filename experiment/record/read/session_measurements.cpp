/// What was measured in the trials of a session: refreshes, gaze and spoken answers.
#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/path_inside.h"
#include "experiment/record/gaze_rows.h"
#include "experiment/record/read/match_rows.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/sql.h"

namespace overt {
namespace {

FlipRecord read_flip(Query& row, int trial) {
    FlipRecord flip;
    flip.trial = trial;
    FlipReport& report = flip.report;
    int source = 0;
    row.read(flip.refresh_in_trial, report.refresh.value, flip.planned.value, flip.shown.value,
             flip.pose.value, report.requested, report.swapped, report.vertical_blank, source,
             flip.missed_refreshes, report.uncertainty, flip.step);
    report.source = static_cast<VblankSource>(source);
    return flip;
}

/// Puts what a further slot showed in the place of what the first did. Flips without a row showed nothing
/// there.
void take_slot_flips(const SQLite::Database& database, const TrialRecord& trial,
                     std::vector<FlipRecord>& flips) {
    for (FlipRecord& flip : flips)
        flip.planned = flip.shown = no_frame;
    Query row(database, "SELECT refresh_in_trial, planned, shown, pose FROM slot_flip WHERE trial_id = ? AND "
                        "place = ? ORDER BY refresh_in_trial");
    row.bind(1, trial.id);
    row.bind(2, trial.place);
    auto flip = flips.begin();
    while (row.step()) {
        const int refresh = row.small();
        flip = std::ranges::find(flip, flips.end(), refresh, &FlipRecord::refresh_in_trial);
        if (flip == flips.end())
            return;
        row.read(flip->planned.value, flip->shown.value, flip->pose.value);
    }
}

GazeSample read_sample(Query& row) {
    GazeSample sample;
    sample.sampled_at = row.tracker_time();
    sample.eye = row.small() == 0 ? Eye::left : Eye::right;
    const auto x_px = row.optional_real(), y_px = row.optional_real();
    if (x_px && y_px)
        sample.gaze = ScreenPoint{*x_px, *y_px};
    sample.pupil_area = static_cast<float>(row.real());
    return sample;
}

RecordedAnswer read_answer(Query& row, int trial) {
    RecordedAnswer answer;
    answer.trial = trial;
    answer.file = row.text();
    if (!answer.file.empty() && !stays_inside(answer.file))
        throw RecordError(
            fmt::format("table answer_recording, trial {}: it names a file outside of the session, "
                        "\"{}\": the record is damaged, or was not made by overt.",
                        trial, answer.file));
    row.read(answer.sha256, answer.device, answer.sample_rate_hz, answer.measured_rate_hz, answer.bits,
             answer.input_latency, answer.samples, answer.onset_sample, answer.onset_uncertainty,
             answer.overruns, answer.lost_samples, answer.peak_dbfs, answer.noise_dbfs,
             answer.clipped_samples, answer.fault, answer.voice_onset, answer.voice_end);
    return answer;
}

} // namespace

std::vector<FlipRecord> SessionRecord::flips(const TrialRecord& trial) const {
    std::vector<FlipRecord> rows = reading_session(file_, [&] {
        return read_rows(
            database(),
            fmt::format("SELECT refresh_in_trial, refresh, planned, shown, pose, requested_ns, swapped_ns, "
                        "vertical_blank_ns, source, missed, {}, {} FROM flip WHERE trial_id = ? ORDER BY n",
                        has_column(database(), "flip", "uncertainty_ns") ? "uncertainty_ns" : "0",
                        has_column(database(), "flip", "step") ? "step" : "0"),
            [&](Query& row) { return read_flip(row, trial.trial.index); }, trial.id);
    });
    const int frame_count = header_.animation_of(trial.trial.stimulus).frame_count;
    if (trial.place > 0)
        take_slot_flips(database(), trial, rows);
    for (const FlipRecord& flip : rows) {
        const auto is_frame = [&](AnimationFrameIndex frame) {
            return frame == no_frame || (frame.value >= 0 && frame.value < frame_count);
        };
        if (flip.pose.value < 0 || static_cast<std::size_t>(flip.pose.value) >= header_.poses.angles.size() ||
            !is_frame(flip.shown) || !is_frame(flip.planned))
            throw RecordError(fmt::format("{}: table flip, trial {}: refresh {} names a frame or a pose that "
                                          "the session does not have: the file is damaged.",
                                          file_.string(), trial.trial.index + 1, flip.refresh_in_trial));
    }
    if (!rows.empty() && header_.display.refresh_hz == 0.0)
        throw RecordError(
            fmt::format("{}: trial {} has flips of a display that has no refresh rate: the file is "
                        "damaged.",
                        file_.string(), trial.trial.index + 1));
    return rows;
}

std::vector<SteeredFlip> SessionRecord::steered_flips(const TrialRecord& trial) const {
    return reading_session(file_, [&] { return read_steered_flips(database(), trial); });
}

std::vector<GazeSample> SessionRecord::samples(const TrialRecord& trial) const {
    std::vector<GazeSample> samples;
    read_samples(trial, 65536, [&](std::span<const GazeSample> piece) {
        samples.insert(samples.end(), piece.begin(), piece.end());
    });
    return samples;
}

void SessionRecord::read_samples(const TrialRecord& trial, std::size_t most,
                                 const std::function<void(std::span<const GazeSample>)>& take) const {
    read_samples_of(trial.id, most, take);
}

void SessionRecord::read_samples_after(const TrialRecord& trial, std::size_t most,
                                       const std::function<void(std::span<const GazeSample>)>& take) const {
    read_samples_of(after_trial(trial.id), most, take);
}

void SessionRecord::read_samples_of(std::int64_t trial_id, std::size_t most,
                                    const std::function<void(std::span<const GazeSample>)>& take) const {
    reading_session(file_, [&] {
        std::vector<GazeSample> piece;
        Query row(database(),
                  "SELECT tracker_us, eye, x_px, y_px, pupil_area FROM sample WHERE trial_id = ? ORDER BY n");
        row.bind(1, trial_id);
        while (row.step()) {
            piece.push_back(read_sample(row));
            if (piece.size() == most) {
                take(piece);
                piece.clear();
            }
        }
        if (!piece.empty())
            take(piece);
    });
}

std::optional<std::pair<TrackerTime, TrackerTime>>
SessionRecord::sample_span(const TrialRecord& trial) const {
    return reading_session(file_, [&]() -> std::optional<std::pair<TrackerTime, TrackerTime>> {
        Query row(database(), "SELECT COUNT(*), COALESCE(MIN(tracker_us), 0), COALESCE(MAX(tracker_us), 0) "
                              "FROM sample WHERE trial_id = ?");
        row.bind(1, trial.id);
        if (!row.step() || row.integer() == 0)
            return std::nullopt;
        const TrackerTime first = row.tracker_time();
        return std::pair{first, row.tracker_time()};
    });
}

SessionRecord::Eyes SessionRecord::eyes(int sitting) const {
    return reading_session(file_, [&] {
        Query row(
            database(),
            "SELECT COALESCE(MAX(eye = 0), 0), COALESCE(MAX(eye <> 0), 0) FROM sample WHERE ABS(trial_id) "
            "IN (SELECT trial_id FROM trial WHERE sitting = ?)");
        row.bind(1, sitting);
        row.step();
        Eyes eyes;
        row.read(eyes.left, eyes.right);
        return eyes;
    });
}

std::optional<RecordedAnswer> SessionRecord::answer_recording(const TrialRecord& trial) const {
    return reading_session(file_, [&] {
        const std::vector<RecordedAnswer> answers = read_later_rows(
            database(), "answer_recording",
            "SELECT file, sha256, device, sample_rate_hz, measured_rate_hz, bits, input_latency_ns, samples, "
            "onset_sample, onset_uncertainty_ns, overruns, lost_samples, peak_dbfs, noise_dbfs, "
            "clipped_samples, fault, voice_onset_ns, voice_end_ns FROM answer_recording WHERE trial_id = ?",
            [&](Query& row) { return read_answer(row, trial.trial.index); }, trial.id);
        return answers.empty() ? std::nullopt : std::optional(answers.front());
    });
}

std::optional<KnownInterval> SessionRecord::refresh_interval(int sitting) const {
    const auto known = intervals_.find(sitting);
    if (known != intervals_.end())
        return known->second;
    std::vector<RefreshFit> lines;
    for (const TrialRecord& trial : trials_) {
        if (trial.sitting != sitting)
            continue;
        if (const std::vector<FlipRecord> rows = flips(trial); rows.size() >= 3)
            lines.push_back(LedgerFit(rows, header_.display.refresh_hz).line());
    }
    return intervals_[sitting] = common_interval(lines);
}

std::optional<TrialLedger> SessionRecord::ledger(const TrialRecord& trial) const {
    std::vector<FlipRecord> recorded = flips(trial);
    if (recorded.empty())
        return std::nullopt;
    LedgerFit fit(recorded, header_.display.refresh_hz, refresh_interval(trial.sitting));
    return TrialLedger{std::move(recorded), std::move(fit)};
}

namespace {

/// What a step was to show of a stimulus that moves so, in `lasted` refreshes as it went.
PageCycle planned_in(const AttemptStep& step, PageCycle motion, int lasted) {
    // What a key, an answer or gaze ended was over by the plan then.
    const bool ended_early = step.ended_by == StepEnd::gaze || step.ended_by == StepEnd::key ||
                             step.ended_by == StepEnd::answer || step.ended_by == StepEnd::patience;
    return cut_to(std::move(motion), ended_early ? std::optional(lasted) : step.planned_refreshes,
                  step.still_frame ? std::optional(AnimationFrameIndex{*step.still_frame}) : std::nullopt);
}

/// The plan of what the observer turns is what it was turned to: that of a refresh that was missed comes with
/// the next flip.
PageCycle as_turned(std::span<const FlipRecord> flips, int total_refreshes) {
    PageCycle plan;
    plan.total_refreshes = total_refreshes;
    const int first = flips.front().refresh_in_trial;
    for (const FlipRecord& flip : flips) {
        if (plan.entries.empty() || plan.entries.back().frame != flip.shown)
            plan.entries.push_back({flip.shown, flip.pose, 1});
        plan.entry_of_refresh.resize(static_cast<std::size_t>(flip.refresh_in_trial - first) + 1,
                                     static_cast<std::uint16_t>(plan.entries.size() - 1));
    }
    plan.entry_of_refresh.resize(
        std::max(plan.entry_of_refresh.size(), static_cast<std::size_t>(std::max(total_refreshes, 1))),
        static_cast<std::uint16_t>(plan.entries.size() - 1));
    return plan;
}

/// The step that flips of this number are of. Those of earlier programs are of the only one that shows.
const AttemptStep* step_of(const std::vector<AttemptStep>& steps, int number) {
    if (number > 0)
        return static_cast<std::size_t>(number) <= steps.size() ? &steps[static_cast<std::size_t>(number) - 1]
                                                                : nullptr;
    const auto show = std::ranges::find(steps, "show", &AttemptStep::kind);
    return show == steps.end() ? nullptr : &*show;
}

} // namespace

std::vector<RecordedShow> shows_of(const SessionHeader& header, const TrialRecord& trial,
                                   std::span<const FlipRecord> flips) {
    std::vector<RecordedShow> shows;
    for (std::size_t begin = 0, end = 0; begin < flips.size(); begin = end) {
        while (end < flips.size() && flips[end].step == flips[begin].step)
            ++end;
        RecordedShow show{begin, end, flips[begin].refresh_in_trial, true,
                          header.page_cycle_of(trial.trial.stimulus)};
        if (const AttemptStep* const step = step_of(trial.outcome.steps, flips[begin].step)) {
            show.is_lit = step->lights(trial.place);
            show.plan = planned_in(*step, std::move(show.plan),
                                   flips[end - 1].refresh_in_trial - show.first_refresh + 1);
            if (!header.animation_of(trial.trial.stimulus).has_plan())
                show.plan = as_turned(flips.subspan(begin, end - begin), show.plan.total_refreshes);
        } else { // of an attempt that was cut off
            show.is_lit = std::ranges::any_of(flips.subspan(begin, end - begin),
                                              [](const FlipRecord& flip) { return flip.shown != no_frame; });
        }
        shows.push_back(std::move(show));
    }
    return shows;
}

FlipHistory SessionRecord::flip_history(const TrialRecord& trial,
                                        const std::optional<TrialLedger>& ledger) const {
    const RecordedDisplay& display = header_.display;
    // Of an imported session not even the refresh rate may be known.
    if (!ledger)
        return FlipHistory({}, {{}, 1.0, 1.0}, {});
    const std::span<const FlipRecord> flips = ledger->fit.flips();
    std::vector<FlipHistory::Show> lit;
    for (RecordedShow& show : shows_of(header_, trial, flips))
        if (show.is_lit)
            lit.push_back({flips.subspan(show.begin, show.end - show.begin), std::move(show.plan)});
    return FlipHistory(
        lit, {display.latency, display.refresh_hz, static_cast<double>(display.screen.screen_px.y)});
}

} // namespace overt
