#include "experiment/record/read/timing_report.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "experiment/ports/event_kinds.h"
#include "experiment/record/read/sample_join.h"
#include "experiment/record/read/session_faults.h"

namespace overt {

namespace {

constexpr double ms(SessionDuration duration) { return 1e3 * to_seconds(duration); }

/// Refreshes of a show's plan that have a row, a flip or a named miss.
int rows_within(const LedgerFit& fit, const RecordedShow& show, int& flipped) {
    const int planned = show.plan.total_refreshes;
    std::vector<bool> has_row(static_cast<std::size_t>(planned));
    const auto note = [&](int refresh) {
        const int in_show = refresh - show.first_refresh;
        if (in_show >= 0 && in_show < planned)
            has_row[static_cast<std::size_t>(in_show)] = true;
    };
    for (std::size_t i = show.begin; i < show.end; ++i) {
        note(fit.flips()[i].refresh_in_trial);
        flipped += fit.flips()[i].refresh_in_trial - show.first_refresh < planned;
    }
    for (const MissedRun& run : fit.missed_runs())
        for (int i = 0; i < run.count; ++i)
            note(run.refresh_in_trial + i);
    return static_cast<int>(std::count(has_row.begin(), has_row.end(), true));
}

void take_ledger(TrialTiming& timing, const TrialLedger& ledger, std::span<const RecordedShow> shows) {
    const auto& [recorded, fit] = ledger;
    for (const RecordedShow& show : shows) {
        timing.planned_refreshes += show.plan.total_refreshes;
        timing.unaccounted += show.plan.total_refreshes - rows_within(fit, show, timing.flipped_refreshes);
    }
    timing.missed_runs = fit.missed_runs();
    for (const MissedRun& run : timing.missed_runs)
        timing.missed_refreshes += run.count;
    for (std::size_t i = 0; i < fit.times().size(); ++i)
        if (!fit.times()[i].is_consistent)
            timing.wrong_stamps.push_back(fit.flips()[i].refresh_in_trial);
    for (std::size_t i = 1; i < recorded.size(); ++i)
        if (recorded[i].step == recorded[i - 1].step)
            timing.intervals_ms.push_back(
                ms(recorded[i].report.vertical_blank - recorded[i - 1].report.vertical_blank));
    for (const double interval : timing.intervals_ms)
        timing.longest_gap_ms = std::max(timing.longest_gap_ms, interval);
    const RefreshFit& line = fit.line();
    const MappedTime onset = line.begin_of(line.refresh_of(0));
    timing.onset_deviation_ms = ms(recorded.front().report.vertical_blank - onset.time);
    timing.onset_uncertainty_ms = ms(onset.uncertainty);
    timing.stamp_sd_ms = 1e-6 * line.jitter_sd_ns();
    timing.interval_ms = 1e-6 * line.interval().ns;
    timing.interval_uncertainty_ms = 1e-6 * line.interval().uncertainty_ns;
}

void take_samples(TrialTiming& timing, const SessionRecord& record, const TrialRecord& trial,
                  const std::optional<TrialLedger>& ledger) {
    const std::vector<GazeSample> samples = record.samples(trial);
    std::vector<JoinedSample> joined(samples.size());
    SampleJoin(record, trial, ledger, nullptr).join(samples, joined);
    timing.samples = static_cast<int>(samples.size());
    for (const JoinedSample& sample : joined) {
        timing.samples_on_frame += sample.shown.has_value();
        timing.samples_off_plan += sample.off_plan;
    }
}

void add_to_session(TimingReport& report, const TrialTiming& trial) {
    report.planned_refreshes += trial.planned_refreshes;
    report.flipped_refreshes += trial.flipped_refreshes;
    report.missed_refreshes += trial.missed_refreshes;
    report.unaccounted += trial.unaccounted;
    for (const MissedRun& run : trial.missed_runs)
        report.missed_by_cause[static_cast<int>(run.cause)] += run.count;
    report.longest_gap_ms = std::max(report.longest_gap_ms, trial.longest_gap_ms);
    report.wrong_stamps += static_cast<int>(trial.wrong_stamps.size());
    report.samples += trial.samples;
    report.samples_on_frame += trial.samples_on_frame;
    report.samples_off_plan += trial.samples_off_plan;
}

/// What can only be said of all completed trials together.
void sum_up(TimingReport& report) {
    double onset_squares = 0.0, stamp_squares = 0.0, weights = 0.0, weighted = 0.0;
    int count = 0;
    for (const TrialTiming& trial : report.trials) {
        if (!trial.counts)
            continue;
        add_to_session(report, trial);
        onset_squares += trial.onset_deviation_ms * trial.onset_deviation_ms;
        stamp_squares += trial.stamp_sd_ms * trial.stamp_sd_ms;
        const double weight = 1.0 / (trial.interval_uncertainty_ms * trial.interval_uncertainty_ms);
        weights += weight;
        weighted += weight * trial.interval_ms;
        ++count;
    }
    if (count == 0)
        return;
    report.onset_jitter_ms = std::sqrt(onset_squares / count);
    report.stamp_sd_ms = std::sqrt(stamp_squares / count);
    report.interval_ms = weighted / weights;
    report.interval_uncertainty_ms = std::sqrt(1.0 / weights);
}

} // namespace

TimingReport timing_report(const SessionRecord& record) {
    TimingReport report;
    const SessionHeader& header = record.header();
    // Imported sessions have no flips, and may not know their display's rate.
    report.nominal_interval_ms = header.display.refresh_hz > 0.0 ? 1e3 / header.display.refresh_hz : 0.0;
    report.is_virtual = header.clock == ClockKind::virtual_time;
    report.is_unproven = header.is_timing_unproven();
    report.has_simulated_faults = simulated_sides(record).display;
    std::multimap<int, std::string> disturbances;
    for (const RecordedEvent& event : record.events()) {
        if (event.trial >= 0 && (event.kind == machine_slept_event || event.kind == wall_clock_set_event))
            disturbances.emplace(event.trial, event.kind + ": " + event.detail);
    }
    for (const TrialRecord& trial : record.trials()) {
        const std::optional<TrialLedger> ledger = record.ledger(trial);
        if (!ledger)
            continue;
        TrialTiming timing;
        timing.trial = trial.trial;
        timing.attempt = trial.attempt;
        timing.status = trial.status;
        timing.counts = trial.counts;
        take_ledger(timing, *ledger, shows_of(header, trial, ledger->fit.flips()));
        take_samples(timing, record, trial, ledger);
        for (auto [one, end] = disturbances.equal_range(trial.trial.index); one != end; ++one)
            timing.disturbances.push_back(one->second);
        for (const FlipRecord& flip : ledger->recorded) {
            const std::string source{name_of(flip.report.source)};
            if (std::find(report.sources.begin(), report.sources.end(), source) == report.sources.end())
                report.sources.push_back(source);
        }
        report.trials.push_back(std::move(timing));
    }
    sum_up(report);
    return report;
}

std::vector<IntervalBin> interval_histogram(const TimingReport& report, int longest) {
    constexpr int per_interval = 8;
    const double width = report.nominal_interval_ms / per_interval;
    std::map<int, int> counts;
    for (const TrialTiming& trial : report.trials) {
        if (!trial.counts)
            continue;
        for (const double interval : trial.intervals_ms)
            ++counts[static_cast<int>(
                std::lround(std::clamp(interval / width, 0.0, static_cast<double>(per_interval * longest))))];
    }
    std::vector<IntervalBin> bins;
    if (counts.empty())
        return bins;
    for (int bin = counts.begin()->first; bin <= counts.rbegin()->first; ++bin) {
        const auto found = counts.find(bin);
        bins.push_back({std::max(bin - 0.5, 0.0) * width, (bin + 0.5) * width,
                        found == counts.end() ? 0 : found->second});
    }
    return bins;
}

} // namespace overt
