#include "app/check/frame_cost.h"

#include <catch2/catch.hpp>

#include "render/gl/headless_context.h"
#include "tests/support/gl_contexts.h"

using namespace overt;
using namespace overt::test;

namespace {

Protocol small_view() {
    Protocol protocol;
    protocol.views.front().width_px = protocol.views.front().height_px = 64;
    return protocol;
}

std::string words(const std::vector<ForecastLine>& lines) {
    std::string text;
    for (const ForecastLine& line : lines)
        text += line.what + ": " + line.finding + "\n";
    return text;
}

const GlDescription software{ContextKind::osmesa, "", "", "softpipe", "", true};
const GlDescription card{ContextKind::egl, "", "", "a card", "", false};

} // namespace

TEST_CASE("the probe of a frame's cost times flips and pages, and maps only where there is a mesh", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    const FrameCost cost = measure_frame_cost(*context, small_view(), {});
    CHECK(cost.flips >= 30);
    CHECK(cost.copy_ms > 0.0);
    CHECK(cost.median_flip_ms > cost.copy_ms);
    CHECK(cost.worst_flip_ms >= cost.median_flip_ms);
    CHECK(cost.page_ms > 0.0);
    CHECK_FALSE(cost.worst_map_ms);
}

TEST_CASE("what a flip costs is held against the refresh that it has to fit into", "[unit]") {
    const Protocol protocol = small_view(); // 120 Hz
    CHECK_THAT(words(forecast_of({60, 1.0, 2.0, 0.5, 5.0, {}}, protocol, card)),
               Catch::Contains("1.00 ms, at worst 2.00 ms of 60, of the 8.33 ms") &&
                   Catch::Contains("0.50 ms of it copy the screen") && !Catch::Contains("--"));
    CHECK_THAT(words(forecast_of({60, 1.0, 5.0, 0.5, 5.0, {}}, protocol, card)),
               Catch::Contains("--realtime"));
    CHECK_THAT(words(forecast_of({60, 9.0, 9.5, 0.5, 5.0, {}}, protocol, card)),
               Catch::Contains("most refreshes would be missed"));
    CHECK_THAT(words(forecast_of({60, 1.0, 2.0, 0.5, 5.0, 40.0}, protocol, card)),
               Catch::Contains("--maps prepared"));
    CHECK_THAT(words(forecast_of({60, 1.0, 2.0, 0.5, 5.0, 40.0}, protocol, software)),
               Catch::Contains("drawn before the session") && !Catch::Contains("--maps"));
}
