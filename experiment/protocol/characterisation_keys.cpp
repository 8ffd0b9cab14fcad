#include "experiment/protocol/characterisation_keys.h"

namespace overt::characterisation_keys {

namespace {

std::vector<Key> display() {
    using D = DisplayKeys;
    return {{{.name = "name", .explanation = "Which display it is."}, &D::name},
            {{.name = "date", .explanation = "When it was measured, as a text."}, &D::date},
            {{.name = "instrument", .explanation = "What it was measured with."}, &D::instrument},
            {{.name = "note", .explanation = "What else is to be known."}, &D::note}};
}

std::vector<Key> screen() {
    using S = MeasuredScreen;
    return {{{.name = "width_px", .unit = "px", .low = 16, .high = 16384, .explanation = "Pixels in a row."},
             &S::width_px},
            {{.name = "height_px", .unit = "px", .low = 16, .high = 16384, .explanation = "Rows."},
             &S::height_px},
            {{.name = "refresh_hz",
              .unit = "Hz",
              .low = 1,
              .high = 1000,
              .explanation = "Refresh rate; light may depend on it."},
             &S::refresh_hz},
            {{.name = "width_mm",
              .unit = "mm",
              .low = 10,
              .high = 20000,
              .explanation = "Width of the lit area."},
             &S::width_mm},
            {{.name = "height_mm",
              .unit = "mm",
              .low = 10,
              .high = 20000,
              .explanation = "Height of the lit area."},
             &S::height_mm},
            {{.name = "viewing_distance_mm",
              .unit = "mm",
              .low = 50,
              .high = 50000,
              .explanation = "From where it was measured."},
             &S::viewing_distance_mm}};
}

std::vector<Key> light() {
    using L = LightKeys;
    const auto xyz = [](std::string_view name, std::string_view explanation) {
        return KeyRule{.name = name, .unit = "cd/m2", .low = 0, .high = 1e5, .explanation = explanation};
    };
    return {{xyz("black", "XYZ at signal 0."), &L::black},
            {xyz("red", "XYZ of red alone at full signal, black included."), &L::red},
            {xyz("green", "The same of green."), &L::green},
            {xyz("blue", "The same of blue."), &L::blue},
            {xyz("white", "The same of all three together, to be compared with their sum."), &L::white},
            {{.name = "spectra", .explanation = "Table of the channels' radiance, instead of XYZ."},
             &L::spectra}};
}

std::vector<Key> gamma() {
    using G = GammaKeys;
    return {
        {{.name = "table", .explanation = "Table of light at signals of 0 … 1."}, &G::table},
        {{.name = "signal", .low = 0, .high = 1, .explanation = "Signals, instead of a table."}, &G::signal},
        {{.name = "red", .low = 0, .explanation = "Light of red at these signals."}, &G::red},
        {{.name = "green", .low = 0, .explanation = "The same of green."}, &G::green},
        {{.name = "blue", .low = 0, .explanation = "The same of blue."}, &G::blue},
        {{.name = "exponent",
          .low = 0.1,
          .high = 10,
          .explanation = "Of a power function, for all channels or for each."},
         &G::exponent},
        {{.name = "offset", .low = -0.9, .high = 0.9, .explanation = "Its offset, likewise."}, &G::offset},
        {{.name = "interpolation_exponent",
          .low = 0.1,
          .high = 10,
          .explanation = "Between points light^(1 / this) is interpolated; left out, the exponent of the "
                         "power that the points lie nearest to."},
         &G::interpolation_exponent}};
}

} // namespace

const KeyTable& table() {
    static const KeyTable all({{.name = "display", .keys = display(), .home = &FileKeys::display},
                               {.name = "screen", .keys = screen(), .home = &FileKeys::screen},
                               {.name = "light", .keys = light(), .home = &FileKeys::light},
                               {.name = "gamma", .keys = gamma(), .home = &FileKeys::gamma}});
    return all;
}

} // namespace overt::characterisation_keys
