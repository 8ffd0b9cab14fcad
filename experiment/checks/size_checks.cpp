#include <cmath>

#include <fmt/format.h>

#include "experiment/checks/protocol_checks.h"

namespace overt {

namespace {

// What eyes and screens have: nearer than 200 mm few people see sharply; cinemas end at 10 m. A pixel of a
// telephone is 0.05 mm wide, of a wall of lamps 5 mm.
constexpr double nearest_mm = 200.0, farthest_mm = 10000.0;
constexpr double finest_pixel_mm = 0.04, coarsest_pixel_mm = 6.0;

/// Says which unit the number would fit, if one of centimetres, metres or inches does.
std::string likely_length(std::string_view key, double value, double least, double most) {
    constexpr struct {
        const char* unit;
        double mm;
    } units[] = {{"cm", 10.0}, {"inches", 25.4}, {"m", 1000.0}, {"tenths of a millimetre", 0.1}};
    for (const auto& [unit, mm] : units) {
        if (value * mm >= least && value * mm <= most)
            return fmt::format("is that in {}? Then {} = {:.6g}", unit, key, value * mm);
    }
    return "lengths are in millimetres";
}

void check_pixel(ProtocolExamination& examination, std::string_view key, double length_mm, int pixels) {
    const double pixel_mm = length_mm / pixels;
    if (pixel_mm >= finest_pixel_mm && pixel_mm <= coarsest_pixel_mm)
        return;
    examination.warning(
        {fmt::format("display.{}", key)},
        fmt::format("a screen of {} px on {:g} mm has pixels of {:.2g} mm, beyond the {} to {} mm "
                    "that screens have",
                    pixels, length_mm, pixel_mm, finest_pixel_mm, coarsest_pixel_mm),
        likely_length(key, length_mm, 2.5 * finest_pixel_mm * pixels, 0.5 * coarsest_pixel_mm * pixels));
}

} // namespace

void check_sizes(ProtocolExamination& examination) {
    const DisplaySettings& display = examination.protocol.display;
    const double distance = display.viewing_distance_mm;
    if (distance < nearest_mm || distance > farthest_mm) {
        examination.warning(
            {"display.viewing_distance_mm"},
            fmt::format("a viewing distance of {:g} mm is beyond the {:g} to {:g} mm from which "
                        "screens are looked at",
                        distance, nearest_mm, farthest_mm),
            likely_length("viewing_distance_mm", distance, 1.2 * nearest_mm, 0.5 * farthest_mm));
    }
    check_pixel(examination, "width_mm", display.width_mm, display.width_px);
    check_pixel(examination, "height_mm", display.height_mm, display.height_px);
}

} // namespace overt
