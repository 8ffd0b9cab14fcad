#include "experiment/protocol/files/characterisation_file.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "experiment/base/number_table.h"
#include "experiment/keys/key_walk.h"

namespace overt {

namespace {

/// What stands in a file.
struct CharacterisationKeys {
    struct Display {
        std::string name, date, instrument, note;
    } display;
    MeasuredScreen screen;
    /// As measured, the black of the display included.
    struct Light {
        std::optional<glm::dvec3> black, red, green, blue, white;
        std::filesystem::path spectra;
    } light;
    struct Gamma {
        std::filesystem::path table;
        std::vector<double> signal, red, green, blue;
        std::vector<double> exponent, offset, interpolation_exponent; ///< none, one, or one for each channel
    } gamma;
};
using LightKeys = CharacterisationKeys::Light;
using GammaKeys = CharacterisationKeys::Gamma;

const KeyTable& characterisation_table() {
    using F = CharacterisationKeys;
    using D = F::Display;
    using S = MeasuredScreen;
    using L = LightKeys;
    using G = GammaKeys;
    constexpr KeyLimits xyz = range(0, 1e5, "cd/m2");
    static const KeyTable table(
        {{"display",
          &F::display,
          {{"name", &D::name, "Which display it is."},
           {"date", &D::date, "When it was measured, as a text."},
           {"instrument", &D::instrument, "What it was measured with."},
           {"note", &D::note, "What else is to be known."}}},
         {"screen",
          &F::screen,
          {{"width_px", &S::width_px, range(16, 16384, "px"), "Pixels in a row."},
           {"height_px", &S::height_px, range(16, 16384, "px"), "Rows."},
           {"refresh_hz", &S::refresh_hz, range(1, 1000, "Hz"), "Refresh rate; light may depend on it."},
           {"width_mm", &S::width_mm, range(10, 20000, "mm"), "Width of the lit area."},
           {"height_mm", &S::height_mm, range(10, 20000, "mm"), "Height of the lit area."},
           {"viewing_distance_mm", &S::viewing_distance_mm, range(50, 50000, "mm"),
            "From where it was measured."}}},
         {"light",
          &F::light,
          {{"black", &L::black, xyz, "XYZ at signal 0."},
           {"red", &L::red, xyz, "XYZ of red alone at full signal, black included."},
           {"green", &L::green, xyz, "The same of green."},
           {"blue", &L::blue, xyz, "The same of blue."},
           {"white", &L::white, xyz, "The same of all three together, to be compared with their sum."},
           {"spectra", &L::spectra, "Table of the channels' radiance, instead of XYZ."}}},
         {"gamma",
          &F::gamma,
          {{"table", &G::table, "Table of light at signals of 0 … 1."},
           {"signal", &G::signal, range(0, 1), "Signals, instead of a table."},
           {"red", &G::red, at_least(0), "Light of red at these signals."},
           {"green", &G::green, at_least(0), "The same of green."},
           {"blue", &G::blue, at_least(0), "The same of blue."},
           {"exponent", &G::exponent, range(0.1, 10), "Of a power function, for all channels or for each."},
           {"offset", &G::offset, range(-0.9, 0.9), "Its offset, likewise."},
           {"interpolation_exponent", &G::interpolation_exponent, range(0.1, 10),
            "Between points light^(1 / this) is interpolated; left out, the exponent of the power that the "
            "points lie nearest to."}}}});
    return table;
}

/// A file while it is read.
struct Reading {
    std::string file;
    TomlFile toml;
    Diagnostics& diagnostics;
    KeyPlaces places = {};

    void error(std::string_view path, std::string message, std::string hint = {}) {
        diagnostics.error(file, places.of(path), std::move(message), std::move(hint));
    }
    bool is_written(std::string_view path) const { return places.is_written(path); }

    /// The value of a key, or null.
    const TomlValue* value(std::string_view section, std::string_view key) const {
        const TomlValue* const table = find(toml.root, section);
        return table && table->table() ? find(*table->table(), key) : nullptr;
    }

  private:
    static const TomlValue* find(const TomlTable& table, std::string_view key) {
        const auto found = std::ranges::find(table, key, &TomlEntry::key);
        return found == table.end() ? nullptr : &found->value;
    }
};

/// The points of a gamma table, wherever they were written.
struct GammaPoints {
    std::string file;
    std::array<std::vector<double>, 4> values; ///< signal, red, green, blue
    std::array<std::vector<Place>, 4> places;
};

class CharacterisationReader {
  public:
    CharacterisationReader(Reading& reading, std::filesystem::path folder, DisplayCharacterisation& out)
        : reading_(reading), folder_(std::move(folder)), out_(out) {}

