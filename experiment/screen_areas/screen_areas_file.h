/// Files of areas of the screen: what `--areas` takes.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "experiment/base/diagnostics.h"
#include "experiment/screen_areas/screen_area.h"

namespace overt {

/// An area, and the trials that have it.
struct ChosenScreenArea {
    ScreenArea area;
    /// Columns of the table of trials and the words that stand there; empty: all trials have it.
    std::vector<std::pair<std::string, std::string>> trials;
};

/// Reads an EyeLink file of interest areas (.ias), whose areas all trials have, or a table with commas under
/// a line of names: area, shape (rectangle, ellipse or polygon), left_px, top_px, right_px, bottom_px or, of
/// polygons, corners_px ("x y x y ..."), and if wanted from_s and until_s. Any other is a column of the table
/// of trials, and the area is of those trials in which the same stands there (an empty cell: of any). A cell
/// may stand in double quotes, without commas in it. Findings go to `diagnostics` with their places.
std::vector<ChosenScreenArea> read_screen_areas(const std::filesystem::path& file, Diagnostics& diagnostics);

} // namespace overt
