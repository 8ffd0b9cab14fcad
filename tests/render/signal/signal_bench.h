/// A presenter of pictures that hold every level, and what arrives of them.
#pragma once

#include <memory>
#include <vector>

#include "devices/host/clocks.h"
#include "experiment/base/random.h"
#include "render/presenter/page_presenter.h"
#include "render/signal/signal_check.h"

namespace overt::test {

/// Page 0: all 65,536 levels of each channel, each twice side by side, in three different orders, except that
/// one that holds a grey has all three alike. Page 1: random light, some of it beyond the display. Page 2:
/// the background, but for one pixel.
class AllLevels final : public FrameSource {
  public:
    AllLevels(glm::ivec2 size, bool is_grey) : size_(size), is_grey_(is_grey) {}
    std::vector<int> page_of_frame(const Stimulus&) const override { return {0, 1, 2}; }
    LinearImage page(const Stimulus&, int page) const override {
        LinearImage image(size_);
        RandomStream random(static_cast<std::uint64_t>(page), "light");
        int i = 0;
        for (glm::vec4& pixel : image.pixels) {
            const int level = i++ / 2 % 65536;
            const auto light = [](int code) { return static_cast<float>(code / 65535.0); };
            if (page == 0 && is_grey_)
                pixel = {light(level), light(level), light(level), 1.0f};
            else if (page == 0)
                pixel = {light(level), light(65535 - level), light(level * 20501 & 65535), 1.0f};
            else if (page == 1)
                pixel = {random.uniform(-0.1, 1.1), random.uniform(), random.uniform(0.0, 0.01),
                         random.uniform()};
        }
        if (page == 2)
            image.at(size_.x / 2, 0) = glm::vec4(1.0f);
        return image;
    }

  private:
    glm::ivec2 size_;
    bool is_grey_;
};

struct Spot {
    glm::ivec2 image, origin;
};

/// A presenter of all levels.
struct SignalBench {
    DisplaySettings settings;
    ScreenGeometry geometry;
    ScreenSettings screens;
    VirtualClock clock;
    AllLevels pages;
    std::unique_ptr<DisplaySurface> surface;
    std::unique_ptr<PagePresenter> presenter;

    SignalBench(GlContext& context, OutputMode mode, const Spot& place, glm::ivec2 screen = {640, 300},
                Dithering dither = Dithering::none, double gamma = 1.0, int onset_trigger = 0)
        : pages(place.image, is_grey(mode)) {
        settings.output = mode;
        settings.dither = dither;
        settings.gamma = gamma;
        settings.background = 0.2;
        settings.onset_trigger = onset_trigger;
        settings.width_px = screen.x;
        settings.height_px = screen.y;
        geometry.screen_px = screen;
        geometry.image_px = place.image;
        geometry.image_origin_px = place.origin;
        // Only windows have a framebuffer of their own.
        auto* window = dynamic_cast<WindowContext*>(&context);
        if (window)
            surface = std::make_unique<WindowDisplay>(*window, clock, 120.0, true);
        else
            surface = std::make_unique<VirtualDisplay>(context, clock, 120.0, row_of(mode).framebuffer_bits);
        presenter = std::make_unique<PagePresenter>(context, *surface, pages, geometry, settings, screens);
        presenter->load_frames({0, 0});
    }

    SignalFindings check(int page, const std::vector<std::byte>& bytes) const {
        const LinearImage picture = pages.page({0, 0}, page);
        return check_signal({geometry.screen_px, bytes}, settings, {&picture, geometry.image_origin_px});
    }
    ReceivedMessages messages() const {
        const std::vector<std::byte> bytes = presenter->read_canvas();
        return receive_messages({geometry.screen_px, bytes});
    }
};

} // namespace overt::test
