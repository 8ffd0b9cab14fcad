#include "experiment/record/read/probe_records.h"

#include <algorithm>

#include "experiment/record/sql.h"

namespace overt {

namespace {

/// The n-th of an attempt's answers or inputs, from 1; null if there is none.
template <class Row>
Row* row_of_attempt(std::vector<TrialRecord>& trials, std::vector<Row> TrialOutcome::*rows,
                    std::int64_t attempt, int n) {
    const auto trial = std::ranges::find(trials, attempt, &TrialRecord::id);
    if (trial == trials.end() || n < 1 || static_cast<std::size_t>(n) > (trial->outcome.*rows).size())
        return nullptr;
    return &(trial->outcome.*rows)[static_cast<std::size_t>(n) - 1];
}

std::optional<Attitude> attitude_if(std::optional<double> slant, std::optional<double> tilt) {
    return slant && tilt ? std::optional(Attitude{{*slant}, {*tilt}}) : std::nullopt;
}

void add_gauges(const SQLite::Database& database, std::vector<TrialRecord>& trials) {
    for (Query row(database, "SELECT trial_id, n, probe, point, start_slant_deg, start_tilt_deg, slant_deg, "
                             "tilt_deg, at_limit, true_slant_deg, true_tilt_deg, frame, is_visible "
                             "FROM gauge_setting");
         row.step();) {
        const std::int64_t attempt = row.integer();
        const int n = row.small();
        GaugeAnswer gauge;
        std::optional<double> slant, tilt;
        row.read(gauge.probe, gauge.point, gauge.start.slant.value, gauge.start.tilt.value,
                 gauge.set.slant.value, gauge.set.tilt.value, gauge.is_at_limit, slant, tilt, gauge.frame,
                 gauge.is_visible);
        gauge.truth = attitude_if(slant, tilt);
        if (GivenAnswer* const given = row_of_attempt(trials, &TrialOutcome::given, attempt, n))
            given->gauge = std::move(gauge);
    }
    for (Query row(database, "SELECT trial_id, n, slant_deg, tilt_deg FROM gauge_change"); row.step();) {
        const std::int64_t attempt = row.integer();
        const int n = row.small();
        Attitude attitude;
        row.read(attitude.slant.value, attitude.tilt.value);
        if (AnswerInput* const input = row_of_attempt(trials, &TrialOutcome::inputs, attempt, n))
            input->attitude = attitude;
    }
}

} // namespace

void add_probes(const SQLite::Database& database, std::vector<TrialRecord>& trials) {
    if (!has_table(database, "shown_probe"))
        return;
    for (Query row(database, "SELECT trial_id, step, id, point, place, shown_refreshes, visible_refreshes, "
                             "was_visible, x_px, y_px, slant_deg, tilt_deg FROM shown_probe "
                             "ORDER BY trial_id, n");
         row.step();) {
        const auto trial = std::ranges::find(trials, row.integer(), &TrialRecord::id);
        ShownProbe probe;
        row.read(probe.step, probe.id, probe.point, probe.place, probe.shown_refreshes,
                 probe.visible_refreshes, probe.was_visible, probe.at.x_px, probe.at.y_px,
                 probe.truth.slant.value, probe.truth.tilt.value);
        if (trial != trials.end())
            trial->outcome.probes.push_back(std::move(probe));
    }
    add_gauges(database, trials);
}

} // namespace overt
