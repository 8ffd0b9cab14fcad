#include "render/page_presenter.h"

#include <catch2/catch.hpp>

#include "devices/clocks.h"
#include "experiment/error.h"
#include "support/gl_contexts.h"

using namespace overt;

namespace {

constexpr glm::ivec2 screen_px{96, 54}, image_px{32, 32};

/// Pages of one plain colour each: red is the page's number over 255, green the sculpture's.
class PlainPages final : public FrameSource {
  public:
    std::vector<int> page_of_frame(const Condition&) const override { return {0, 1, 2, 1, 0}; }
    LinearImage page(const Condition& condition, int page) const override {
        LinearImage image(image_px);
        for (glm::vec4& pixel : image.pixels) pixel = {static_cast<float>(page + 1) / 255.0f, static_cast<float>(condition.sculpture) / 255.0f, 0.0f, 1.0f};
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

int red_at(const std::vector<std::byte>& canvas, glm::ivec2 pixel) {
    return std::to_integer<int>(canvas[static_cast<std::size_t>(pixel.y * screen_px.x + pixel.x) * 4]);
}

} // namespace

TEST_CASE("the presenter shows each frame's page in its place on the background", "[gl]") {
    Bench bench;
    PagePresenter presenter(*bench.context, bench.display, bench.pages, bench.geometry, bench.settings, bench.screens);
    presenter.load_frames({0, 0});
    const std::vector<int> expected{1, 2, 3, 2, 1};
    for (int frame = 0; frame < 5; ++frame) {
        presenter.flip({frame});
        const auto canvas = presenter.read_canvas();
        const glm::ivec2 origin = bench.geometry.image_origin_px;
        for (const glm::ivec2 inside : {origin, origin + image_px - 1, origin + image_px / 2}) {
            CHECK(red_at(canvas, inside) == expected[static_cast<std::size_t>(frame)]);
        }
        for (const glm::ivec2 outside : {origin - 1, origin + image_px, glm::ivec2(0), screen_px - 1}) CHECK(red_at(canvas, outside) == 10);
    }
}

TEST_CASE("a text is gone from the screen when a frame is shown, and a frame when a text is", "[gl]") {
    Bench bench;
    bench.screens.text_height_deg = 0.2;
    PagePresenter presenter(*bench.context, bench.display, bench.pages, bench.geometry, bench.settings, bench.screens);
    presenter.load_frames({0, 0});
    presenter.flip({2});
    presenter.show({Screen::Kind::text, "what is it?"});
    auto canvas = presenter.read_canvas();
    CHECK(red_at(canvas, bench.geometry.image_origin_px) == 10);
    int brighter = 0;
    for (int y = 0; y < screen_px.y; ++y) {
        for (int x = 0; x < screen_px.x; ++x) brighter += red_at(canvas, {x, y}) > 40;
    }
    CHECK(brighter > 20);
    presenter.flip({2});
    canvas = presenter.read_canvas();
    for (int x = 0; x < bench.geometry.image_origin_px.x; ++x) CHECK(red_at(canvas, {x, screen_px.y / 2}) == 10);
}

TEST_CASE("the n-th flip of a virtual display is lit at the n-th refresh, and none is missed", "[gl]") {
    Bench bench;
    PagePresenter presenter(*bench.context, bench.display, bench.pages, bench.geometry, bench.settings, bench.screens);
    presenter.load_frames({0, 0});
    const FlipReport first = presenter.flip({0});
    for (int i = 1; i <= 960; ++i) {
        const FlipReport flip = presenter.flip({i % 5});
        CHECK(flip.refresh.value == first.refresh.value + i);
        CHECK(flip.missed_refreshes == 0);
        CHECK(std::abs(to_seconds(flip.vertical_blank - first.vertical_blank) - i / 120.0) < 2e-9);
    }
}

TEST_CASE("a late caller learns how many refreshes went by", "[unit]") {
    VirtualClock clock;
    VirtualRefresh refresh(clock, 100.0);
    const FlipReport first = refresh.next(clock.now());
    clock.wait_until(first.vertical_blank + std::chrono::milliseconds(35));
    const FlipReport late = refresh.next(clock.now());
    CHECK(late.missed_refreshes == 3);
    CHECK(late.refresh.value == first.refresh.value + 4);
}
