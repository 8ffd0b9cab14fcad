/// Several stimuli at once, each in its slot, as the bytes that the display gets.
#include "render/presenter/page_presenter.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "devices/host/clocks.h"
#include "experiment/base/random.h"
#include "render/gl/headless_context.h"
#include "tests/support/gl_contexts.h"

using namespace overt;

namespace {

constexpr glm::ivec2 screen_of_slots_px{640, 60}, slot_px{30, 40};

/// Random light, another in each page of each object.
class NoisyPages final : public FrameSource {
  public:
    std::vector<int> page_of_frame(const Stimulus&) const override { return {0, 1, 0}; }
    LinearImage page(const Stimulus& stimulus, int page) const override {
        LinearImage image(slot_px);
        RandomStream random(static_cast<std::uint64_t>(10 * stimulus.object + page), "light");
        for (glm::vec4& pixel : image.pixels) {
            const auto light = [&] { return static_cast<float>(random.uniform()); };
            const float red = light(), green = light(), blue = light();
            pixel = {red, green, blue, 1.0f};
        }
        return image;
    }
};

struct ScreenOfSlots {
    DisplaySettings settings;
    NoisyPages pages;
    VirtualClock clock;
    VirtualDisplay display;
    PagePresenter presenter;

    ScreenOfSlots(const GlContext& context, const DisplaySettings& display_settings, glm::ivec2 image_origin,
                  const std::vector<glm::ivec2>& slots)
        : settings(display_settings),
          display(context, clock, 120.0, row_of(display_settings.output).framebuffer_bits),
          presenter(context, display, pages, geometry_at(image_origin), settings, {}, places_at(slots)) {}

    static std::vector<ImageBox> places_at(const std::vector<glm::ivec2>& origins) {
        std::vector<ImageBox> places;
        for (const glm::ivec2 origin : origins)
            places.push_back({origin, slot_px});
        return places;
    }

    static ScreenGeometry geometry_at(glm::ivec2 origin) {
        ScreenGeometry geometry;
        geometry.screen_px = screen_of_slots_px;
        geometry.image_px = slot_px;
        geometry.image_origin_px = origin;
        return geometry;
    }
    std::vector<std::byte> canvas_with(std::span<const PlacedStimulus> shown,
                                       std::span<const AnimationFrameIndex> frames) {
        presenter.load_slots(shown);
        presenter.flip_slots(frames);
        return presenter.read_canvas();
    }
};

/// The left half of one screen and the right half of another.
std::vector<std::byte> halves_of(const std::vector<std::byte>& left, const std::vector<std::byte>& right) {
    std::vector<std::byte> joined = left;
    const std::size_t row_bytes = left.size() / static_cast<std::size_t>(screen_of_slots_px.y);
    for (std::size_t i = 0; i < joined.size(); ++i)
        if (i % row_bytes >= row_bytes / 2)
            joined[i] = right[i];
    return joined;
}

} // namespace

TEST_CASE("two slots show, to the byte, what each shows alone", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    const glm::ivec2 left{102, 10}, right{500, 14};
    struct Way {
        OutputMode output;
        PairFilter filter = PairFilter::box;
        Dithering dither = Dithering::none;
    };
    for (const Way& way :
         {Way{OutputMode::native_8bit}, Way{OutputMode::native_8bit, PairFilter::box, Dithering::blue_noise},
          Way{OutputMode::mono_plus_plus}, Way{OutputMode::color_plus_plus},
          Way{OutputMode::color_plus_plus, PairFilter::lanczos}, Way{OutputMode::bits_plus_plus}}) {
        CAPTURE(name_of(way.output), name_of(way.filter), name_of(way.dither));
        DisplaySettings settings;
        settings.width_px = screen_of_slots_px.x;
        settings.height_px = screen_of_slots_px.y;
        settings.output = way.output;
        settings.pair_filter = way.filter;
        settings.dither = way.dither;
        settings.background = 0.3;
        ScreenOfSlots both(*context, settings, left, {left, right});
        ScreenOfSlots alone_left(*context, settings, left, {}), alone_right(*context, settings, right, {});
        const Stimulus one{1, 0}, other{2, 0};
        const PlacedStimulus in_left{one, 0}, in_right{other, 1}, first{one, 0}, second{other, 0};
        const std::vector<PlacedStimulus> placed{in_left, in_right};
        const AnimationFrameIndex frame_left{1}, frame_right{2};
        const std::vector<AnimationFrameIndex> frames{frame_left, frame_right};
        CHECK(both.canvas_with(placed, frames) ==
              halves_of(alone_left.canvas_with({&first, 1}, {&frame_left, 1}),
                        alone_right.canvas_with({&second, 1}, {&frame_right, 1})));
        // Both go on by themselves; then one is empty.
        const AnimationFrameIndex next_left{0};
        CHECK(both.canvas_with(placed, std::vector{next_left, frame_right}) ==
              halves_of(alone_left.canvas_with({&first, 1}, {&next_left, 1}),
                        alone_right.canvas_with({&second, 1}, {&frame_right, 1})));
        CHECK(both.canvas_with(placed, std::vector{no_frame, frame_right}) ==
              halves_of(alone_left.canvas_with({&first, 1}, {&no_frame, 1}),
                        alone_right.canvas_with({&second, 1}, {&frame_right, 1})));
        // The same in the other slots.
        const std::vector<PlacedStimulus> turned{{other, 0}, {one, 1}};
        ScreenOfSlots other_left(*context, settings, left, {}), other_right(*context, settings, right, {});
        CHECK(ScreenOfSlots(*context, settings, left, {left, right}).canvas_with(turned, frames) ==
              halves_of(other_left.canvas_with({&second, 1}, {&frame_left, 1}),
                        other_right.canvas_with({&first, 1}, {&frame_right, 1})));
    }
}

