/// Attempts at trials, and their answers, as tables.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "experiment/record/read/session_record.h"
#include "experiment/record/tables/sample_rows.h"
#include "experiment/record/tables/shared_columns.h"

namespace overt {

struct TrialRow {
    const TrialRecord& trial;
    const SampleCounts* samples; ///< null: of an attempt that does not count
    operator const TrialRecord&() const { return trial; }
};

/// `header` must outlive it, as the next.
RowLayout<TrialRow> trials_layout(const SharedColumns& shared, const SessionHeader& header);
/// With the same columns and the slot: of presentations (TrialRecord::seen_in).
RowLayout<TrialRow> presentations_layout(const SharedColumns& shared, const SessionHeader& header);

/// What the messages TRIALID of an imported recording say of each attempt, word by word; empty for others.
using TrialWords = std::map<std::int64_t, std::vector<std::string>>;
TrialWords trial_words(const SessionRecord& record);

/// A column trialid_N for each of the words. `words` must outlive it.
std::vector<RowLayout<TrialRow>::Column> trial_word_columns(const TrialWords& words);

/// Of attempts that count.
RowLayout<TrialRecord> responses_layout(const SharedColumns& shared, const SessionHeader& header);

} // namespace overt
