/// Where trials come from, as a protocol states it: a rule, or a file. Explained key by key in
/// trials_keys.cpp.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiment/design/rules/trial_rules.h"

namespace overt {

/// `trials` of a task or of catch trials: neither a file nor a rule, every stimulus.
struct TrialsSettings {
    int table = -1; ///< index into the protocol's trial tables; -1: it is none
    std::optional<TrialRuleKind> rule;
    // Names of factors: lists of the protocol, and columns of their entries.
    std::vector<std::string> of, same, differs, any;
    SideRule side = SideRule::drawn;
    std::optional<int> draw;
    DrawnFor per = DrawnFor::observer;
    bool ordered = false, identical = false;
    std::vector<std::string> standard, target, distractors; ///< levels
    int size = 0;
    std::vector<double> set_sizes;
    double absent = 0.5;
    // Ids of slots.
    std::string in, sample;
    std::vector<std::string> among;
    int length = 0, back = 1;
    double repeats = 0.25;
    std::optional<double> lures;
    std::vector<std::string> procedures; ///< ids of [[procedure]]s that choose the trials' levels

    bool has_own_trials() const { return rule.has_value() || table >= 0; }
};

/// `catch` of a task: trials that check the observer, mixed in among the task's in each block.
struct CatchSettings {
    std::filesystem::path trials_file; ///< a table, resolved against the protocol's folder; empty: none
    int table = -1;                    ///< index into the protocol's trial tables
    std::optional<double> share;       ///< of all trials of the task in a block
    std::optional<int> count;          ///< in a block, instead
};

/// `draw` of a block: a list of entries drawn for it, of which its trials are made.
struct DrawSettings {
    std::string of; ///< name of a list of the protocol; empty: nothing is drawn
    std::optional<int> count;
    std::string from;               ///< id of a block with a draw of its own: what it drew is old here
    std::optional<int> old_entries; ///< of those that `from` drew; left out: all
    std::optional<int> new_entries; ///< of all others; left out: all
    DrawnFor per = DrawnFor::observer;

    bool is_written() const { return !of.empty(); }
};

} // namespace overt
