/// The tables of a planned study's power.
#pragma once

#include <filesystem>
#include <string>

#include "experiment/power/power_results.h"
#include "experiment/record/tables/table_writer.h"

namespace overt {

/// All but the single studies, and the answers in words.
std::string power_json(const PowerResults& results);

/// Writes power_curve (a row for each effect and number of observers) and power_studies (each simulated
/// study), dictionary.json and power.json into a folder that is there. Throws RecordError.
void write_power_tables(const PowerResults& results, const std::filesystem::path& folder, TableFormat format);

/// Whether write_power_tables() writes a file of this name.
bool is_power_table(const std::string& file);

} // namespace overt
