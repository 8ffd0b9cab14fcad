#include "experiment/protocol/characterisation_keys.h"

namespace overt::characterisation_keys {

namespace {

std::vector<Key> display() {
    using D = DisplayKeys;
    return {{"name", &D::name, "Which display it is."},
            {"date", &D::date, "When it was measured, as a text."},
            {"instrument", &D::instrument, "What it was measured with."},
            {"note", &D::note, "What else is to be known."}};
}

std::vector<Key> screen() {
    using S = MeasuredScreen;
    return {{"width_px", &S::width_px, range(16, 16384, "px"), "Pixels in a row."},
            {"height_px", &S::height_px, range(16, 16384, "px"), "Rows."},
            {"refresh_hz", &S::refresh_hz, range(1, 1000, "Hz"), "Refresh rate; light may depend on it."},
            {"width_mm", &S::width_mm, range(10, 20000, "mm"), "Width of the lit area."},
            {"height_mm", &S::height_mm, range(10, 20000, "mm"), "Height of the lit area."},
            {"viewing_distance_mm", &S::viewing_distance_mm, range(50, 50000, "mm"),
             "From where it was measured."}};
}

std::vector<Key> light() {
    using L = LightKeys;
    constexpr KeyLimits xyz = range(0, 1e5, "cd/m2");
    return {{"black", &L::black, xyz, "XYZ at signal 0."},
            {"red", &L::red, xyz, "XYZ of red alone at full signal, black included."},
            {"green", &L::green, xyz, "The same of green."},
            {"blue", &L::blue, xyz, "The same of blue."},
            {"white", &L::white, xyz, "The same of all three together, to be compared with their sum."},
            {"spectra", &L::spectra, "Table of the channels' radiance, instead of XYZ."}};
}

std::vector<Key> gamma() {
    using G = GammaKeys;
    return {{"table", &G::table, "Table of light at signals of 0 … 1."},
            {"signal", &G::signal, range(0, 1), "Signals, instead of a table."},
            {"red", &G::red, at_least(0), "Light of red at these signals."},
            {"green", &G::green, at_least(0), "The same of green."},
            {"blue", &G::blue, at_least(0), "The same of blue."},
            {"exponent", &G::exponent, range(0.1, 10), "Of a power function, for all channels or for each."},
            {"offset", &G::offset, range(-0.9, 0.9), "Its offset, likewise."},
            {"interpolation_exponent", &G::interpolation_exponent, range(0.1, 10),
             "Between points light^(1 / this) is interpolated; left out, the exponent of the power that the "
             "points lie nearest to."}};
}

} // namespace

const KeyTable& table() {
    static const KeyTable all({{"display", &FileKeys::display, display()},
                               {"screen", &FileKeys::screen, screen()},
                               {"light", &FileKeys::light, light()},
                               {"gamma", &FileKeys::gamma, gamma()}});
    return all;
}

} // namespace overt::characterisation_keys
