/// Warnings about a spoken answer, for the operator.
#pragma once

#include <string>
#include <vector>

#include "experiment/ports/recorded_answer.h"

namespace overt {

/// A sentence for each: clipped, silent, samples lost, broken off. Empty: all is well.
std::vector<std::string> warnings_about(const RecordedAnswer& answer);

} // namespace overt
