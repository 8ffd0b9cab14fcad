/// A calibration in words and as a picture.
#pragma once

#include <filesystem>

#include "experiment/ports/recorded_calibration.h"
#include "experiment/screen_geometry.h"

namespace overt {

/// How it was made, its errors, and a line for each target, to standard output.
void print_calibration(const RecordedCalibration& calibration);

/// The screen with its targets and the gaze that was measured, as PNG. Throws InputError for a calibration
/// that tells no targets, RecordError.
void draw_validation(const RecordedCalibration& calibration, const ScreenGeometry& screen,
                     const std::filesystem::path& file);

} // namespace overt
