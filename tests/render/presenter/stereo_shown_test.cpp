/// Two eyes' fields, as the bytes that the display gets.
#include "render/presenter/stereo_presenter.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "devices/host/clocks.h"
#include "render/gl/headless_context.h"
#include "tests/support/gl_contexts.h"

using namespace overt;

namespace {

constexpr glm::ivec2 both_px{1056, 48}, eyes_image_px{64, 32};

/// Another light for each eye, brighter on the left than on the right.
class PagesOfEyes final : public FrameSource {
  public:
    std::vector<int> page_of_frame(const Stimulus&) const override { return {0, 1}; }
    LinearImage page(const Stimulus& of_eye, int page) const override {
        LinearImage image(eyes_image_px);
        for (int y = 0; y < image.size_px.y; ++y)
            for (int x = 0; x < image.size_px.x; ++x)
                image.at(x, y) =
                    glm::vec4(glm::vec3(0.2f + 0.3f * static_cast<float>(of_eye.view) +
                                        0.1f * static_cast<float>(page) + (x < 32 ? 0.2f : 0.0f)),
                              1.0f);
        return image;
    }
    Stimulus in_slot(const PlacedStimulus& placed, Eye eye) const override {
        Stimulus of_eye = placed.stimulus;
        of_eye.view = eye == Eye::left ? 0 : 1;
        return of_eye;
    }
};

Protocol protocol_of_eyes(OutputMode output) {
    Protocol protocol;
    protocol.display.width_px = both_px.x;
    protocol.display.height_px = both_px.y;
    protocol.display.width_mm = 528.0;
    protocol.display.height_mm = 24.0;
    protocol.display.output = output;
    protocol.display.background = 0.05;
    protocol.stereo.kind = StereoKind::mirrors;
    protocol.views.front().width_px = eyes_image_px.x;
    protocol.views.front().height_px = eyes_image_px.y;
    return protocol;
}

struct ScreenOfEyes {
    Protocol protocol;
    PagesOfEyes pages;
    VirtualClock clock;
    VirtualDisplay display;
    StereoPresenter presenter;

    ScreenOfEyes(const GlContext& context, const Protocol& of)
        : protocol(of), display(context, clock, 120.0, row_of(of.display.output).framebuffer_bits),
          presenter(context, display, pages, protocol) {
        presenter.load_frames({});
    }
    std::vector<std::byte> shown(int frame) {
        presenter.flip(AnimationFrameIndex{frame});
        return presenter.read_screen();
    }
};

int level_at(const std::vector<std::byte>& screen, int x, int y) {
    return std::to_integer<int>(screen[static_cast<std::size_t>(4 * (y * both_px.x + x))]);
}

/// The bytes of rows from a column on.
std::vector<std::byte> field_of_screen(const std::vector<std::byte>& screen, int first_px, int first_row) {
    std::vector<std::byte> field;
    for (int y = first_row; y < both_px.y; ++y) {
        const auto row = screen.begin() + 4 * (y * both_px.x + first_px);
        field.insert(field.end(), row, row + 2 * both_px.x);
    }
    return field;
}

std::vector<std::byte> below(const std::vector<std::byte>& field, int first_row) {
    return {field.begin() + 2 * both_px.x * first_row, field.end()};
}

} // namespace

