/// A presenter of plain pages on a small screen.
#pragma once

#include <memory>
#include <vector>

#include "devices/host/clocks.h"
#include "render/gl/headless_context.h"
#include "render/presenter/page_presenter.h"
#include "tests/support/gl_contexts.h"

namespace overt::test {

inline constexpr glm::ivec2 screen_px{96, 54}, image_px{32, 32};

/// Pages of one plain colour each: red is the page's number over 255, green the object's.
class PlainPages final : public FrameSource {
  public:
    std::vector<int> page_of_frame(const Stimulus&) const override { return {0, 1, 2, 1, 0}; }
    LinearImage page(const Stimulus& stimulus, int page) const override {
        LinearImage image(image_px);
        for (glm::vec4& pixel : image.pixels)
            pixel = {static_cast<float>(page + 1) / 255.0f, static_cast<float>(stimulus.object) / 255.0f,
                     0.0f, 1.0f};
        return image;
    }
};

struct Bench {
    std::unique_ptr<GlContext> context = make_headless_context(ContextKind::osmesa);
    VirtualClock clock;
    VirtualDisplay display{*context, clock, 120.0};
    PlainPages pages;
    ScreenGeometry geometry;
    DisplaySettings settings;
    ScreenSettings screens;

    Bench() {
        geometry.screen_px = screen_px;
        geometry.image_px = image_px;
        geometry.image_origin_px = centred_origin_px(screen_px, image_px);
        settings.output = OutputMode::native_8bit;
        settings.background = 10.0 / 255.0;
    }
};

inline int red_at(const std::vector<std::byte>& canvas, glm::ivec2 pixel) {
    return std::to_integer<int>(canvas[static_cast<std::size_t>(pixel.y * screen_px.x + pixel.x) * 4]);
}

} // namespace overt::test
