/// A map's check as figures with the targets of this program.
#pragma once

#include "app/cli/figures.h"
#include "experiment/maps/map_check.h"

namespace overt {

/// `name` of the object stands in front of each figure. The targets of coverage are for 1024 x 1024 pixels
/// and grow with a larger image's area.
BenchFigures figures_of(const MapCheck& check, glm::ivec2 image_px, const std::string& name);

} // namespace overt
