/// Places on surfaces, the probes that stood there, and what was set with gauges, as tables.
#pragma once

#include "experiment/record/read/session_record.h"
#include "experiment/record/tables/shared_columns.h"

namespace overt {

/// `header` must outlive them all.
RowLayout<RecordedPoint> points_layout(const SessionHeader& header);

/// A probe in one step of an attempt that ended.
struct ProbeRow {
    const TrialRecord& attempt;
    const ShownProbe& probe;
    operator const TrialRecord&() const { return attempt; }
};
RowLayout<ProbeRow> probes_layout(const SharedColumns& shared, const SessionHeader& header);

/// What was set with a gauge in an attempt that ended.
struct GaugeRow {
    const TrialRecord& attempt;
    const GivenAnswer& given;
    const GaugeAnswer& gauge;
    operator const TrialRecord&() const { return attempt; }
};
RowLayout<GaugeRow> gauges_layout(const SharedColumns& shared, const SessionHeader& header);

/// How a gauge was turned after an input.
struct GaugeChangeRow {
    const TrialRecord& attempt;
    int input; ///< which of the attempt's, from 1
    const AnswerInput& taken;
    operator const TrialRecord&() const { return attempt; }
};
RowLayout<GaugeChangeRow> gauge_changes_layout();

} // namespace overt
