/// What is known of a trial, column by column, as the exported tables have it.
#pragma once

#include <string>
#include <vector>

#include "experiment/record/read/session_record.h"
#include "experiment/record/tables/imported_trials.h"
#include "experiment/record/tables/trial_tables.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// Of one session; with several slots, of its presentations, each with its slot. Any column of the table of
/// trials can make groups, and whatever is added to that table joins by being there; so do observer and
/// session, the fields of the observer's form, and the words and variables of an imported recording's trials.
class TrialKeys {
  public:
    /// `record` must outlive it. Throws RecordError.
    explicit TrialKeys(const SessionRecord& record);

    std::vector<StudyKey> of(const TrialRecord& trial, const SampleCounts& samples) const;

  private:
    TrialMessages messages_;
    RowLayout<TrialRow> layout_;
    std::vector<StudyKey> of_session_;
};

} // namespace overt
