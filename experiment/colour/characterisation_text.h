/// A characterisation as the files that people and programs read.
#pragma once

#include <span>
#include <string>

#include "experiment/colour/characterisation_fit.h"

namespace overt {

/// The characterisation file, with its curves in it: what read_characterisation() reads back as it is.
/// Spectra are not written.
std::string characterisation_toml(const DisplayCharacterisation& display);

/// level_r,level_g,level_b,X,Y,Z, a line for each reading in the order given.
std::string readings_csv(std::span<const PatchReading> readings);

/// For a terminal: light, curves, and what validation found.
std::string characterisation_report(const DisplayCharacterisation& display, const CharacterisationFit& fit,
                                    const CharacterisationCheck& check);

/// Lines on white, black, contrast and chromaticities.
std::vector<std::string> light_lines(const DisplayCharacterisation& display);

} // namespace overt
