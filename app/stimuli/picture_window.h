/// Pictures of linear light in a window that is as large as they are, on an ordinary screen.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "app/rig/open_display.h"
#include "experiment/protocol/protocol.h"
#include "render/image/linear_image.h"
#include "render/signal/display_encoder.h"

namespace overt {

/// How often a picture at rest looks for something to do.
inline constexpr auto picture_rest = std::chrono::milliseconds(10);

/// In the shape of a view, large enough for a hand, and as large as the first screen has room for beside its
/// panels. Main thread only.
glm::ivec2 picture_window_size(const ViewSettings& view);

class PictureWindow {
  public:
    /// `opened` is started, its display a window; it must outlive this.
    explicit PictureWindow(const OpenDisplay& opened);

    /// With a line over its lower edge.
    void show(LinearImage picture, const std::string& line);

  private:
    const OpenDisplay* opened_;
    DisplayEncoder encoder_;
    Framebuffer canvas_;
    std::vector<std::byte> bytes_;
};

} // namespace overt