TEST_CASE("each half of the screen is what its own eye's presenter draws, in every output", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    for (const OutputMode output :
         {OutputMode::native_8bit, OutputMode::mono_plus_plus, OutputMode::color_plus_plus}) {
        CAPTURE(name_of(output));
        const Protocol protocol = protocol_of_eyes(output);
        ScreenOfEyes screen(*context, protocol);
        const std::vector<std::byte> seen = screen.shown(0);
        // A presenter of one eye alone, on a screen of that size.
        for (const Eye eye : {Eye::left, Eye::right}) {
            VirtualDisplay alone(*context, screen.clock, 120.0, row_of(output).framebuffer_bits);
            PagePresenter presenter(*context, alone, screen.pages, screen_geometry_of(protocol),
                                    display_of_field(protocol), {}, {}, eye);
            presenter.load_frames({});
            presenter.flip(AnimationFrameIndex{0});
            const int messages = reserved_rows(output), first = eye == Eye::left ? 0 : both_px.x / 2;
            CHECK(field_of_screen(seen, first, messages) == below(presenter.read_canvas(), messages));
        }
        CHECK(field_of_screen(seen, 0, 8) != field_of_screen(seen, both_px.x / 2, 8));
        CHECK(field_of_screen(screen.shown(1), both_px.x / 2, 8) != field_of_screen(seen, both_px.x / 2, 8));
        // What is read back of a field alone is the field.
        for (const Eye eye : {Eye::left, Eye::right}) {
            PagePresenter& own = screen.presenter.of(eye);
            const std::vector<std::byte> page = own.read_page(0);
            CHECK(page.size() == static_cast<std::size_t>(2 * both_px.x * both_px.y));
        }
    }
}

TEST_CASE("both eyes' pictures are shown with one refresh", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    ScreenOfEyes screen(*context, protocol_of_eyes(OutputMode::native_8bit));
    const FlipReport first = screen.presenter.flip(AnimationFrameIndex{0});
    const FlipReport second = screen.presenter.flip(AnimationFrameIndex{1});
    CHECK(to_seconds(second.vertical_blank - first.vertical_blank) == Approx(1.0 / 120.0));
    const FlipReport text = screen.presenter.show({.kind = Screen::Kind::target, .text = ""});
    CHECK(to_seconds(text.vertical_blank - second.vertical_blank) == Approx(1.0 / 120.0));
    const std::vector<std::byte> target = screen.presenter.read_screen();
    CHECK(field_of_screen(target, 0, 0) == field_of_screen(target, both_px.x / 2, 0));
    CHECK(level_at(target, 2, 2) != level_at(target, both_px.x / 4, both_px.y / 2 + 4));
}

TEST_CASE("eyes are exchanged, and fields mirrored and moved, as the protocol says", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    Protocol protocol = protocol_of_eyes(OutputMode::native_8bit);
    const auto shown = [&] { return ScreenOfEyes(*context, protocol).shown(0); };
    const std::vector<std::byte> plain = shown();
    const int half_px = both_px.x / 2;

    protocol.stereo.swapped = true;
    const std::vector<std::byte> swapped = shown();
    CHECK(field_of_screen(swapped, 0, 0) == field_of_screen(plain, half_px, 0));
    CHECK(field_of_screen(swapped, half_px, 0) == field_of_screen(plain, 0, 0));

    protocol.stereo.swapped = false;
    protocol.stereo.mirrored = true;
    const std::vector<std::byte> mirrored = shown();
    bool is_mirrored = true;
    for (int y = 0; y < both_px.y; ++y)
        for (int x = 0; x < half_px; ++x)
            is_mirrored = is_mirrored && level_at(mirrored, x, y) == level_at(plain, half_px - 1 - x, y) &&
                          level_at(mirrored, half_px + x, y) == level_at(plain, both_px.x - 1 - x, y);
    CHECK(is_mirrored);
    CHECK(mirrored != plain);

    protocol.stereo.mirrored = false;
    protocol.stereo.left_eye_right_px = -14;
    protocol.stereo.left_eye_down_px = 3;
    protocol.stereo.right_eye_right_px = 250;
    protocol.stereo.right_eye_down_px = -5;
    const std::vector<std::byte> moved = shown();
    const int background = level_at(plain, 0, 0);
    bool is_moved = true;
    for (int y = 0; y < both_px.y; ++y)
        for (int x = 0; x < half_px; ++x) {
            const auto was = [&](int first, glm::ivec2 shift) {
                const int from_x = x - shift.x, from_y = y - shift.y;
                const bool is_there = from_x >= 0 && from_x < half_px && from_y >= 0 && from_y < both_px.y;
                return is_there ? level_at(plain, first + from_x, from_y) : background;
            };
            is_moved = is_moved && level_at(moved, x, y) == was(0, {-14, 3}) &&
                       level_at(moved, half_px + x, y) == was(half_px, {250, -5});
        }
    CHECK(is_moved);

    // Moved where it is seen: first mirrored, then moved to the right of the screen.
    protocol.stereo.mirrored = true;
    const std::vector<std::byte> both = shown();
    bool is_both = true;
    for (int y = 0; y < both_px.y; ++y)
        for (int x = 0; x < half_px; ++x) {
            const auto was = [&](int first, glm::ivec2 shift) {
                const int from_x = x - shift.x, from_y = y - shift.y;
                const bool is_there = from_x >= 0 && from_x < half_px && from_y >= 0 && from_y < both_px.y;
                return is_there ? level_at(plain, first + half_px - 1 - from_x, from_y) : background;
            };
            is_both = is_both && level_at(both, x, y) == was(0, {-14, 3}) &&
                      level_at(both, half_px + x, y) == was(half_px, {250, -5});
        }
    CHECK(is_both);
}

