/// Reads how observers turned objects.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiment/study/results/exploration_rows.h"

namespace overt {

/// Of all trials that give results, in the order of the sessions and their attempts, each show of an object
/// that the observer turned; what turned as another observer had turned it is not among them.
/// `same_observer`: as in StudyOptions. Throws RecordError.
std::vector<ExplorationRow>
read_explorations(std::span<const std::filesystem::path> sessions,
                  std::span<const std::pair<std::string, std::string>> same_observer);

} // namespace overt
