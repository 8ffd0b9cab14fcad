/// Trials as a table lists them: a file of rows, each a trial.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiment/keys/delimited_text.h"
#include "experiment/trial.h"

namespace overt {

struct Protocol;

struct TrialTableRow {
    std::vector<PlacedStimulus> shown; ///< in the task's order of slots; at least one
    std::vector<TrialLevel> levels;    ///< of the columns that are factors, in the table's order
    std::string correct;               ///< empty: none
    int block = -1;                    ///< index into the protocol's blocks; -1: any that asks the task
    int repeat = 1;                    ///< how often it comes
};

/// Empty where the row has none.
std::string_view level_in(const TrialTableRow& row, std::string_view factor);

struct TrialTable {
    std::string file;                 ///< as the protocol names it
    std::vector<std::string> factors; ///< the columns that are
    std::vector<TrialTableRow> rows;
};

/// Makes trials of a table's rows. Columns are lists of the protocol ("object", for all slots), slots
/// ("left", with ids as "vase/gloss-0.1", in the order of the lists), a list in a slot ("left.material"),
/// "correct", "block" and "repeat"; all others are factors, among them those that say how long a step of the
/// task lasts (seconds_column). `task` is an index. What is wrong goes to `diagnostics` under `file`, all of
/// it; the table is not sound then.
TrialTable trial_table_of(const DelimitedText& text, const Protocol& protocol, int task,
                          const std::string& file, Diagnostics& diagnostics);

} // namespace overt
