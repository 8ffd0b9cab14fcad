#include "devices/light/light_sensor.h"

#include <cmath>

#include <catch2/catch.hpp>

using namespace overt;

namespace {

/// Black and white in turn, each for a tenth of a second.
std::vector<LightEdge> alternating(int changes) {
    std::vector<LightEdge> list;
    for (int i = 0; i < changes; ++i)
        list.push_back({SessionTime(from_seconds(1.0 + 0.1 * i)), i % 2 == 0});
    return list;
}

} // namespace

TEST_CASE("latency and jitter of a simulated sensor come out of its edges", "[unit]") {
    SimulatedLightSensor sensor(7.5, 0.3, 11);
    const std::vector<LightEdge> changes = alternating(2000);
    for (const LightEdge& change : changes)
        sensor.shown(change);
    const LightLatency found = compare_light(changes, sensor.edges());
    CHECK(found.matched == 2000);
    CHECK(found.unseen == 0);
    CHECK(found.unasked == 0);
    CHECK(found.mean_ms == Approx(7.5).margin(4 * 0.3 / std::sqrt(2000.0)));
    CHECK(found.sd_ms == Approx(0.3).epsilon(0.08));
    CHECK(found.lowest_ms < 7.0);
    CHECK(found.highest_ms > 8.0);
}

TEST_CASE("changes that no edge follows and edges that nobody asked for are counted apart", "[unit]") {
    const std::vector<LightEdge> changes = alternating(10);
    SimulatedLightSensor sensor(5.0, 0.0, 1);
    for (std::size_t i = 0; i < changes.size(); ++i)
        if (i != 4)
            sensor.shown(changes[i]);
    std::vector<LightEdge> edges = sensor.edges();
    LightLatency found = compare_light(changes, edges);
    CHECK(found.matched == 9);
    CHECK(found.unseen == 1);
    CHECK(found.mean_ms == Approx(5.0));
    CHECK(found.sd_ms == Approx(0.0).margin(1e-6));

    // A flicker of the lamp, after the last.
    edges.push_back({edges.back().at + std::chrono::milliseconds(20), true});
    found = compare_light(changes, edges);
    CHECK(found.matched == 9);
    CHECK(found.unasked == 1);
    CHECK(compare_light(changes, {}).unseen == 10);
}

TEST_CASE("light that comes before its change is told as such where it is looked for", "[unit]") {
    const std::vector<LightEdge> changes = alternating(10);
    SimulatedLightSensor sensor(-16.0, 0.0, 1);
    for (const LightEdge& change : changes)
        sensor.shown(change);
    const LightLatency found = compare_light(changes, sensor.edges(), -33.0);
    CHECK(found.matched == 10);
    CHECK(found.unseen == 0);
    CHECK(found.unasked == 0);
    CHECK(found.mean_ms == Approx(-16.0));
    // Each edge is one change's: the last of a kind that went unseen does not get the next one's.
    const std::vector<LightEdge> edges = sensor.edges();
    CHECK(compare_light(changes, std::span(edges).subspan(2), -33.0).unseen == 2);
}

TEST_CASE("delays, their mean and their spread are those of the edges, by hand", "[unit]") {
    const auto at_ms = [](double ms) { return SessionTime(from_seconds(1e-3 * ms)); };
    const std::vector<LightEdge> changes{{at_ms(1000), true}, {at_ms(1100), false}, {at_ms(1200), true}};
    const std::vector<LightEdge> edges{
        {at_ms(990), true}, {at_ms(1004), true}, {at_ms(1106), false}, {at_ms(1211), true}};
    LightLatency found = compare_light(changes, edges);
    REQUIRE(found.delays_ms.size() == 3);
    CHECK(found.delays_ms[0] == Approx(4.0));
    CHECK(found.delays_ms[1] == Approx(6.0));
    CHECK(found.delays_ms[2] == Approx(11.0));
    CHECK(found.mean_ms == Approx(7.0));
    CHECK(found.sd_ms == Approx(std::sqrt((9.0 + 1.0 + 16.0) / 2.0)));
    CHECK(found.lowest_ms == Approx(4.0));
    CHECK(found.highest_ms == Approx(11.0));
    CHECK(found.unasked == 1);
    CHECK(found.unseen == 0);
    // One delay alone has no spread.
    found = compare_light(std::span(changes).first(1), std::span(edges).subspan(1, 1));
    CHECK(found.matched == 1);
    CHECK(found.mean_ms == Approx(4.0));
    CHECK(found.sd_ms == 0.0);
    // An edge at the very time of the next change of its kind is that one's.
    const std::vector<LightEdge> late{{at_ms(1200), true}};
    found = compare_light(changes, late);
    CHECK(found.matched == 1);
    CHECK(found.unseen == 2);
    CHECK(found.mean_ms == Approx(0.0).margin(1e-9));
    // Nothing was seen, or asked for.
    found = compare_light({}, edges);
    CHECK(found.matched == 0);
    CHECK(found.unasked == 4);
    CHECK(found.mean_ms == 0.0);
}
