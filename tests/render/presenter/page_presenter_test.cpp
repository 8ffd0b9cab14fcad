/// What stands on the screen, and when.
#include "render/presenter/page_presenter.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/render/presenter/presenter_bench.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("the presenter shows each frame's page in its place on the background", "[gl]") {
    Bench bench;
    PagePresenter presenter(*bench.context, bench.display, bench.pages, bench.geometry, bench.settings,
                            bench.screens);
    presenter.load_frames({0, 0});
    const std::vector<int> expected{1, 2, 3, 2, 1};
    for (int frame = 0; frame < 5; ++frame) {
        presenter.flip({frame});
        const auto canvas = presenter.read_canvas();
        const glm::ivec2 origin = bench.geometry.image_origin_px;
        for (const glm::ivec2 inside : {origin, origin + image_px - 1, origin + image_px / 2}) {
            CHECK(red_at(canvas, inside) == expected[static_cast<std::size_t>(frame)]);
        }
        for (const glm::ivec2 outside : {origin - 1, origin + image_px, glm::ivec2(0), screen_px - 1})
            CHECK(red_at(canvas, outside) == 10);
    }
}

TEST_CASE("a text is gone from the screen when a frame is shown, and a frame when a text is", "[gl]") {
    Bench bench;
    bench.screens.text_height_deg = 0.2;
    PagePresenter presenter(*bench.context, bench.display, bench.pages, bench.geometry, bench.settings,
                            bench.screens);
    presenter.load_frames({0, 0});
    presenter.flip({2});
    presenter.show({Screen::Kind::text, "what is it?"});
    auto canvas = presenter.read_canvas();
    CHECK(red_at(canvas, bench.geometry.image_origin_px) == 10);
    int brighter = 0;
    for (int y = 0; y < screen_px.y; ++y) {
        for (int x = 0; x < screen_px.x; ++x)
            brighter += red_at(canvas, {x, y}) > 40;
    }
    CHECK(brighter > 20);
    presenter.flip({2});
    canvas = presenter.read_canvas();
    for (int x = 0; x < bench.geometry.image_origin_px.x; ++x)
        CHECK(red_at(canvas, {x, screen_px.y / 2}) == 10);
}

TEST_CASE("the n-th flip of a virtual display is lit at the n-th refresh, and none is missed", "[gl]") {
    Bench bench;
    PagePresenter presenter(*bench.context, bench.display, bench.pages, bench.geometry, bench.settings,
                            bench.screens);
    presenter.load_frames({0, 0});
    const FlipReport first = presenter.flip({0});
    for (int i = 1; i <= 960; ++i) {
        const FlipReport flip = presenter.flip({i % 5});
        CHECK(flip.refresh.value == first.refresh.value + i);
        CHECK(std::abs(to_seconds(flip.vertical_blank - first.vertical_blank) - i / 120.0) < 2e-9);
    }
}

TEST_CASE("a late caller learns how many refreshes went by", "[unit]") {
    VirtualClock clock;
    VirtualRefresh refresh(clock, 100.0);
    const FlipReport first = refresh.next(clock.now());
    clock.wait_until(first.vertical_blank + std::chrono::milliseconds(35));
    const FlipReport late = refresh.next(clock.now());
    CHECK(late.refresh.value == first.refresh.value + 4);
}

TEST_CASE("the square for a photodiode is white at the onset and changes with every frame, and only then",
          "[gl]") {
    Bench bench;
    bench.settings.photodiode = PatchCorner::bottom_left;
    bench.settings.photodiode_px = 8;
    PagePresenter presenter(*bench.context, bench.display, bench.pages, bench.geometry, bench.settings,
                            bench.screens);
    const glm::ivec2 first{0, screen_px.y - 8}, last{7, screen_px.y - 1};
    const auto light = [&] {
        const auto canvas = presenter.read_canvas();
        CHECK(red_at(canvas, first) == red_at(canvas, last));
        CHECK(red_at(canvas, {8, screen_px.y - 1}) == 10);
        CHECK(red_at(canvas, {0, screen_px.y - 9}) == 10);
        return red_at(canvas, first);
    };
    presenter.show({});
    CHECK(light() == 0);
    for (int presentation = 0; presentation < 2; ++presentation) {
        presenter.load_frames({0, 0});
        // Frames 1 and 3 share a page; the square tells them apart all the same.
        int expected = 255, before = 0;
        for (const int frame : {0, 0, 1, 1, 2, 3, 3, 4}) {
            if (frame != before)
                expected = 255 - expected;
            before = frame;
            presenter.flip({frame});
            CHECK(light() == expected);
        }
        presenter.show({});
        CHECK(light() == 0);
    }
    // A page that is verified stands on the background alone.
    presenter.load_frames({0, 0});
    CHECK(red_at(presenter.read_page(1), first) == 10);
}

