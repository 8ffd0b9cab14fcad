/// The keys of a characterisation file. Only characterisation_file.cpp uses this.
#pragma once

#include "experiment/colour/display_characterisation.h"
#include "experiment/keys/key_table.h"

namespace overt::characterisation_keys {

/// [display]
struct DisplayKeys {
    std::string name, date, instrument, note;
};

/// [light]: as measured, the black of the display included.
struct LightKeys {
    std::optional<glm::dvec3> black, red, green, blue, white;
    std::filesystem::path spectra;
};

/// [gamma]
struct GammaKeys {
    std::filesystem::path table;
    std::vector<double> signal, red, green, blue;
    std::vector<double> exponent, offset, interpolation_exponent; ///< none, one, or one for each channel
};

/// What stands in a file.
struct FileKeys {
    DisplayKeys display;
    MeasuredScreen screen;
    LightKeys light;
    GammaKeys gamma;
};

/// Its structs lie in a FileKeys. Made once; safe from any thread.
const KeyTable& table();

} // namespace overt::characterisation_keys
