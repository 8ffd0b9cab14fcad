#include "render/page_presenter.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <catch2/catch.hpp>

#include "devices/clocks.h"
#include "experiment/error.h"
#include "experiment/random.h"
#include "render/dither_tile.h"
#include "render/wire_check.h"
#include "support/gl_contexts.h"
#include "support/virtual_screen.h"

using namespace overt;

namespace {

constexpr glm::ivec2 screen_px{96, 54}, image_px{32, 32};

/// Pages of one plain colour each: red is the page's number over 255, green the sculpture's.
class PlainPages final : public FrameSource {
  public:
    std::vector<int> page_of_frame(const Condition&) const override { return {0, 1, 2, 1, 0}; }
    LinearImage page(const Condition& condition, int page) const override {
        LinearImage image(image_px);
        for (glm::vec4& pixel : image.pixels)
            pixel = {static_cast<float>(page + 1) / 255.0f, static_cast<float>(condition.sculpture) / 255.0f,
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

int red_at(const std::vector<std::byte>& canvas, glm::ivec2 pixel) {
    return std::to_integer<int>(canvas[static_cast<std::size_t>(pixel.y * screen_px.x + pixel.x) * 4]);
}

} // namespace

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

namespace {

constexpr OutputMode every_mode[] = {OutputMode::native_8bit,    OutputMode::native_10bit,
                                     OutputMode::mono_plus_plus, OutputMode::color_plus_plus,
                                     OutputMode::bits_plus_plus, OutputMode::vpixx_m16,
                                     OutputMode::vpixx_c48};

/// Page 0: all 65,536 levels of each channel, each twice side by side, in three different orders, except that
/// one that holds a grey has all three alike. Page 1: random light, some of it beyond the display. Page 2:
/// the background, but for one pixel.
class AllLevels final : public FrameSource {
  public:
    AllLevels(glm::ivec2 size, bool is_grey) : size_(size), is_grey_(is_grey) {}
    std::vector<int> page_of_frame(const Condition&) const override { return {0, 1, 2}; }
    LinearImage page(const Condition&, int page) const override {
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

bool is_grey(OutputMode mode) {
    return mode == OutputMode::mono_plus_plus || mode == OutputMode::bits_plus_plus ||
           mode == OutputMode::vpixx_m16;
}

struct Spot {
    glm::ivec2 image, origin;
};

/// A presenter of all levels.
struct Wire {
    DisplaySettings settings;
    ScreenGeometry geometry;
    ScreenSettings screens;
    VirtualClock clock;
    AllLevels pages;
    std::unique_ptr<DisplaySurface> surface;
    std::unique_ptr<PagePresenter> presenter;

    Wire(GlContext& context, OutputMode mode, const Spot& place, glm::ivec2 screen = {640, 300},
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
            surface = std::make_unique<VirtualDisplay>(context, clock, 120.0,
                                                       mode == OutputMode::native_10bit ? 10 : 8);
        presenter = std::make_unique<PagePresenter>(context, *surface, pages, geometry, settings, screens);
        presenter->load_frames({0, 0});
    }

    WireFindings check(int page, const std::vector<std::byte>& bytes) const {
        const LinearImage picture = pages.page({0, 0}, page);
        return check_wire({geometry.screen_px, bytes}, settings, {&picture, geometry.image_origin_px});
    }
    ReceivedMessages messages() const {
        const std::vector<std::byte> bytes = presenter->read_canvas();
        return receive_messages({geometry.screen_px, bytes});
    }
};

void check_all_levels(GlContext& context, OutputMode mode, glm::ivec2 screen) {
    // 512 x 256 hold each level twice; the others stand at odd places, have odd sizes and touch the borders.
    const Spot places[] = {{{512, 256}, {64, 10}},
                           {{333, 77}, {101, 5}},
                           {{1, 5}, {screen.x - 1, 3}},
                           {{37, 9}, {0, screen.y - 9}}};
    for (const Spot& place : places) {
        Wire wire(context, mode, place, screen);
        for (int page = 0; page < 3; ++page) {
            wire.presenter->flip({page});
            const WireFindings found = wire.check(page, wire.presenter->read_canvas());
            CAPTURE(static_cast<int>(mode), place.image.x, page, found.first);
            CHECK(found.compared > 0);
            CHECK(found.different == 0);
        }
    }
}

} // namespace

TEST_CASE("all levels, random light and edges arrive as predicted, in every mode and headless context",
          "[gl]") {
    for (const ContextKind kind : test::headless_kinds()) {
        const auto context = make_headless_context(kind);
        for (const OutputMode mode : every_mode)
            check_all_levels(*context, mode, {640, 300});
    }
}

TEST_CASE("all levels arrive in a window's back buffer, and a window of 8 bits is refused for 10", "[gl]") {
    const auto screen = test::VirtualScreen::start(640, 300, 24);
    if (!screen)
        return;
    WindowContext window({{640, 300}, "test"});
    for (const OutputMode mode : every_mode) {
        if (mode == OutputMode::native_10bit)
            CHECK_THROWS_AS((Wire{window, mode, Spot{{8, 8}, {0, 8}}}), GraphicsError);
        else
            check_all_levels(window, mode, {640, 300});
    }
}

TEST_CASE("all levels arrive in a window of 10 bits, and the packed modes refuse it", "[gl]") {
    const auto screen = test::VirtualScreen::start(640, 300, 30);
    if (!screen)
        return;
    WindowRequest request{{640, 300}, "test"};
    request.bits_per_channel = 10;
    WindowContext window(request);
    if (window.bits_per_channel() != 10)
        return;
    check_all_levels(window, OutputMode::native_10bit, {640, 300});
    CHECK_THROWS_AS((Wire{window, OutputMode::color_plus_plus, Spot{{8, 8}, {0, 8}}}), GraphicsError);
}

TEST_CASE("with a display's exponent, too, every value is the predicted one", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    for (const OutputMode mode : every_mode) {
        for (const double gamma : {0.45, 2.2}) {
            Wire wire(*context, mode, {{512, 256}, {64, 10}}, {640, 300}, Dithering::none, gamma);
            for (int page = 0; page < 2; ++page) {
                const WireFindings found = wire.check(page, wire.presenter->read_page(page));
                CAPTURE(static_cast<int>(mode), gamma, found.first);
                CHECK(found.different == 0);
            }
        }
    }
}

TEST_CASE("stimuli that cover rows of messages, leave the screen or split its last pair are refused",
          "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    const auto make = [&](OutputMode mode, Spot place, glm::ivec2 screen) {
        Wire(*context, mode, place, screen);
    };
    const Spot top{{8, 8}, {0, 2}}, low{{8, 8}, {0, 293}}, sound{{8, 8}, {0, 8}};
    CHECK_THROWS_AS(make(OutputMode::color_plus_plus, top, {640, 300}), GraphicsError);
    CHECK_NOTHROW(make(OutputMode::vpixx_c48, top, {640, 300}));
    CHECK_NOTHROW(make(OutputMode::native_8bit, top, {640, 300}));
    CHECK_THROWS_AS(make(OutputMode::native_8bit, low, {640, 300}), GraphicsError);
    CHECK_THROWS_AS(make(OutputMode::color_plus_plus, sound, {641, 300}), GraphicsError);
    CHECK_THROWS_AS(make(OutputMode::bits_plus_plus, sound, {500, 300}), GraphicsError);
}

TEST_CASE("a message stands in its row for the flip it belongs to, and is gone at the next", "[gl]") {
    for (const ContextKind kind : test::headless_kinds()) {
        const auto context = make_headless_context(kind);
        for (const OutputMode mode :
             {OutputMode::mono_plus_plus, OutputMode::color_plus_plus, OutputMode::bits_plus_plus}) {
            Wire wire(*context, mode, {{32, 32}, {100, 100}});
            PagePresenter& presenter = *wire.presenter;
            presenter.flip({1});
            CHECK(wire.messages().packets.empty());
            presenter.send_with_next_flip(t_lock::clock_reset_row, t_lock::clock_reset());
            presenter.send_with_next_flip(t_lock::outputs_row, t_lock::pulse(5, 1.0, 2.0));
            presenter.flip({1});
            const ReceivedMessages sent = wire.messages();
            CHECK(sent.faults.empty());
            REQUIRE(sent.packets.size() == 2);
            CHECK(sent.packets[0].row == 1);
            CHECK(sent.packets[0].command == 12);
            CHECK(sent.packets[1].row == 2);
            const auto pulses = pulses_of(sent.packets[1]);
            REQUIRE(pulses.size() == 2);
            CHECK(pulses[1].line == 2);
            CHECK(pulses[1].begin_ms == Approx(1.0));
            CHECK(pulses[1].end_ms == Approx(3.0));
            // The picture is untouched by it, and the table of Bits++ is there each time.
            CHECK(wire.check(1, presenter.read_canvas()).different == 0);
            CHECK(sent.tables.size() == (mode == OutputMode::bits_plus_plus ? 1 : 0));
            presenter.flip({1});
            const ReceivedMessages next = wire.messages();
            CHECK(next.packets.empty());
            CHECK(next.tables.size() == sent.tables.size());
            CHECK(wire.check(1, presenter.read_canvas()).different == 0);
        }
    }
}

TEST_CASE("the onset trigger goes with the first refresh of each presentation, and only with it", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    Wire wire(*context, OutputMode::color_plus_plus, {{32, 32}, {100, 100}}, {640, 300}, Dithering::none, 1.0,
              0b10000010);
    for (int presentation = 0; presentation < 2; ++presentation) {
        wire.presenter->show({});
        CHECK(wire.messages().packets.empty());
        wire.presenter->flip({0});
        const ReceivedMessages onset = wire.messages();
        REQUIRE(onset.packets.size() == 1);
        const auto pulses = pulses_of(onset.packets[0]);
        REQUIRE(pulses.size() == 2);
        CHECK(pulses[0].line == 1);
        CHECK(pulses[1].line == 7);
        CHECK(pulses[0].end_ms == Approx(5.0));
        for (const int frame : {0, 1, 2}) {
            wire.presenter->flip({frame});
            CHECK(wire.messages().packets.empty());
        }
    }
}

TEST_CASE("the top left pixel raises a VPixx device's outputs for the first refresh of a presentation",
          "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    for (const OutputMode mode : {OutputMode::vpixx_m16, OutputMode::vpixx_c48}) {
        Wire wire(*context, mode, {{32, 32}, {100, 100}}, {640, 300}, Dithering::none, 1.0, 0x8142a5);
        for (int presentation = 0; presentation < 2; ++presentation) {
            wire.presenter->show({});
            CHECK(wire.messages().pixel_mode_outputs == 0);
            wire.presenter->flip({1});
            CHECK(wire.messages().pixel_mode_outputs == 0x8142a5);
            const std::vector<std::byte> bytes = wire.presenter->read_canvas();
            CHECK(bytes[0] == std::byte{0xa5});
            CHECK(bytes[1] == std::byte{0x42});
            CHECK(bytes[2] == std::byte{0x81});
            for (const int frame : {1, 2}) {
                wire.presenter->flip({frame});
                CHECK(wire.messages().pixel_mode_outputs == 0);
            }
        }
    }
}

TEST_CASE("PSYNC counts the refreshes on a black row", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    for (const OutputMode mode : {OutputMode::vpixx_m16, OutputMode::vpixx_c48}) {
        Wire wire(*context, mode, {{32, 32}, {100, 100}});
        for (int refresh = 0; refresh < 300; ++refresh) {
            wire.presenter->flip({refresh % 3});
            if (refresh % 37 == 0)
                CHECK(wire.messages().psync_count == (refresh + 1) % 256);
        }
        const std::vector<std::byte> bytes = wire.presenter->read_canvas();
        for (std::size_t x = 0; x < 640; ++x) {
            if (x < 10 || x >= 18) {
                for (std::size_t channel = 0; channel < 3; ++channel)
                    CHECK(bytes[4 * x + channel] == std::byte{0});
            }
        }
    }
}

namespace {

/// One page for each of some levels, plain all over.
class PlainLight final : public FrameSource {
  public:
    PlainLight(glm::ivec2 size, std::vector<double> light) : size_(size), light_(std::move(light)) {}
    std::vector<int> page_of_frame(const Condition&) const override {
        std::vector<int> pages(light_.size());
        std::iota(pages.begin(), pages.end(), 0);
        return pages;
    }
    LinearImage page(const Condition&, int page) const override {
        LinearImage image(size_);
        const float light = static_cast<float>(light_[static_cast<std::size_t>(page)]);
        std::fill(image.pixels.begin(), image.pixels.end(),
                  glm::vec4(light, 0.5f * light, 1.0f - light, 1.0f));
        return image;
    }

  private:
    glm::ivec2 size_;
    std::vector<double> light_;
};

} // namespace

TEST_CASE("dithering keeps the mean of every 64 x 64 patch to half a code of 16 bits, in every refresh",
          "[gl]") {
    std::vector<double> light{0.0, 1.0, 1e-5, 0.999999};
    RandomStream random(3, "greys");
    for (int i = 0; i < 12; ++i)
        light.push_back(random.uniform());
    const glm::ivec2 screen{128, 128};
    PlainLight pages(screen, light);
    for (const ContextKind kind : test::headless_kinds()) {
        const auto context = make_headless_context(kind);
        for (const OutputMode mode : {OutputMode::native_8bit, OutputMode::native_10bit}) {
            for (const Dithering dither : {Dithering::ordered, Dithering::blue_noise}) {
                DisplaySettings settings;
                settings.output = mode;
                settings.dither = dither;
                settings.width_px = screen.x;
                settings.height_px = screen.y;
                ScreenGeometry geometry;
                geometry.screen_px = geometry.image_px = screen;
                geometry.image_origin_px = {0, 0};
                VirtualClock clock;
                VirtualDisplay display(*context, clock, 120.0, mode == OutputMode::native_10bit ? 10 : 8);
                PagePresenter presenter(*context, display, pages, geometry, settings, {});
                presenter.load_frames({0, 0});
                double worst = 0.0;
                for (int page = 0; page < presenter.pages(); ++page) {
                    for (int refresh = 0; refresh < 3; ++refresh) {
                        presenter.flip({page});
                        const auto bytes = presenter.read_canvas();
                        const LinearImage picture = pages.page({0, 0}, page);
                        const WireFindings found = check_wire({screen, bytes}, settings, {&picture, {0, 0}});
                        CHECK(found.different == 0);
                        worst = std::max(worst, found.largest_mean_error);
                    }
                }
                CAPTURE(static_cast<int>(mode), static_cast<int>(dither));
                CHECK(worst <= 0.5);
                CHECK(worst > 0.0);
            }
        }
    }
}

TEST_CASE("over 4096 refreshes dithering keeps each pixel's own mean to half a code of 16 bits", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    const glm::ivec2 screen{16, 16};
    DisplaySettings settings;
    settings.output = OutputMode::native_8bit;
    settings.dither = Dithering::blue_noise;
    const WirePass pass(*context, settings);
    Texture2D codes(*context, screen, PixelFormat::rgba16);
    std::vector<std::uint16_t> content(4 * 256);
    RandomStream random(4, "codes");
    for (std::uint16_t& code : content)
        code = static_cast<std::uint16_t>(random.below(65536));
    codes.upload(std::as_bytes(std::span(content)));
    Texture2D wire(*context, screen, PixelFormat::rgba8);
    const Framebuffer target(*context, {&wire}, false);
    std::vector<double> sums(content.size(), 0.0), short_sums;
    std::vector<std::byte> bytes(content.size());
    for (int refresh = 0; refresh < 4096; ++refresh) {
        pass.draw(codes, target, refresh);
        read_pixels(*context, 0, {0, 0}, screen, PixelFormat::rgba8, bytes);
        for (std::size_t i = 0; i < sums.size(); ++i)
            sums[i] += std::to_integer<int>(bytes[i]);
        if (refresh == 63)
            short_sums = sums;
    }
    double worst = 0.0, worst_short = 0.0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        if (i % 4 == 3)
            continue;
        worst = std::max(worst, std::abs(257.0 * sums[i] / 4096.0 - content[i]));
        worst_short = std::max(worst_short, std::abs(257.0 * short_sums[i] / 64.0 - content[i]));
    }
    CHECK(worst <= 0.5);
    // Half a second at 120 Hz already comes within a few hundredths of a level of 8 bits.
    CHECK(worst_short <= 0.05 * 257.0);
}

TEST_CASE("each tile holds every rank once, and blue noise has little of the coarse noise that is seen",
          "[unit]") {
    const auto coarse_power = [](const std::vector<std::uint32_t>& ranks) {
        // Variance of the mean of 8 x 8 blocks, of the pattern that a tenth of full light makes.
        double variance = 0.0;
        for (int by = 0; by < 64; by += 8) {
            for (int bx = 0; bx < 64; bx += 8) {
                int lit = 0;
                for (int i = 0; i < 64; ++i)
                    lit += ranks[static_cast<std::size_t>((by + i / 8) * 64 + bx + i % 8)] < 410;
                variance += (lit - 6.4) * (lit - 6.4) / 64.0;
            }
        }
        return variance;
    };
    RandomStream random(8, "white");
    std::vector<std::uint32_t> white(4096);
    std::iota(white.begin(), white.end(), 0u);
    random.shuffle(std::span(white));
    for (const Dithering dither : {Dithering::ordered, Dithering::blue_noise}) {
        std::vector<std::uint32_t> ranks = make_dither_tile(dither);
        CHECK(coarse_power(ranks) < 0.2 * coarse_power(white));
        std::sort(ranks.begin(), ranks.end());
        for (std::uint32_t i = 0; i < 4096; ++i)
            REQUIRE(ranks[i] == i);
    }
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