    void read() {
        CharacterisationKeys keys;
        KeyPaths faulty;
        KeyWalk(characterisation_table(), reading_.file, reading_.places, faulty, reading_.diagnostics)
            .read(reading_.toml, keys);
        out_.display = keys.display.name;
        out_.date = keys.display.date;
        out_.instrument = keys.display.instrument;
        out_.note = keys.display.note;
        out_.screen = keys.screen;
        // Keys that are wrong, or lie in lines that were passed over, would raise false alarms here.
        if (!reading_.toml.is_whole || reading_.diagnostics.has_errors())
            return;
        take_light(keys.light);
        take_gamma(keys.gamma);
    }

  private:
    std::string file_of(const std::filesystem::path& table) const { return (folder_ / table).string(); }

    std::optional<NumberTable> read_table(const std::filesystem::path& name, std::string_view key,
                                          std::span<const std::string_view> required,
                                          std::span<const std::string_view> optional) {
        auto text =
            read_whole_file(folder_ / name, reading_.file, reading_.places.of(key), reading_.diagnostics);
        if (!text)
            return std::nullopt;
        out_.files.push_back({name.filename().string(), *text});
        return read_number_table(*std::move(text), file_of(name), required, optional, reading_.diagnostics);
    }

    void take_light(const LightKeys& light) {
        const std::optional<glm::dvec3> given[] = {light.red, light.green, light.blue};
        if (!light.spectra.empty()) {
            for (const std::string_view name : {"black", "red", "green", "blue"}) {
                const std::string path = fmt::format("light.{}", name);
                if (reading_.is_written(path))
                    reading_.error(path, fmt::format("{}: the spectra already say it", name),
                                   "leave out spectra, or these");
            }
            take_spectra(light.spectra);
        } else {
            for (std::size_t i = 0; i < 3; ++i) {
                if (!given[i])
                    reading_.error("light", fmt::format("[light] has no \"{}\"", channel_names[i]),
                                   "XYZ in cd/m2 of the channel at full signal; or spectra = \"…\", a table");
            }
            if (!light.black)
                reading_.error("light", "[light] has no \"black\"",
                               "XYZ in cd/m2 at signal 0, [0, 0, 0] if it "
                               "is too dark to be measured");
            if (reading_.diagnostics.has_errors())
                return;
            out_.black_xyz = *light.black;
            for (std::size_t i = 0; i < 3; ++i)
                out_.primaries_xyz[i] = *given[i] - *light.black;
        }
        out_.measured_white_xyz = light.white;
        if (!reading_.diagnostics.has_errors())
            check_light(light);
    }

    void check_light(const LightKeys& light) {
        const std::string_view where = light.spectra.empty() ? "" : "light.spectra";
        const auto path = [&](std::string_view key) {
            return where.empty() ? fmt::format("light.{}", key) : std::string(where);
        };
        for (std::size_t i = 0; i < 3; ++i) {
            if (!(out_.primaries_xyz[i].y > 0.0))
                reading_.error(
                    path(channel_names[i]),
                    fmt::format("{} at full signal has {:.4g} cd/m2, no more than black with {:.4g}",
                                channel_names[i], out_.primaries_xyz[i].y + out_.black_xyz.y,
                                out_.black_xyz.y));
        }
        if (reading_.diagnostics.has_errors())
            return;
        if (independence_of(out_.primaries_xyz) < least_independence)
            reading_.error(path("red"),
                           "the matrix of the primaries has no inverse: two of them, or a mixture of two and "
                           "the third, have the same colour",
                           "red, green and blue are the channels at full signal, one at a time");
        if (light.white) {
            const double sum = out_.white_xyz().y, error = sum / light.white->y - 1.0;
            if (!(std::abs(error) < 0.05))
                reading_.diagnostics.warning(
                    reading_.file, reading_.places.of("light.white"),
                    fmt::format("white was measured with {:.4g} cd/m2, but the channels add up to {:.4g}",
                                light.white->y, sum),
                    "the model takes channels to add up; see what in the display keeps them from it");
        }
    }

