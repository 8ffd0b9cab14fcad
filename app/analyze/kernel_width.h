/// The width of a kernel as it is written on the command line.
#pragma once

#include <string>

#include "experiment/study/results/study_options.h"

namespace overt {

/// Of --sigma: "1deg", "30 mm", "1", which is in degrees. Throws InputError.
KernelWidth kernel_width(const std::string& text);

} // namespace overt