TEST_CASE("slots with the same stimulus share its pages, and a screen between clears them all", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    DisplaySettings settings;
    settings.width_px = screen_of_slots_px.x;
    settings.height_px = screen_of_slots_px.y;
    settings.output = OutputMode::native_8bit;
    const std::vector<glm::ivec2> places{{10, 5}, {60, 5}, {110, 5}};
    ScreenOfSlots screen(*context, settings, places[0], places);
    const std::vector<PlacedStimulus> same{{{1, 0}, 0}, {{1, 0}, 1}, {{1, 0}, 2}};
    const std::vector<AnimationFrameIndex> frames{{0}, {1}, {0}};
    const auto shown = screen.canvas_with(same, frames);
    CHECK(screen.presenter.pages() == 2);
    const std::vector<PlacedStimulus> two{{{1, 0}, 2}, {{4, 0}, 0}};
    screen.presenter.load_slots(two);
    CHECK(screen.presenter.pages() == 4);
    screen.presenter.load_slots(same);
    screen.presenter.show({});
    const auto blank = screen.presenter.read_canvas();
    CHECK(blank != shown);
    CHECK(screen.canvas_with(same, frames) == shown);
    CHECK(screen.canvas_with(same, std::vector{no_frame, no_frame, no_frame}) == blank);
}

TEST_CASE("of two slots at one place the one that comes up covers the one that goes", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    DisplaySettings settings;
    settings.width_px = screen_of_slots_px.x;
    settings.height_px = screen_of_slots_px.y;
    settings.output = OutputMode::native_8bit;
    const glm::ivec2 place{102, 10};
    ScreenOfSlots both(*context, settings, place, {place, place}), alone(*context, settings, place, {});
    const std::vector<PlacedStimulus> placed{{{1, 0}, 0}, {{2, 0}, 1}};
    const AnimationFrameIndex frame{1};
    for (const std::size_t lit : {0, 1, 0, 1}) {
        std::vector<AnimationFrameIndex> frames{no_frame, no_frame};
        frames[lit] = frame;
        const PlacedStimulus only{placed[lit].stimulus, 0};
        CHECK(both.canvas_with(placed, frames) == alone.canvas_with({&only, 1}, {&frame, 1}));
    }
}

TEST_CASE("a scrambled mask has the squares of what was shown last, in another order", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    DisplaySettings settings;
    settings.width_px = screen_of_slots_px.x;
    settings.height_px = screen_of_slots_px.y;
    settings.output = OutputMode::native_8bit;
    const glm::ivec2 left{102, 10}, right{500, 14};
    ScreenOfSlots screen(*context, settings, left, {left, right});
    const std::vector<PlacedStimulus> placed{{{1, 0}, 0}, {{2, 0}, 1}};
    const auto shown = screen.canvas_with(placed, std::vector<AnimationFrameIndex>{{1}, {1}});
    screen.presenter.show({});
    const auto blank = screen.presenter.read_canvas();
    Screen mask{.kind = Screen::Kind::scrambled, .text = ""};
    mask.noise_seed = 5;
    mask.noise_cell = Degrees{0.001}; // the smallest: squares of two pixels
    mask.places = {1};
    screen.presenter.show(mask);
    const auto masked = screen.presenter.read_canvas();
    const auto squares_of = [&](const std::vector<std::byte>& bytes, glm::ivec2 corner) {
        std::vector<std::vector<std::byte>> squares;
        for (int y = 0; y < slot_px.y; y += 2)
            for (int x = 0; x < slot_px.x; x += 2) {
                auto& square = squares.emplace_back();
                for (int row = 0; row < 2; ++row) {
                    const auto first =
                        bytes.begin() + 4 * ((corner.y + y + row) * screen_of_slots_px.x + corner.x + x);
                    square.insert(square.end(), first, first + 8);
                }
            }
        return squares;
    };
    auto of_mask = squares_of(masked, right), of_shown = squares_of(shown, right);
    CHECK(of_mask != of_shown);
    std::ranges::sort(of_mask);
    std::ranges::sort(of_shown);
    CHECK(of_mask == of_shown);
    // The other slot is dark, and the same seed gives the same.
    CHECK(squares_of(masked, left) == squares_of(blank, left));
    screen.presenter.show(mask);
    CHECK(screen.presenter.read_canvas() == masked);
    mask.noise_seed = 6;
    screen.presenter.show(mask);
    CHECK(screen.presenter.read_canvas() != masked);
}