    void take_spectra(const std::filesystem::path& name) {
        constexpr std::string_view required[] = {"wavelength_nm", "red", "green", "blue"};
        constexpr std::string_view optional[] = {"black"};
        const auto table = read_table(name, "light.spectra", required, optional);
        if (!table)
            return;
        const auto fault = [&](std::size_t row, std::string_view column, std::string message) {
            reading_.diagnostics.error(table->file, table->place(row, column), std::move(message));
        };
        const std::vector<double> wavelengths = table->column("wavelength_nm");
        for (std::size_t row = 1; row < wavelengths.size(); ++row) {
            if (!(wavelengths[row] > wavelengths[row - 1]))
                return fault(row, "wavelength_nm", "wavelengths have to rise");
        }
        if (wavelengths.front() > 400.0 || wavelengths.back() < 700.0)
            return fault(wavelengths.front() > 400.0 ? 0 : wavelengths.size() - 1, "wavelength_nm",
                         fmt::format("the spectra go from {} to {} nm: 400 to 700 nm is the least",
                                     wavelengths.front(), wavelengths.back()));
        PrimarySpectra spectra;
        if (table->has("black"))
            spectra.black = {wavelengths, table->column("black")};
        for (std::size_t i = 0; i < 3; ++i) {
            SampledSpectrum& channel = spectra.channels[i];
            channel = {wavelengths, table->column(channel_names[i])};
            const double peak = *std::max_element(channel.values.begin(), channel.values.end());
            for (std::size_t row = 0; row < channel.values.size(); ++row) {
                // Noise goes below 0, too.
                if (channel.values[row] < -0.01 * peak)
                    return fault(row, channel_names[i], "a radiance below 0");
                if (!spectra.black.values.empty())
                    channel.values[row] -= spectra.black.values[row];
            }
            out_.primaries_xyz[i] = tristimulus_of(channel, ColourSpace::cie1931_xyz);
        }
        out_.black_xyz = tristimulus_of(spectra.black, ColourSpace::cie1931_xyz);
        out_.spectra = std::move(spectra);
    }

    void take_gamma(const GammaKeys& gamma) {
        const bool has_file = !gamma.table.empty(), has_points = reading_.is_written("gamma.signal"),
                   has_power = reading_.is_written("gamma.exponent");
        if (has_file + has_points + has_power != 1) {
            reading_.error("gamma",
                           has_file + has_points + has_power == 0
                               ? "[gamma] does not say how light follows "
                                 "the signal"
                               : "[gamma] says twice how light follows the "
                                 "signal",
                           "give either table, or signal with red, green and blue, or exponent");
            return;
        }
        if (has_power)
            take_power(gamma);
        else if (const auto points = has_file ? points_of_table(gamma.table) : points_of_lists(gamma))
            take_points(*points, gamma.interpolation_exponent);
    }

    /// One number for each channel of what was given for one, all or none.
    std::array<double, 3> for_channels(const std::vector<double>& given, std::string_view key,
                                       std::array<double, 3> if_left_out) {
        if (given.size() == 3)
            return {given[0], given[1], given[2]};
        if (given.size() == 1)
            return {given[0], given[0], given[0]};
        const std::string path = fmt::format("gamma.{}", key);
        if (reading_.is_written(path))
            reading_.error(path, fmt::format("{}: expected 1 or 3 numbers, found {}", key, given.size()));
        return if_left_out;
    }

    void take_power(const GammaKeys& gamma) {
        const auto exponents = for_channels(gamma.exponent, "exponent", {1.0, 1.0, 1.0}),
                   offsets = for_channels(gamma.offset, "offset", {0.0, 0.0, 0.0});
        for (std::size_t i = 0; i < 3; ++i)
            out_.curves[i] = ChannelCurve::power(exponents[i], offsets[i]);
    }

    std::optional<GammaPoints> points_of_table(const std::filesystem::path& name) {
        constexpr std::string_view required[] = {"signal", "red", "green", "blue"};
        const auto table = read_table(name, "gamma.table", required, {});
        if (!table)
            return std::nullopt;
        GammaPoints points;
        points.file = table->file;
        for (std::size_t i = 0; i < 4; ++i) {
            points.values[i] = table->column(required[i]);
            for (std::size_t row = 0; row < table->rows.size(); ++row)
                points.places[i].push_back(table->place(row, required[i]));
        }
        return points;
    }

