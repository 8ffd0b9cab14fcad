/// The keys of a characterisation file, section by section, and the walk that reads them. Only
/// characterisation_file.cpp uses this.
#pragma once

#include <algorithm>

#include <fmt/format.h>

#include "experiment/colour/display_characterisation.h"
#include "experiment/protocol/value_reader.h"

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

template <class Struct>
using Member = std::variant<std::string Struct::*, std::filesystem::path Struct::*,
                            std::optional<int> Struct::*, std::optional<double> Struct::*,
                            std::optional<glm::dvec3> Struct::*, std::vector<double> Struct::*>;

template <class Struct> struct Row {
    KeyRule rule;
    Member<Struct> member;
};
template <class Struct> using Rows = std::vector<Row<Struct>>;

const Rows<DisplayKeys>& display();
const Rows<MeasuredScreen>& screen();
const Rows<LightKeys>& light();
const Rows<GammaKeys>& gamma();
inline constexpr std::string_view sections[] = {"display", "screen", "light", "gamma"};

/// A file while it is read.
struct Reading {
    std::string file;
    TomlFile toml;
    Diagnostics& diagnostics;
    KeyPlaces places;

    void error(std::string_view path, std::string message, std::string hint = {}) {
        diagnostics.error(file, places.of(path), std::move(message), std::move(hint));
    }
    bool is_written(std::string_view path) const { return places.is_written(path); }

    /// The value of a key, or null.
    const TomlValue* value(std::string_view section, std::string_view key) const;
};

/// Whether each section of the file is one of `sections`.
void check_sections(Reading& reading);

/// Reads the keys of a section that is there; findings go to the diagnostics.
template <class Struct>
void read_section(Reading& reading, std::string_view name, const Rows<Struct>& rows, Struct& out) {
    for (const TomlEntry& section : reading.toml.root) {
        if (section.key != name)
            continue;
        if (!section.value.table()) {
            reading.diagnostics.error(
                reading.file, section.value.place,
                fmt::format("{}: expected a section, found {}", name, section.value.kind()),
                fmt::format("write [{}] on a line of its own, and its keys below", name));
            return;
        }
        reading.places.note(std::string(name), section.value.place);
        for (const TomlEntry& entry : *section.value.table()) {
            const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row<Struct>& candidate) {
                return candidate.rule.name == entry.key;
            });
            if (row == rows.end()) {
                std::vector<std::string_view> known;
                for (const Row<Struct>& other : rows)
                    known.push_back(other.rule.name);
                reading.diagnostics.error(reading.file, entry.key_place,
                                          fmt::format("unknown key \"{}\" in [{}]", entry.key, name),
                                          suggest_name(entry.key, known));
                continue;
            }
            reading.places.note(fmt::format("{}.{}", name, entry.key), entry.value.place);
            const ValueResult fault = std::visit(
                [&](auto member) { return read_value(entry.value, row->rule, out.*member); }, row->member);
            if (fault)
                reading.diagnostics.error(reading.file, fault->place, fault->message, fault->hint);
        }
    }
}

} // namespace overt::characterisation_keys
