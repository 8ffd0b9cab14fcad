#include "app/check/screen_pictures.h"

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/session/session_screens.h"
#include "render/presenter/screen_text.h"

namespace overt {

int write_screen_pictures(const Protocol& protocol, const std::filesystem::path& folder) {
    std::error_code fault;
    std::filesystem::create_directories(folder, fault);
    if (fault)
        throw InputError(
            fmt::format("{}: this folder cannot be made ({})", folder.string(), fault.message()));
    const ScreenGeometry geometry = screen_geometry_of(protocol);
    const double background = protocol.display.background;
    int number = 0;
    for (const auto& [name, screen] : screens::all_of(protocol)) {
        LinearImage picture(geometry.screen_px);
        std::fill(picture.pixels.begin(), picture.pixels.end(),
                  glm::vec4(glm::vec3(static_cast<float>(background)), 1.0f));
        const PlacedPicture drawn = draw_screen(screen, geometry, protocol.screens, background);
        for (int y = 0; y < drawn.picture.size_px.y; ++y)
            for (int x = 0; x < drawn.picture.size_px.x; ++x)
                picture.at(drawn.origin_px.x + x, drawn.origin_px.y + y) =
                    glm::vec4(glm::vec3(drawn.picture.at(x, y)), 1.0f);
        write_srgb_png(folder / fmt::format("{:02}_{}.png", ++number, name), picture);
    }
    return number;
}

} // namespace overt
