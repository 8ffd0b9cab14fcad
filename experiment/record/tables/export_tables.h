/// The files of a table export and what stands in each column: their first lines and their dictionary both
/// come from here, whatever their format.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "experiment/record/session_header.h"
#include "experiment/record/tables/table_writer.h"
#include "experiment/units.h"

namespace overt {

/// All tables of one session's export. Levels name the session's own tasks, sculptures and materials.
struct ExportTables {
    /// With the columns of a gaze cone if its accuracy is given.
    explicit ExportTables(const SessionHeader& header, std::optional<Degrees> cone_accuracy = {});

    /// The parts of all sculptures, each name once: a cone has a column for each, after p_object.
    std::vector<std::string> cone_parts;

    Table trials, flips, samples, gaze_events, events, responses, stimuli, display_box;

    std::vector<const Table*> all() const;
};

/// Columns of samples: by the session's clock, and how far that can be off.
std::vector<TableColumn> time_columns();

/// Columns of samples: the frame that was lit, the place in the image and on the surface.
std::vector<TableColumn> place_columns(const SessionHeader& header);

/// Of each column Description, Units and Levels, as in BIDS side cars.
nlohmann::ordered_json describe_columns(const std::vector<TableColumn>& columns, TableFormat format);

/// As it is written to a file: indented, always valid UTF-8, with a newline at its end.
std::string json_text(const nlohmann::ordered_json& json);

/// The dictionary as JSON: for each file its description and its columns (see describe_columns).
std::string table_dictionary(const ExportTables& tables, TableFormat format);

} // namespace overt
