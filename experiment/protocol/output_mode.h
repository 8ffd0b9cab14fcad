/// The output modes: how light is packed into the video signal. One row says all of a mode but how its bytes
/// are made and read, which is in render/signal/mode_coding.h.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overt {

enum class OutputMode : std::uint8_t {
    native_8bit,
    native_10bit,
    mono_plus_plus,
    color_plus_plus,
    bits_plus_plus,
    vpixx_m16,
    vpixx_c48
};

/// What a mode can show: colours, greys by one signal for all three channels, or greys that a table of
/// colours in the signal makes of an index.
enum class ShownLight : std::uint8_t { colours, greys, greys_by_table };

/// What the rows at the top of the screen carry that are never light.
enum class TopRows : std::uint8_t {
    none,
    t_lock, ///< three: table of colours, clock reset, digital outputs. A Display++ or Bits# reads them in
            ///< this mode
    psync   ///< one: a VPixx device knows a refresh by it
};

struct OutputModeRow {
    OutputMode mode;
    std::string_view name; ///< in a protocol, and of the box's mode where the top rows carry T-Lock
    ShownLight shows;
    int levels; ///< the highest level of what a pixel carries; of greys_by_table, the highest index
    bool joins_pixels_in_pairs; ///< each pair of neighbours carries one colour
    TopRows top_rows;
    int framebuffer_bits; ///< of each channel
    /// Bytes are parts of a code that the least change turns into another; else a level is as good as its
    /// neighbour, and light may be dithered.
    bool is_packed;
    std::string_view explanation; ///< what a pixel carries, as docs/output.md has it
};

/// All modes, in the order of OutputMode.
inline constexpr auto output_modes = std::to_array<OutputModeRow>({
    {OutputMode::native_8bit, "native-8bit", ShownLight::colours, 255, false, TopRows::none, 8, false,
     "8 bits per channel"},
    {OutputMode::native_10bit, "native-10bit", ShownLight::colours, 1023, false, TopRows::none, 10, false,
     "10 bits per channel, where the framebuffer has them: a window of another depth is refused"},
    {OutputMode::mono_plus_plus, "mono++", ShownLight::greys, 65535, false, TopRows::t_lock, 8, true,
     "luminance (Rec. 709) in 16 bits: high byte in red, low byte in green, no overlay in blue"},
    {OutputMode::color_plus_plus, "color++", ShownLight::colours, 65535, true, TopRows::t_lock, 8, true,
     "16 bits per channel in each pair of pixels: high bytes left, low bytes right"},
    {OutputMode::bits_plus_plus, "bits++", ShownLight::greys_by_table, 255, false, TopRows::t_lock, 8, true,
     "luminance as an index of 8 bits, equal steps of light; a table in the top row gives each index 16 "
     "bits, and undoes "
     "`gamma`"},
    {OutputMode::vpixx_m16, "vpixx-m16", ShownLight::greys, 65535, false, TopRows::psync, 8, true,
     "as `mono++`"},
    {OutputMode::vpixx_c48, "vpixx-c48", ShownLight::colours, 65535, true, TopRows::psync, 8, true,
     "as `color++`"},
});

constexpr const OutputModeRow& row_of(OutputMode mode) {
    return output_modes[static_cast<std::size_t>(mode)];
}

static_assert([] {
    for (std::size_t i = 0; i < output_modes.size(); ++i) {
        if (output_modes[i].mode != static_cast<OutputMode>(i))
            return false;
    }
    return true;
}());

constexpr std::string_view name_of(OutputMode mode) { return row_of(mode).name; }

/// The mode of this name.
constexpr std::optional<OutputMode> output_mode_called(std::string_view name) {
    for (const OutputModeRow& row : output_modes) {
        if (row.name == name)
            return row.mode;
    }
    return std::nullopt;
}

/// Whether each pixel pair of the video signal carries one colour.
constexpr bool joins_pixels_in_pairs(OutputMode mode) { return row_of(mode).joins_pixels_in_pairs; }

/// Whether the mode has no colours, however it makes its greys.
constexpr bool is_grey(OutputMode mode) { return row_of(mode).shows != ShownLight::colours; }

/// Whether the top rows of the screen carry messages to a Display++ or Bits#, which has to be in the mode.
constexpr bool has_t_lock(OutputMode mode) { return row_of(mode).top_rows == TopRows::t_lock; }

/// Whether the top row of the screen carries PSYNC, and the outputs of a VPixx device.
constexpr bool has_psync(OutputMode mode) { return row_of(mode).top_rows == TopRows::psync; }

constexpr int rows_of(TopRows rows) { return rows == TopRows::t_lock ? 3 : rows == TopRows::psync ? 1 : 0; }

/// Rows at the top of the screen that carry messages to the display and never light.
constexpr int reserved_rows(OutputMode mode) { return rows_of(row_of(mode).top_rows); }

/// The names of the modes for which `is_wanted(row)`, in order.
template <std::predicate<const OutputModeRow&> Wanted>
std::vector<std::string> names_of_modes(Wanted&& is_wanted) {
    std::vector<std::string> names;
    for (const OutputModeRow& row : output_modes) {
        if (is_wanted(row))
            names.emplace_back(row.name);
    }
    return names;
}

/// "mono++, color++ or bits++".
std::string listed(const std::vector<std::string>& names);

} // namespace overt
