#include "experiment/colour/characterisation_text.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace overt {

namespace {

/// A basic string of TOML.
std::string quoted(const std::string& text) {
    std::string quoted = "\"";
    for (const char character : text) {
        if (character == '"' || character == '\\')
            quoted += '\\';
        if (static_cast<unsigned char>(character) < 0x20 || character == 0x7f)
            quoted += fmt::format("\\u{:04X}", static_cast<unsigned char>(character));
        else
            quoted += character;
    }
    return quoted + "\"";
}

std::string list(const glm::dvec3& numbers) {
    return fmt::format("[{}, {}, {}]", numbers.x, numbers.y, numbers.z);
}
std::string list(const std::vector<double>& numbers) { return fmt::format("[{}]", fmt::join(numbers, ", ")); }

template <class Number> void add(std::string& text, const char* key, const std::optional<Number>& value) {
    if (value)
        text += fmt::format("{} = {}\n", key, *value);
}

std::string percent(double share) { return fmt::format("{:.3g} %", 100.0 * share); }

} // namespace

std::string characterisation_toml(const DisplayCharacterisation& display) {
    std::string text =
        "# What was measured of a display. Named by [display] characterisation in a protocol.\n\n"
        "[display]\n";
    text += fmt::format("name = {}\n", quoted(display.display));
    text += fmt::format("date = {}\ninstrument = {}\n", quoted(display.date), quoted(display.instrument));
    if (!display.note.empty())
        text += fmt::format("note = {}\n", quoted(display.note));
    const MeasuredScreen& screen = display.screen;
    text += "\n[screen]\n";
    add(text, "width_px", screen.width_px);
    add(text, "height_px", screen.height_px);
    add(text, "refresh_hz", screen.refresh_hz);
    add(text, "width_mm", screen.width_mm);
    add(text, "height_mm", screen.height_mm);
    add(text, "viewing_distance_mm", screen.viewing_distance_mm);
    text +=
        "\n[light]\n# XYZ, CIE 1931, cd/m2; the channels at full signal, one at a time, black included.\n";
    text += fmt::format("black = {}\n", list(display.black_xyz));
    for (std::size_t i = 0; i < 3; ++i)
        text +=
            fmt::format("{} = {}\n", channel_names[i], list(display.primaries_xyz[i] + display.black_xyz));
    if (display.measured_white_xyz)
        text += fmt::format("white = {}\n", list(*display.measured_white_xyz));
    text += "\n[gamma]\n";
    const auto& curves = display.curves;
    if (!curves[0].is_table()) {
        text += fmt::format("exponent = [{}, {}, {}]\noffset = [{}, {}, {}]\n", curves[0].exponent(),
                            curves[1].exponent(), curves[2].exponent(), curves[0].offset(),
                            curves[1].offset(), curves[2].offset());
        return text;
    }
    text += "# Light at these signals, from black to full.\n";
    text += fmt::format("signal = {}\n", list(curves[0].signals()));
    for (std::size_t i = 0; i < 3; ++i)
        text += fmt::format("{} = {}\n", channel_names[i], list(curves[i].lights()));
    text += fmt::format("interpolation_exponent = [{}, {}, {}]\n", curves[0].exponent(), curves[1].exponent(),
                        curves[2].exponent());
    return text;
}

std::string readings_csv(std::span<const PatchReading> readings) {
    std::string text = "# Signals of 0 … 1 and what the photometer saw: XYZ, CIE 1931, cd/m2.\n"
                       "level_r,level_g,level_b,X,Y,Z\n";
    for (const PatchReading& reading : readings)
        text += fmt::format("{},{},{},{},{},{}\n", reading.signal.x, reading.signal.y, reading.signal.z,
                            reading.xyz.x, reading.xyz.y, reading.xyz.z);
    return text;
}

std::vector<std::string> light_lines(const DisplayCharacterisation& display) {
    const auto xy = [](const glm::dvec3& xyz) {
        const glm::dvec2 chromaticity = chromaticity_of(xyz);
        return fmt::format("x {:.4f}, y {:.4f}", chromaticity.x, chromaticity.y);
    };
    std::vector<std::string> lines{fmt::format(
        "white {:.4g} cd/m2 ({}), black {:.3g} cd/m2, contrast {}", display.white_xyz().y,
        xy(display.white_xyz()), display.black_xyz.y,
        std::isfinite(display.contrast()) ? fmt::format("{:.0f} : 1", display.contrast()) : "without bound")};
    for (std::size_t i = 0; i < 3; ++i)
        lines.push_back(fmt::format("{:<5} {:.4g} cd/m2 ({})", channel_names[i], display.primaries_xyz[i].y,
                                    xy(display.primaries_xyz[i])));
    return lines;
}

std::string characterisation_report(const DisplayCharacterisation& display, const CharacterisationFit& fit,
                                    const CharacterisationCheck& check) {
    std::string text = fmt::format("{}, measured {} with {}\n{} readings of {} patches", display.display,
                                   display.date, display.instrument, fit.readings, fit.patches);
    if (fit.repeat_noise > 0.0)
        text += fmt::format("; one patch again varies by {}", percent(fit.repeat_noise));
    text += "\n\nLight\n";
    for (const std::string& line : light_lines(display))
        text += "  " + line + "\n";
    text += "\nCurves\n";
    for (std::size_t i = 0; i < 3; ++i) {
        const ChannelFit& channel = fit.channels[i];
        text +=
            fmt::format("  {:<5} {} levels; a power of {:.3f}, offset {:.4f}, gain {:.4f} is {} of full "
                        "light off (rms); x, y drift by {:.4f}\n",
                        channel_names[i], channel.levels, channel.power.exponent(), channel.power.offset(),
                        channel.gain, percent(channel.power_rms), channel.chromaticity_drift);
        if (channel.levelled > 0)
            text += fmt::format("        {} levels were darker than lower ones, and made level: noise?\n",
                                channel.levelled);
    }
    text += fmt::format("  taken: {}\n", display.curves[0].is_table() ? "the measured levels" : "the powers");
    text += "\nValidation, on patches of several channels that had no part in the fit\n";
    if (check.patches == 0)
        return text + "  none were measured: nothing is known of how channels work together\n";
    text +=
        fmt::format("  {} patches; luminance is off by {} on average, {} at worst (signal {:.3f}, {:.3f}, "
                    "{:.3f})\n",
                    check.patches, percent(check.luminance_mean), percent(check.luminance_worst),
                    check.worst_signal.x, check.worst_signal.y, check.worst_signal.z);
    text += fmt::format("  x and y are off by {:.5f} on average, {:.5f} at worst\n", check.xy_mean,
                        check.xy_worst);
    if (check.additivity)
        text += fmt::format("  white is {} off the sum of the channels\n", percent(*check.additivity));
    if (check.dependence)
        text += fmt::format("  a channel's step changes by {} of white's luminance when the others are lit\n",
                            percent(*check.dependence));
    return text;
}

} // namespace overt