TEST_CASE("marks stand in each eye's picture where that eye has them", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    Protocol protocol = protocol_of_eyes(OutputMode::native_8bit);
    for (const char* const eye : {"left", "right"}) {
        protocol.tracker.eye = eye;
        ScreenOfEyes screen(*context, protocol);
        const std::vector<std::byte> plain = screen.shown(0);
        const auto dot_at = [](double x_px) {
            StimulusMark mark;
            mark.count = 1;
            mark.lines[0] = {.points = {}, .count = 1, .width_px = 6.0};
            mark.lines[0].points[0] = {x_px, 24.0};
            mark.rim_px = 0.0;
            return mark;
        };
        const double middle = both_px.x / 4.0;
        const StimulusMark own = dot_at(middle - 10.0), others = dot_at(middle + 12.0);
        screen.presenter.mark_stimuli({&own, 1}, {&others, 1});
        const std::vector<std::byte> marked = screen.shown(0);
        const int first = std::string_view(eye) == "left" ? 0 : both_px.x / 2, second = both_px.x / 2 - first,
                  m = static_cast<int>(middle);
        CHECK(level_at(marked, first + m - 10, 24) != level_at(plain, first + m - 10, 24));
        CHECK(level_at(marked, first + m + 12, 24) == level_at(plain, first + m + 12, 24));
        CHECK(level_at(marked, second + m + 12, 24) != level_at(plain, second + m + 12, 24));
        CHECK(level_at(marked, second + m - 10, 24) == level_at(plain, second + m - 10, 24));
    }
}

TEST_CASE("a trigger and the messages of the screen begin in its top left corner, whoever sees it", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    Protocol protocol = protocol_of_eyes(OutputMode::mono_plus_plus);
    protocol.display.onset_trigger = 5;
    for (const bool swapped : {false, true}) {
        protocol.stereo.swapped = swapped;
        protocol.stereo.left_eye_right_px = 8; // messages do not move with a picture
        ScreenOfEyes screen(*context, protocol);
        CHECK(&screen.presenter.leading() == &screen.presenter.of(swapped ? Eye::right : Eye::left));
        const std::vector<std::byte> onset = screen.shown(0);
        VirtualDisplay alone(*context, screen.clock, 120.0, 8);
        DisplaySettings display = display_of_field(protocol);
        PagePresenter presenter(*context, alone, screen.pages, screen_geometry_of(protocol), display, {}, {},
                                swapped ? Eye::right : Eye::left);
        presenter.load_frames({});
        presenter.flip(AnimationFrameIndex{0});
        const std::vector<std::byte> expected = presenter.read_canvas();
        const int rows = reserved_rows(protocol.display.output);
        REQUIRE(rows > 0);
        for (int y = 0; y < rows; ++y) {
            const auto row = onset.begin() + 4 * y * both_px.x;
            CHECK(std::equal(row, row + 2 * both_px.x, expected.begin() + 2 * y * both_px.x));
        }
    }
}
