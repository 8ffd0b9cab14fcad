#include "app/tracker/calibration_text.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "render/image/linear_image.h"
#include "render/presenter/screen_text.h"

namespace overt {

namespace {

const char* name_of(Eye eye) { return eye == Eye::left ? "left" : "right"; }

std::string measured(const std::optional<Degrees>& angle) {
    return angle ? fmt::format("{:.3f}", angle->value) : std::string("n/a");
}

} // namespace

void print_calibration(const RecordedCalibration& calibration) {
    fmt::print("{}; mean error {:.3f} deg, largest {:.3f} deg{}\n", calibration.method,
               calibration.validation.mean_error.value, calibration.validation.max_error.value,
               calibration.is_within_limits ? "" : " (beyond the protocol's limits; the operator went on)");
    if (calibration.validation.targets.empty())
        return;
    fmt::print("  {:<6} {:>9} {:>9} {:>9} {:>9} {:>10} {:>12} {:>8}\n", "eye", "x, px", "y, px", "gaze x",
               "gaze y", "error, deg", "RMS-S2S, deg", "SD, deg");
    for (const ValidatedTarget& target : calibration.validation.targets)
        fmt::print("  {:<6} {:>9.1f} {:>9.1f} {:>9} {:>9} {:>10} {:>12} {:>8}\n", name_of(target.eye),
                   target.target.x_px, target.target.y_px,
                   target.gaze ? fmt::format("{:.1f}", target.gaze->x_px) : "not seen",
                   target.gaze ? fmt::format("{:.1f}", target.gaze->y_px) : "",
                   target.gaze ? fmt::format("{:.3f}", target.error.value) : "", measured(target.rms_s2s),
                   measured(target.sd));
}

void draw_validation(const RecordedCalibration& calibration, const ScreenGeometry& screen,
                     const std::filesystem::path& file) {
    if (calibration.validation.targets.empty())
        throw InputError(file.string() + " cannot be drawn: the tracker told no targets of its validation");
    constexpr double letters_deg = 0.5, grey = 0.75;
    ScreenSettings settings;
    settings.text_grey = grey;
    settings.text_height_deg = letters_deg;
    const Screen shown{.kind = Screen::Kind::validation,
                       .text = fmt::format("{}: {:.2f}° ({:.2f}°)", calibration.method,
                                           calibration.validation.mean_error.value,
                                           calibration.validation.max_error.value),
                       .validated = calibration.validation.targets};
    const PlacedPicture drawn = draw_screen(shown, screen, settings, 0.0);
    LinearImage picture(screen.screen_px);
    std::ranges::fill(picture.pixels, glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    for (int y = 0; y < drawn.picture.size_px.y; ++y)
        for (int x = 0; x < drawn.picture.size_px.x; ++x)
            picture.at(drawn.origin_px.x + x, drawn.origin_px.y + y) =
                glm::vec4(glm::vec3(drawn.picture.at(x, y)), 1.0f);
    write_srgb_png(file, picture);
}

} // namespace overt
