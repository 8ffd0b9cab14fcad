/// What an imported recording's own messages say of each trial, as columns of the table of trials.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "experiment/record/tables/trial_tables.h"

namespace overt {

/// By attempt; attempts whose gaze was not imported have nothing.
struct TrialMessages {
    std::map<std::int64_t, std::vector<std::string>> words; ///< after TRIALID
    /// Of messages "!V TRIAL_VAR name value"; of several with one name the last counts.
    std::map<std::int64_t, std::map<std::string, std::string>> variables;
    std::vector<std::string> names; ///< of variables, in the order of their first messages
    bool empty() const { return words.empty() && variables.empty(); }
};
TrialMessages trial_messages(const SessionRecord& record);

/// A column trialid_N for each of the words, and var_NAME for each variable, with _ for what is no letter,
/// digit or _ in its name. `messages` must outlive it.
std::vector<RowLayout<TrialRow>::Column> imported_trial_columns(const TrialMessages& messages);

} // namespace overt