TEST_CASE("a level meter stands below the text, moves, says what is wrong, and is gone with the screen",
          "[gl]") {
    Bench bench;
    bench.geometry.screen_px = {1200, 800};
    bench.geometry.image_origin_px = centred_origin_px(bench.geometry.screen_px, image_px);
    PagePresenter presenter(*bench.context, bench.display, bench.pages, bench.geometry, bench.settings,
                            bench.screens);
    const auto brighter = [&](int first_row, int end_row) {
        const auto canvas = presenter.read_canvas();
        long count = 0;
        for (std::size_t i = static_cast<std::size_t>(first_row) * 1200;
             i < static_cast<std::size_t>(end_row) * 1200; ++i)
            count += std::to_integer<int>(canvas[i * 4]) > 40;
        return count;
    };
    presenter.show({Screen::Kind::text, "Please answer now."});
    const long text = brighter(0, 740);
    CHECK(text > 100);
    CHECK(brighter(740, 800) == 0);
    presenter.show_level({0.2, 0.3, ""});
    const long quiet = brighter(740, 800);
    CHECK(quiet > 100);
    presenter.show_level({0.8, 0.9, ""});
    const long loud = brighter(740, 800);
    CHECK(loud > quiet + 500);
    presenter.show_level({0.8, 0.9, "too loud"});
    CHECK(brighter(740, 800) > loud + 20);
    presenter.show_level({0.2, 0.3, ""});
    CHECK(brighter(740, 800) == quiet);
    CHECK(brighter(0, 740) == text);
    presenter.show({Screen::Kind::text, "Please answer now."});
    CHECK(brighter(740, 800) == 0);
}

namespace {

/// Keeps the red of two pixels of each picture that it is given to show.
struct SeenPictures final : DisplaySurface {
    explicit SeenPictures(DisplaySurface& to) : display(&to) {}
    DisplayTiming timing() const override { return display->timing(); }
    FlipReport present(const Framebuffer& canvas) noexcept override {
        std::vector<std::byte> bytes(4 * static_cast<std::size_t>(screen_px.x * screen_px.y));
        canvas.read(PixelFormat::rgba8, bytes);
        int sum = 0;
        for (std::size_t i = 0; i < bytes.size(); i += 4)
            sum += std::to_integer<int>(bytes[i]);
        sums_of_red.push_back(sum);
        return display->present(canvas);
    }
    bool closed() const noexcept override { return false; }
    int bits_per_channel() const override { return 8; }
    void read(const Framebuffer& canvas, PixelFormat format, std::span<std::byte> into) override {
        display->read(canvas, format, into);
    }
    DisplaySurface* display;
    std::vector<int> sums_of_red;
};

} // namespace

TEST_CASE("behind a veil everything is drawn and nothing is seen", "[gl]") {
    Bench bench;
    SeenPictures seen(bench.display);
    PagePresenter presenter(*bench.context, seen, bench.pages, bench.geometry, bench.settings, bench.screens);
    presenter.load_frames({0, 0});
    presenter.flip({1});
    presenter.veil(true);
    presenter.flip({2});
    CHECK(red_at(presenter.read_canvas(), bench.geometry.image_origin_px) == 3);
    presenter.show({Screen::Kind::target, ""});
    presenter.veil(false);
    presenter.flip({1});
    REQUIRE(seen.sums_of_red.size() == 4);
    CHECK(seen.sums_of_red[0] > 0);
    CHECK(seen.sums_of_red[1] == 0);
    CHECK(seen.sums_of_red[2] == 0);
    CHECK(seen.sums_of_red[3] == seen.sums_of_red[0]);
}
