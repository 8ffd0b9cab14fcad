#include "devices/display_box/video_line_check.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

/// Drivers were seen to shift a line by one pixel; more than a few is another picture.
constexpr int largest_shift_px = 8;

bool is_shifted_by(std::span<const RgbBytes> sent, std::span<const RgbBytes> received, int shift) {
    const auto distance = static_cast<std::size_t>(std::abs(shift));
    if (distance >= sent.size())
        return false;
    const auto kept = sent.size() - distance;
    return shift > 0 ? std::ranges::equal(sent.first(kept), received.last(kept))
                     : std::ranges::equal(sent.last(kept), received.first(kept));
}

/// The shortest shift that explains the line. A line that is the same after a shift (all one colour) tells
/// nothing.
std::optional<int> shift_of(std::span<const RgbBytes> sent, std::span<const RgbBytes> received) {
    for (int distance = 1; distance <= largest_shift_px; ++distance)
        for (const int shift : {distance, -distance})
            if (is_shifted_by(sent, received, shift) && !is_shifted_by(sent, sent, shift))
                return shift;
    return std::nullopt;
}

} // namespace

void compare_video_line(const DrawnLine& drawn, const std::vector<std::vector<RgbBytes>>& readings,
                        VideoLineReport& report) {
    LineVerdict& verdict = report.lines.emplace_back();
    verdict.line = drawn.line;
    for (const std::vector<RgbBytes>& received : readings) {
        OVERT_EXPECTS(received.size() == drawn.pixels.size());
        const bool first_of_all = report.readings++ == 0;
        const long changed_before = report.changed;
        for (std::size_t pixel = 0; pixel < received.size(); ++pixel) {
            for (std::size_t channel = 0; channel < 3; ++channel) {
                ++report.bytes;
                const int sent = drawn.pixels[pixel][channel], got = received[pixel][channel];
                if (sent == got)
                    continue;
                ++report.changed;
                if (report.changes.size() < VideoLineReport::most_changes)
                    report.changes.push_back({drawn.line, pixel, channel, sent, got});
            }
        }
        const auto shift =
            report.changed > changed_before ? shift_of(drawn.pixels, received) : std::optional<int>();
        if (verdict.readings++ == 0)
            verdict.shift_px = shift;
        else if (verdict.shift_px != shift)
            verdict.shift_px.reset();
        verdict.changed += report.changed - changed_before;
        if (first_of_all)
            report.shift_px = shift;
        else if (report.shift_px != shift)
            report.shift_px.reset();
    }
    verdict.is_unsteady = std::ranges::adjacent_find(readings, std::ranges::not_equal_to()) != readings.end();
    report.unsteady_lines += verdict.is_unsteady;
}

std::string LineVerdict::description() const {
    if (changed == 0)
        return "as drawn";
    if (shift_px)
        return fmt::format("moved {} px to the {}", std::abs(*shift_px), *shift_px > 0 ? "right" : "left");
    return fmt::format("{} bytes {} in {} readings", changed,
                       is_unsteady ? "changed, differently each time" : "changed for good", readings);
}

std::string VideoLineReport::description() const {
    if (readings == 0)
        return "no video line was read back";
    if (good())
        return fmt::format("all {} bytes of {} readings arrived as they were drawn", bytes, readings);
    std::string text = fmt::format("{} of {} bytes in {} readings arrived changed", changed, bytes, readings);
    if (shift_px)
        text += fmt::format(
            "; the lines are moved {} px to the {}: the graphics driver shifts the picture, T-Lock "
            "lines cannot work",
            std::abs(*shift_px), *shift_px > 0 ? "right" : "left");
    else if (unsteady_lines > 0)
        text += fmt::format("; {} lines came differently each time: switch off the graphics card's dithering",
                            unsteady_lines);
    else
        text += "; see that the card's gamma table is the identity, its range full and its scaling off";
    constexpr std::array<const char*, 3> channels{"red", "green", "blue"};
    for (const ChangedByte& change : changes)
        text += fmt::format("\nline {}, pixel {}, {}: sent {}, received {}", change.line, change.pixel,
                            channels[change.channel], change.sent, change.received);
    return text;
}

} // namespace overt
