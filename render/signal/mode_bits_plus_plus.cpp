/// bits++: an index of 8 bits, of which a table of colours in the top row makes light.
#include <cmath>

#include "render/signal/mode_coding.h"
#include "render/signal/received_messages.h"
#include "render/signal/signal_decoder.h"
#include "render/signal/signal_prediction.h"

namespace overt {

namespace {

void encode(const RowLevels& row, int width, std::byte* into) {
    row.for_greys(width, [&](int begin, int count, const ColourRun& run) {
        const auto& index = run.levels[0];
        put_pixels(into + 4 * begin, count,
                   [&](std::size_t i) { return opaque_pixel(index[i], index[i], index[i]); });
    });
}

ReceivedLight decode(const ScreenReader& reader) {
    const std::optional<ReceivedTable> table = colour_table_in(reader, 0);
    if (!table)
        throw GraphicsError("there is no table of colours in the top row, without which Bits++ is dark");
    const auto of = [&](int index, std::size_t channel) {
        return int{table->colours[static_cast<std::size_t>(index)][channel]};
    };
    return read_light({reader.width(), reader.height()}, 65535, [&](int x, int y) {
        const Rgb index = reader.opaque_colour(x, y);
        return Rgb{of(index.r, 0), of(index.g, 1), of(index.b, 2)};
    });
}

/// The light of the nearest of 256 indices.
std::array<double, 3> predict(const SignalPrediction& prediction, int x, int y) {
    const double grey = std::floor(prediction.luminance_at(x, y) * 255.0 + 0.5) / 255.0;
    return {grey, grey, grey};
}

} // namespace

template <> const ModeCoding& mode_coding<OutputMode::bits_plus_plus>() {
    static constexpr ModeCoding coding{encode, decode, predict};
    return coding;
}

} // namespace overt
