#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/display/display_commands.h"
#include "app/inputs/protocol_file.h"
#include "experiment/base/error.h"
#include "experiment/base/number_table.h"
#include "experiment/colour/display_colour.h"
#include "experiment/protocol/files/characterisation_file.h"
#include "render/signal/level_table.h"

namespace overt {

namespace {

struct NamedColour {
    std::string name;
    glm::dvec3 rgb{0.0};
};

glm::dvec3 three(const std::vector<double>& numbers) { return {numbers.at(0), numbers.at(1), numbers.at(2)}; }

ColourSpace space_called(const std::string& name) {
    return name == "cie2006"         ? ColourSpace::cie2006_xyz
           : name == "cie2006-cones" ? ColourSpace::cie2006_cones
                                     : ColourSpace::cie1931_xyz;
}

/// Each column of a table of spectra.
std::vector<NamedColour> colours_of_table(const std::filesystem::path& file, const DisplayColour& display,
                                          Diagnostics& diagnostics) {
    std::optional<NumberTable> table;
    if (auto text = read_whole_file(file, file.string(), {}, diagnostics))
        table = read_number_table(*std::move(text), file.string(), {}, {}, diagnostics);
    if (!table)
        return {};
    if (!table->has("wavelength_nm")) {
        diagnostics.error(file.string(), {}, "there is no column \"wavelength_nm\"",
                          "the others are spectra in W/(sr m2 nm)");
        return {};
    }
    const std::vector<double> wavelengths = table->column("wavelength_nm");
    for (std::size_t row = 1; row < wavelengths.size(); ++row) {
        if (!(wavelengths[row] > wavelengths[row - 1])) {
            diagnostics.error(file.string(), table->place(row, "wavelength_nm"), "wavelengths have to rise");
            return {};
        }
    }
    std::vector<NamedColour> colours;
    for (const std::string& name : table->columns) {
        if (name != "wavelength_nm")
            colours.push_back({name, display.rgb_of(SampledSpectrum{wavelengths, table->column(name)})});
    }
    return colours;
}

std::vector<NamedColour> colours_of(const DisplayColourOptions& options,
                                    const DisplayCharacterisation& display, Diagnostics& diagnostics) {
    if (!options.rgb.empty())
        return {{"rgb", three(options.rgb)}};
    if (!options.cones.empty())
        return {{"cones", DisplayColour(display, ColourSpace::cie2006_cones).rgb_of(three(options.cones))}};
    const DisplayColour colour(display, space_called(options.observer));
    if (!options.spectra.empty())
        return colours_of_table(options.spectra, colour, diagnostics);
    if (options.xyz.empty())
        throw InputError("no colour is given: --xyz, --cones, --rgb or --spectra.");
    return {{"xyz", colour.rgb_of(three(options.xyz))}};
}

nlohmann::ordered_json to_json(const NamedColour& colour, bool is_shown,
                               const DisplayCharacterisation& display) {
    const auto list = [](const glm::dvec3& numbers) {
        return nlohmann::ordered_json{numbers.x, numbers.y, numbers.z};
    };
    auto codes = nlohmann::ordered_json::array();
    for (int channel = 0; channel < 3; ++channel) {
        const ChannelCurve& curve = display.curves[static_cast<std::size_t>(channel)];
        const LevelTable table(65535, [&](double signal) { return curve.light_of(signal); });
        codes.push_back(table.level_of(colour.rgb[channel]));
    }
    const glm::dvec3 xyz = DisplayColour(display, ColourSpace::cie1931_xyz).tristimulus_of_rgb(colour.rgb);
    nlohmann::ordered_json json{{"name", colour.name},
                                {"rgb", list(colour.rgb)},
                                {"is_shown", is_shown},
                                {"codes_16bit", std::move(codes)},
                                {"xyz_1931", list(xyz)}};
    if (display.spectra)
        json["cones"] =
            list(DisplayColour(display, ColourSpace::cie2006_cones).tristimulus_of_rgb(colour.rgb));
    return json;
}

void print_row(const nlohmann::ordered_json& colour) {
    const auto at = [&](const char* key, int i) {
        return colour[key][static_cast<std::size_t>(i)].get<double>();
    };
    const glm::dvec3 xyz(at("xyz_1931", 0), at("xyz_1931", 1), at("xyz_1931", 2));
    const glm::dvec2 xy = chromaticity_of(xyz);
    fmt::print("{:<16} rgb {:9.6f} {:9.6f} {:9.6f}  codes {:5.0f} {:5.0f} {:5.0f}  {:10.4f} cd/m2  x {:.4f} "
               "y {:.4f}",
               colour["name"].get<std::string>(), at("rgb", 0), at("rgb", 1), at("rgb", 2),
               at("codes_16bit", 0), at("codes_16bit", 1), at("codes_16bit", 2), xyz.y, xy.x, xy.y);
    if (colour.contains("cones"))
        fmt::print("  LMS {:.6g} {:.6g} {:.6g}", at("cones", 0), at("cones", 1), at("cones", 2));
    fmt::print("{}\n", colour["is_shown"].get<bool>() ? "" : "  CANNOT BE SHOWN: codes are clipped");
}

} // namespace

int run_display_colour(const DisplayColourOptions& options) {
    Diagnostics diagnostics;
    const auto display =
        read_characterisation(options.characterisation, options.characterisation.string(), {}, diagnostics);
    std::vector<NamedColour> colours;
    if (display)
        colours = colours_of(options, *display, diagnostics);
    print_findings(diagnostics);
    if (diagnostics.has_errors())
        throw FindingsPrinted("a file cannot be used");
    GamutCount count;
    auto rows = nlohmann::ordered_json::array();
    for (const NamedColour& colour : colours)
        rows.push_back(to_json(colour, count.add(colour.rgb), *display));
    if (options.json) {
        fmt::print("{}\n", nlohmann::ordered_json{{"colours", rows},
                                                  {"outside", count.outside},
                                                  {"below", count.below},
                                                  {"above", count.above}}
                               .dump(2));
        return 0;
    }
    for (const auto& row : rows)
        print_row(row);
    if (count.outside > 0)
        fmt::print("{} of {} cannot be shown; channels below black: {}, {}, {}; above white: {}, {}, {}\n",
                   count.outside, count.colours, count.below[0], count.below[1], count.below[2],
                   count.above[0], count.above[1], count.above[2]);
    return 0;
}

} // namespace overt
