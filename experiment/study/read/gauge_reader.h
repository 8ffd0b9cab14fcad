/// Reads what was set with gauges.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiment/study/results/relief_rows.h"

namespace overt {

/// Of all trials that give results, in the order of the sessions and their attempts; what was missed is not
/// among them, nor what stood where the place was hidden or not known. `same_observer`: as in StudyOptions.
/// Throws RecordError.
std::vector<GaugeSettingRow>
read_gauge_settings(std::span<const std::filesystem::path> sessions,
                    std::span<const std::pair<std::string, std::string>> same_observer);

} // namespace overt