    std::optional<GammaPoints> points_of_lists(const GammaKeys& gamma) {
        constexpr std::string_view names[] = {"signal", "red", "green", "blue"};
        GammaPoints points{reading_.file, {gamma.signal, gamma.red, gamma.green, gamma.blue}, {}};
        for (std::size_t i = 0; i < 4; ++i) {
            const TomlValue* value = reading_.value("gamma", names[i]);
            if (!value) {
                reading_.error("gamma", fmt::format("[gamma] has no \"{}\"", names[i]));
                return std::nullopt;
            }
            for (const TomlValue& item : *value->list())
                points.places[i].push_back(item.place);
            if (points.values[i].size() != points.values[0].size()) {
                reading_.error(fmt::format("gamma.{}", names[i]),
                               fmt::format("{}: {} numbers where signal has {}", names[i],
                                           points.values[i].size(), points.values[0].size()));
                return std::nullopt;
            }
        }
        return points;
    }

    void take_points(const GammaPoints& points, const std::vector<double>& exponents) {
        const auto fault = [&](std::size_t column, std::size_t row, std::string message,
                               std::string hint = {}) {
            reading_.diagnostics.error(points.file, points.places[column][row], std::move(message),
                                       std::move(hint));
        };
        const std::vector<double>& signal = points.values[0];
        if (signal.size() < 2)
            return reading_.error("gamma", fmt::format("a table of {} points is no curve", signal.size()));
        for (std::size_t row = 1; row < signal.size(); ++row) {
            if (!(signal[row] > signal[row - 1]))
                return fault(0, row,
                             fmt::format("a signal of {} after {}: signals have to rise", signal[row],
                                         signal[row - 1]));
        }
        if (signal.front() != 0.0 || signal.back() != 1.0)
            return fault(
                0, signal.front() != 0.0 ? 0 : signal.size() - 1,
                fmt::format("signals go from {} to {}, and not from 0 to 1", signal.front(), signal.back()),
                "divide levels by the highest, such as 255");
        std::array<std::vector<double>, 3> lights;
        for (std::size_t i = 1; i < 4; ++i) {
            std::vector<double> light = points.values[i];
            for (std::size_t row = 0; row < light.size(); ++row) {
                if (light[row] < 0.0)
                    return fault(i, row,
                                 fmt::format("{}: light of {} is below 0", channel_names[i - 1], light[row]));
                if (row > 0 && light[row] < light[row - 1])
                    return fault(i, row,
                                 fmt::format("{}: light of {} after {}: more signal cannot make less light",
                                             channel_names[i - 1], light[row], light[row - 1]),
                                 "measure these levels again, more often");
            }
            const double black = light.front(), range = light.back() - black;
            if (!(range > 0.0))
                return fault(i, light.size() - 1,
                             fmt::format("{}: the light is the same at all signals", channel_names[i - 1]));
            for (double& value : light)
                value = (value - black) / range;
            light.back() = 1.0;
            lights[i - 1] = std::move(light);
        }
        std::array<double, 3> nearest{};
        for (std::size_t i = 0; i < 3; ++i)
            nearest[i] = nearest_exponent(signal, lights[i]);
        nearest = for_channels(exponents, "interpolation_exponent", nearest);
        for (std::size_t i = 0; i < 3; ++i)
            out_.curves[i] = ChannelCurve::table(signal, lights[i], nearest[i]);
    }

    Reading& reading_;
    std::filesystem::path folder_;
    DisplayCharacterisation& out_;
};

} // namespace

std::optional<DisplayCharacterisation> read_characterisation(const std::filesystem::path& file,
                                                             const std::string& named_in, Place place,
                                                             Diagnostics& diagnostics) {
    auto text = read_whole_file(file, named_in, place, diagnostics);
    if (!text)
        return std::nullopt;
    // Findings of its own, so that errors elsewhere do not look like errors here.
    Diagnostics found;
    DisplayCharacterisation characterisation;
    characterisation.files.push_back({file.filename().string(), *text});
    found.quote_from(file.string(), *text);
    Reading reading{file.string(), parse_toml(*text, file.string(), found), found};
    CharacterisationReader(reading, file.parent_path(), characterisation).read();
    diagnostics.take(found);
    if (found.has_errors())
        return std::nullopt;
    ContentHasher hasher;
    for (const CharacterisationFile& part : characterisation.files)
        hasher.add(part.name).add(part.text);
    characterisation.sha256 = hasher.finish();
    return characterisation;
}

} // namespace overt
