#include <cmath>

#include <fmt/format.h>

#include "experiment/checks/protocol_checks.h"
#include "experiment/protocol/files/characterisation_file.h"

namespace overt {

namespace {

/// A quantity that both files state.
struct Stated {
    std::string_view key;
    std::optional<double> measured;
    double in_protocol;
    std::string_view unit;
    double tolerance; ///< as share of it
};

void check_screen(ProtocolExamination& examination, const MeasuredScreen& measured) {
    const DisplaySettings& display = examination.protocol.display;
    const auto number = [](std::optional<int> value) {
        return value ? std::optional<double>(*value) : std::nullopt;
    };
    // A millimetre in a metre is what a ruler leaves; 59.94 and 60 Hz are the same mode to many.
    const Stated quantities[] = {
        {"width_px", number(measured.width_px), static_cast<double>(display.width_px), "px", 0.0},
        {"height_px", number(measured.height_px), static_cast<double>(display.height_px), "px", 0.0},
        {"refresh_hz", measured.refresh_hz, display.refresh_hz, "Hz", 0.005},
        {"width_mm", measured.width_mm, display.width_mm, "mm", 0.005},
        {"height_mm", measured.height_mm, display.height_mm, "mm", 0.005}};
    for (const Stated& stated : quantities) {
        if (!stated.measured ||
            std::abs(stated.in_protocol - *stated.measured) <= stated.tolerance * *stated.measured)
            continue;
        const std::string path = fmt::format("display.{}", stated.key);
        examination.error({path, "display.characterisation"},
                          fmt::format("{} is {} {}, but {} was measured at {} {}", stated.key,
                                      stated.in_protocol, stated.unit,
                                      display.characterisation_file.filename().string(), *stated.measured,
                                      stated.unit),
                          "correct what is wrong, or characterise the display as it is used");
    }
}

/// A luminance as a linear grey between black and white.
void take_luminance(ProtocolExamination& examination, std::string_view key, std::string_view grey_key,
                    std::optional<double> luminance, double& grey) {
    if (!luminance || examination.faulty.contains(key))
        return;
    const std::optional<DisplayCharacterisation>& light = examination.protocol.display.characterisation;
    if (examination.is_written(grey_key))
        examination.error({key}, fmt::format("{} already says it", grey_key), "leave one of the two out");
    if (!examination.is_written("display.characterisation")) {
        examination.error({key}, "cd/m2 need a characterisation of the display",
                          fmt::format("name one with display.characterisation, or give {}", grey_key));
        return;
    }
    if (!light)
        return;
    const double linear = light->linear_of(*luminance);
    if (linear < 0.0 || linear > 1.0) {
        examination.error({key}, fmt::format("{} cd/m2 cannot be shown: black has {:.4g} cd/m2, white {:.4g}",
                                             *luminance, light->black_xyz.y, light->white_xyz().y));
        return;
    }
    grey = linear;
}

} // namespace

void take_characterisation(ProtocolExamination& examination, bool look_at_files) {
    Protocol& protocol = examination.protocol;
    DisplaySettings& display = protocol.display;
    if (!display.characterisation_file.empty()) {
        if (examination.is_written("display.gamma"))
            examination.error({"display.gamma"},
                              "the characterisation already says how light follows the signal",
                              "leave out gamma, or characterisation");
        if (look_at_files)
            display.characterisation = read_characterisation(
                display.characterisation_file, protocol.file.string(),
                protocol.places.of("display.characterisation"), examination.diagnostics());
        if (!display.characterisation)
            examination.faulty.insert("display.characterisation");
        else
            check_screen(examination, display.characterisation->screen);
    }
    take_luminance(examination, "display.background_cd_m2", "display.background", display.background_cd_m2,
                   display.background);
    take_luminance(examination, "screens.text_cd_m2", "screens.text_grey", protocol.screens.text_cd_m2,
                   protocol.screens.text_grey);
}

} // namespace overt
