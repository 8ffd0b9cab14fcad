/// The files of a TSV export and what stands in each column: their first lines and their dictionary both come
/// from here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/record/session_header.h"
#include "experiment/record/tsv_writer.h"
#include "experiment/units.h"

namespace overt {

/// All tables of one session's export. Levels name the session's own tasks, sculptures and materials.
struct TsvTables {
    /// With the columns of a gaze cone if its accuracy is given.
    explicit TsvTables(const SessionHeader& header, std::optional<Degrees> cone_accuracy = {});

    /// The parts of all sculptures, each name once: a cone has a column for each, after p_object.
    std::vector<std::string> cone_parts;

    TsvTable trials, flips, samples, events, responses, stimuli, display_box;
};

/// The dictionary as JSON: for each file its description and, column by column, Description, Units and Levels
/// as in BIDS side cars.
std::string tsv_dictionary(const TsvTables& tables);

} // namespace overt
