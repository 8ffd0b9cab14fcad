/// Every value of every mode arrives as predicted.
#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "render/gl/headless_context.h"
#include "tests/render/signal/signal_bench.h"
#include "tests/support/gl_contexts.h"
#include "tests/support/virtual_screen.h"

using namespace overt;
using namespace overt::test;

namespace {

void check_all_levels(GlContext& context, OutputMode mode, glm::ivec2 screen) {
    // 512 x 256 hold each level twice; the others stand at odd places, have odd sizes and touch the borders.
    const Spot places[] = {{{512, 256}, {64, 10}},
                           {{333, 77}, {101, 5}},
                           {{1, 5}, {screen.x - 1, 3}},
                           {{37, 9}, {0, screen.y - 9}}};
    for (const Spot& place : places) {
        SignalBench bench(context, mode, place, screen);
        for (int page = 0; page < 3; ++page) {
            bench.presenter->flip({page});
            const SignalFindings found = bench.check(page, bench.presenter->read_canvas());
            CAPTURE(name_of(mode), place.image.x, page, found.first);
            CHECK(found.compared > 0);
            CHECK(found.different == 0);
        }
    }
}

} // namespace

TEST_CASE("all levels, random light and edges arrive as predicted, in every mode and headless context",
          "[gl]") {
    for (const ContextKind kind : test::headless_kinds) {
        const auto context = make_headless_context(kind);
        for (const OutputModeRow& row : output_modes)
            check_all_levels(*context, row.mode, {640, 300});
    }
}

TEST_CASE("all levels arrive in a window's back buffer, and a window of 8 bits is refused for 10", "[gl]") {
    const auto screen = test::VirtualScreen::start(640, 300, 24);
    WindowContext window({{640, 300}, "test"});
    for (const OutputModeRow& row : output_modes) {
        if (row.framebuffer_bits != 8)
            CHECK_THROWS_AS((SignalBench{window, row.mode, Spot{{8, 8}, {0, 8}}}), GraphicsError);
        else
            check_all_levels(window, row.mode, {640, 300});
    }
}

TEST_CASE("all levels arrive in a window of 10 bits, and the packed modes refuse it", "[gl]") {
    const auto screen = test::VirtualScreen::start(640, 300, 30);
    WindowRequest request{{640, 300}, "test"};
    request.bits_per_channel = 10;
    WindowContext window(request);
    REQUIRE(window.bits_per_channel() == 10);
    check_all_levels(window, OutputMode::native_10bit, {640, 300});
    CHECK_THROWS_AS((SignalBench{window, OutputMode::color_plus_plus, Spot{{8, 8}, {0, 8}}}), GraphicsError);
}

TEST_CASE("with a display's exponent, too, every value is the predicted one", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    for (const OutputModeRow& row : output_modes) {
        for (const double gamma : {0.45, 2.2}) {
            SignalBench bench(*context, row.mode, {{512, 256}, {64, 10}}, {640, 300}, Dithering::none, gamma);
            for (int page = 0; page < 2; ++page) {
                const SignalFindings found = bench.check(page, bench.presenter->read_page(page));
                CAPTURE(row.name, gamma, found.first);
                CHECK(found.different == 0);
            }
        }
    }
}

TEST_CASE("stimuli that cover rows of messages, leave the screen or split its last pair are refused",
          "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    const auto make = [&](OutputMode mode, Spot place, glm::ivec2 screen) {
        SignalBench(*context, mode, place, screen);
    };
    const Spot top{{8, 8}, {0, 2}}, low{{8, 8}, {0, 293}}, sound{{8, 8}, {0, 8}};
    CHECK_THROWS_AS(make(OutputMode::color_plus_plus, top, {640, 300}), GraphicsError);
    CHECK_NOTHROW(make(OutputMode::vpixx_c48, top, {640, 300}));
    CHECK_NOTHROW(make(OutputMode::native_8bit, top, {640, 300}));
    CHECK_THROWS_AS(make(OutputMode::native_8bit, low, {640, 300}), GraphicsError);
    CHECK_THROWS_AS(make(OutputMode::color_plus_plus, sound, {641, 300}), GraphicsError);
    CHECK_THROWS_AS(make(OutputMode::bits_plus_plus, sound, {500, 300}), GraphicsError);
}
