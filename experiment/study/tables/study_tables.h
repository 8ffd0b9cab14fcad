/// A study's results as tidy tables with a dictionary, and as one JSON file.
#pragma once

#include <filesystem>

#include "experiment/record/tables/table_writer.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// Writes the tables of study_layouts.h, dictionary.json, and study.json with the study at a glance, its
/// parameters and remarks, into a folder that exists. The same results give the same bytes. Throws
/// RecordError.
void write_study_tables(const StudyResults& results, const std::filesystem::path& folder, TableFormat format);

/// Whether a file's name is one that write_study_tables writes.
bool is_study_table(const std::string& file);

/// study.json: what happened, in numbers and sentences.
std::string study_json(const StudyResults& results);

} // namespace overt
