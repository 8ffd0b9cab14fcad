#include "experiment/record/write/probe_rows.h"

#include "experiment/record/sql.h"

namespace overt {

namespace {

std::optional<double> slant_of(const std::optional<Attitude>& attitude) {
    return attitude ? std::optional(attitude->slant.value) : std::nullopt;
}
std::optional<double> tilt_of(const std::optional<Attitude>& attitude) {
    return attitude ? std::optional(attitude->tilt.value) : std::nullopt;
}

} // namespace

void write_probe_rows(SQLite::Database& database, std::int64_t trial_id, const TrialOutcome& outcome) {
    int n = 0;
    for (const ShownProbe& probe : outcome.probes)
        insert_values(database,
                      "INTO shown_probe (trial_id, n, step, id, point, place, shown_refreshes, "
                      "visible_refreshes, was_visible, x_px, y_px, slant_deg, tilt_deg)",
                      trial_id, ++n, probe.step, probe.id, probe.point, probe.place, probe.shown_refreshes,
                      probe.visible_refreshes, probe.was_visible, probe.at.x_px, probe.at.y_px,
                      probe.truth.slant, probe.truth.tilt);
    n = 0;
    for (const GivenAnswer& given : outcome.given) {
        ++n;
        if (const std::optional<GaugeAnswer>& gauge = given.gauge)
            insert_values(database,
                          "INTO gauge_setting (trial_id, n, probe, point, start_slant_deg, start_tilt_deg, "
                          "slant_deg, tilt_deg, at_limit, true_slant_deg, true_tilt_deg, frame, is_visible)",
                          trial_id, n, gauge->probe, gauge->point, gauge->start.slant, gauge->start.tilt,
                          gauge->set.slant, gauge->set.tilt, gauge->is_at_limit, slant_of(gauge->truth),
                          tilt_of(gauge->truth), gauge->frame, gauge->is_visible);
    }
    n = 0;
    for (const AnswerInput& input : outcome.inputs) {
        ++n;
        if (input.attitude)
            insert_values(database, "INTO gauge_change (trial_id, n, slant_deg, tilt_deg)", trial_id, n,
                          input.attitude->slant, input.attitude->tilt);
    }
}

} // namespace overt
