/// A study as one page that opens offline in a browser.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "experiment/study/results/study_results.h"

namespace overt {

/// Most vertices of an object that the page shows; finer ones are simplified for it, and the page says so.
inline constexpr std::size_t most_report_vertices = 30000;

/// What the page shows, with arrays as base64: the data that its script (assets/report/report.js) reads.
nlohmann::ordered_json report_data(const StudyResults& results);

/// The page: template, style and script of assets/report, three.js, and the data.
std::string report_page(const StudyResults& results);

/// Writes the page. Throws RecordError.
void write_report(const StudyResults& results, const std::filesystem::path& file);

} // namespace overt
