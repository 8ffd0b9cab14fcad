/// The files of a TSV export and what stands in each column: their first lines and their dictionary both come
/// from here.
#pragma once

#include <string>

#include "experiment/record/session_header.h"
#include "experiment/record/tsv_writer.h"

namespace overt {

/// All tables of one session's export. Levels name the session's own tasks, sculptures and materials.
struct TsvTables {
    explicit TsvTables(const SessionHeader& header);

    TsvTable trials, flips, samples, events, responses, stimuli;
};

/// The dictionary as JSON: for each file its description and, column by column, Description, Units and Levels
/// as in BIDS side cars.
std::string tsv_dictionary(const TsvTables& tables);

} // namespace overt
