#include "app/stimuli/picture_window.h"

#include <algorithm>

#include "render/image/text_layout.h"

namespace overt {

namespace {

DisplaySettings ordinary_screen(glm::ivec2 size_px) {
    DisplaySettings display;
    display.output = OutputMode::native_8bit;
    display.gamma = 2.2;
    display.width_px = size_px.x;
    display.height_px = size_px.y;
    return display;
}

} // namespace

glm::ivec2 picture_window_size(const ViewSettings& view) {
    const std::vector<MonitorInfo> monitors = list_monitors();
    constexpr double least_px = 768.0, share_of_screen = 0.85;
    const glm::dvec2 most = share_of_screen * (monitors.empty() ? glm::dvec2(1024.0, 768.0)
                                                                : glm::dvec2(monitors.front().size_px));
    const double scale = std::min({std::max(1.0, least_px / std::max(view.width_px, view.height_px)),
                                   most.x / view.width_px, most.y / view.height_px});
    return {static_cast<int>(scale * view.width_px), static_cast<int>(scale * view.height_px)};
}

PictureWindow::PictureWindow(const OpenDisplay& opened)
    : opened_(&opened), encoder_(ordinary_screen(opened.window()->framebuffer_px())),
      canvas_(opened.context(), opened.window()->framebuffer_px(), encoder_.format()) {}

void PictureWindow::show(LinearImage picture, const std::string& line) {
    write_on(picture, line, {picture.size_px.x / 2, picture.size_px.y - 1});
    bytes_.resize(bytes_in(picture.size_px, encoder_.format()));
    encoder_.encode(picture, {0, 0}, bytes_);
    canvas_.texture().upload(bytes_);
    opened_->surface().present(canvas_);
}

} // namespace overt
