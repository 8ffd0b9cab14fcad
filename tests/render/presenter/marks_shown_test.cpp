/// Marks over stimuli, as the bytes that the display gets.
#include "render/presenter/page_presenter.h"

#include <algorithm>
#include <cstring>

#include <catch2/catch.hpp>

#include "devices/host/clocks.h"
#include "render/gl/headless_context.h"
#include "tests/support/gl_contexts.h"

using namespace overt;

namespace {

constexpr glm::ivec2 marked_screen_px{544, 96}, marked_image_px{64, 64}, marked_origin_px{96, 16};

/// One light in each frame.
class MarkedPages final : public FrameSource {
  public:
    std::vector<int> page_of_frame(const Stimulus&) const override { return {0, 1}; }
    LinearImage page(const Stimulus&, int page) const override {
        LinearImage image(marked_image_px);
        std::ranges::fill(image.pixels, glm::vec4(page == 0 ? 0.25f : 0.5f, 0.25f, 0.25f, 1.0f));
        return image;
    }
};

struct MarkedScreen {
    DisplaySettings settings;
    MarkedPages pages;
    VirtualClock clock;
    VirtualDisplay display;
    PagePresenter presenter;

    MarkedScreen(const GlContext& context, OutputMode output)
        : settings(settings_with(output)), display(context, clock, 120.0, row_of(output).framebuffer_bits),
          presenter(context, display, pages, geometry(), settings, {}) {
        presenter.load_frames({});
    }
    static DisplaySettings settings_with(OutputMode output) {
        DisplaySettings settings;
        settings.width_px = marked_screen_px.x;
        settings.height_px = marked_screen_px.y;
        settings.output = output;
        settings.background = 0.1;
        return settings;
    }
    static ScreenGeometry geometry() {
        ScreenGeometry geometry;
        geometry.screen_px = marked_screen_px;
        geometry.image_px = marked_image_px;
        geometry.image_origin_px = marked_origin_px;
        return geometry;
    }
    std::vector<std::byte> flipped(int frame) {
        presenter.flip(AnimationFrameIndex{frame});
        return presenter.read_canvas();
    }
};

StimulusMark dot_at(double x_px, double y_px, double width_px) {
    StimulusMark mark;
    mark.count = 1;
    mark.lines[0].count = 1;
    mark.lines[0].points[0] = {x_px, y_px};
    mark.lines[0].width_px = width_px;
    mark.light = {0.8, 0.8, 0.8};
    mark.rim_px = 0.0;
    return mark;
}

bool is_pixel_alike(const std::vector<std::byte>& a, const std::vector<std::byte>& b, int x, int y) {
    const auto at = static_cast<std::size_t>(4 * (y * marked_screen_px.x + x));
    return std::equal(a.begin() + static_cast<std::ptrdiff_t>(at),
                      a.begin() + static_cast<std::ptrdiff_t>(at) + 4,
                      b.begin() + static_cast<std::ptrdiff_t>(at));
}

/// How many pixels of two screens differ within the image, and whether any does elsewhere.
std::pair<int, bool> pixels_apart(const std::vector<std::byte>& a, const std::vector<std::byte>& b) {
    int inside = 0;
    bool any_outside = false;
    const glm::ivec2 end = marked_origin_px + marked_image_px;
    for (int y = 4; y < marked_screen_px.y; ++y) // rows of messages change with each refresh
        for (int x = 0; x < marked_screen_px.x; ++x) {
            if (is_pixel_alike(a, b, x, y))
                continue;
            const bool is_inside =
                x >= marked_origin_px.x && y >= marked_origin_px.y && x < end.x && y < end.y;
            inside += is_inside;
            any_outside = any_outside || !is_inside;
        }
    return {inside, any_outside};
}

} // namespace

TEST_CASE("a mark is drawn over its picture alone, and goes without a trace", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    for (const OutputMode output : {OutputMode::native_8bit, OutputMode::mono_plus_plus,
                                    OutputMode::color_plus_plus, OutputMode::bits_plus_plus}) {
        CAPTURE(name_of(output));
        MarkedScreen screen(*context, output);
        const std::vector<std::byte> plain = screen.flipped(0), other = screen.flipped(1);
        const StimulusMark dot = dot_at(128.0, 48.0, 20.0);
        screen.presenter.mark_stimuli({&dot, 1});
        const auto [inside, is_outside] = pixels_apart(plain, screen.flipped(0));
        // A disc of 20 px has 314; pixels that share a colour are drawn or left together.
        CHECK(inside >= 290);
        CHECK(inside <= 340);
        CHECK_FALSE(is_outside);
        // It stays with the next frame, moves, and goes.
        CHECK(pixels_apart(other, screen.flipped(1)).first == inside);
        const StimulusMark moved = dot_at(140.0, 40.0, 20.0);
        screen.presenter.mark_stimuli({&moved, 1});
        const std::vector<std::byte> after = screen.flipped(1);
        CHECK(pixels_apart(other, after).first >= 290);
        CHECK(pixels_apart(other, after).first <= 340);
        screen.presenter.mark_stimuli({});
        CHECK(pixels_apart(other, screen.flipped(1)) == std::pair(0, false));
        CHECK(pixels_apart(plain, screen.flipped(0)) == std::pair(0, false));
    }
}

TEST_CASE("a mark's light is encoded as that of a picture, and is cut off at the image's edge", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    for (const OutputMode output : {OutputMode::native_8bit, OutputMode::color_plus_plus}) {
        CAPTURE(name_of(output));
        MarkedScreen screen(*context, output);
        const std::vector<std::byte> plain = screen.flipped(0);
        // As large as the image and larger: all of it has the mark's light.
        StimulusMark wide = dot_at(128.0, 48.0, 400.0);
        wide.light = {0.25, 0.25, 0.25};
        screen.presenter.mark_stimuli({&wide, 1});
        CHECK(pixels_apart(plain, screen.flipped(0)) == std::pair(0, false));
        wide.light = {0.5, 0.25, 0.25};
        screen.presenter.mark_stimuli({&wide, 1});
        const std::vector<std::byte> marked = screen.flipped(0);
        screen.presenter.mark_stimuli({});
        CHECK(pixels_apart(screen.flipped(1), marked) == std::pair(0, false));
    }
}

TEST_CASE("lines have their width, and a rim around them", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    MarkedScreen screen(*context, OutputMode::native_8bit);
    const std::vector<std::byte> plain = screen.flipped(0);
    StimulusMark line = dot_at(0.0, 0.0, 4.0);
    line.lines[0].count = 2;
    line.lines[0].points[0] = {110.0, 30.0};
    line.lines[0].points[1] = {150.0, 30.0};
    screen.presenter.mark_stimuli({&line, 1});
    // A rectangle of 40 x 4 with round ends of a radius of 2.
    CHECK(pixels_apart(plain, screen.flipped(0)).first == Approx(160 + 12).margin(8));
    line.rim_px = 2.0;
    screen.presenter.mark_stimuli({&line, 1});
    const std::vector<std::byte> rimmed = screen.flipped(0);
    CHECK(pixels_apart(plain, rimmed).first == Approx(320 + 50).margin(14));
    const auto at = static_cast<std::size_t>(4 * (27 * marked_screen_px.x + 130));
    CHECK(rimmed[at] == std::byte{0}); // dark
}
