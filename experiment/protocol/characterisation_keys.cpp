#include "experiment/protocol/characterisation_keys.h"

namespace overt::characterisation_keys {

const Rows<DisplayKeys>& display() {
    using D = DisplayKeys;
    static const Rows<D> rows{
        {{.name = "name", .explanation = "Which display it is."}, &D::name},
        {{.name = "date", .explanation = "When it was measured, as a text."}, &D::date},
        {{.name = "instrument", .explanation = "What it was measured with."}, &D::instrument},
        {{.name = "note", .explanation = "What else is to be known."}, &D::note}};
    return rows;
}

const Rows<MeasuredScreen>& screen() {
    using S = MeasuredScreen;
    static const Rows<S> rows{
        {{.name = "width_px", .unit = "px", .low = 16, .high = 16384, .explanation = "Pixels in a row."},
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
    return rows;
}

const Rows<LightKeys>& light() {
    using L = LightKeys;
    static const auto xyz = [](std::string_view name, std::string_view explanation) {
        return KeyRule{.name = name, .unit = "cd/m2", .low = 0, .high = 1e5, .explanation = explanation};
    };
    static const Rows<L> rows{
        {xyz("black", "XYZ at signal 0."), &L::black},
        {xyz("red", "XYZ of red alone at full signal, black included."), &L::red},
        {xyz("green", "The same of green."), &L::green},
        {xyz("blue", "The same of blue."), &L::blue},
        {xyz("white", "The same of all three together, to be compared with their sum."), &L::white},
        {{.name = "spectra", .explanation = "Table of the channels' radiance, instead of XYZ."},
         &L::spectra}};
    return rows;
}

const Rows<GammaKeys>& gamma() {
    using G = GammaKeys;
    static const Rows<G> rows{
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
    return rows;
}

const TomlValue* Reading::value(std::string_view section, std::string_view key) const {
    for (const TomlEntry& entry : toml.root) {
        if (entry.key != section || !entry.value.table())
            continue;
        for (const TomlEntry& inner : *entry.value.table()) {
            if (inner.key == key)
                return &inner.value;
        }
    }
    return nullptr;
}

void check_sections(Reading& reading) {
    for (const TomlEntry& entry : reading.toml.root) {
        if (std::find(std::begin(sections), std::end(sections), entry.key) != std::end(sections))
            continue;
        const bool is_key = !entry.value.table() && !entry.value.list();
        reading.diagnostics.error(reading.file, entry.key_place,
                                  is_key ? fmt::format("key \"{}\" stands outside all sections", entry.key)
                                         : fmt::format("unknown section [{}]", entry.key),
                                  suggest_name(entry.key, sections));
    }
}

} // namespace overt::characterisation_keys
