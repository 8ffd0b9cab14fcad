#include "devices/light/light_sensor.h"

#include <atomic>
#include <cmath>
#include <thread>

#include <catch2/catch.hpp>

#include "devices/host/clocks.h"
#include "experiment/base/error.h"

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

namespace {

/// Gives what a test puts down, piece by piece, and is then silent or lost.
class ScriptedLine final : public ByteTransport {
  public:
    explicit ScriptedLine(std::vector<std::string> script, bool ends_lost)
        : pieces_(std::move(script)), ends_lost_(ends_lost) {}
    const std::string& name() const noexcept override { return name_; }
    bool write(std::string_view, SessionTime) noexcept override { return false; }
    std::size_t read(std::span<char> into, SessionTime) noexcept override {
        if (next_ >= pieces_.size()) {
            is_lost_ = ends_lost_;
            is_through = true;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            return 0;
        }
        return pieces_[next_++].copy(into.data(), into.size());
    }
    bool lost() const noexcept override { return is_lost_; }
    std::string loss() const override { return is_lost_ ? "it was unplugged" : ""; }
    std::atomic<bool> is_through{false};

  private:
    std::vector<std::string> pieces_;
    std::string name_ = "/dev/ttyACM3";
    std::size_t next_ = 0;
    bool ends_lost_;
    std::atomic<bool> is_lost_{false};
};

} // namespace

TEST_CASE("a light sensor on a serial line tells each of its ones and zeros, until it is lost", "[unit]") {
    for (const bool ends_lost : {false, true}) {
        SteadyClock clock;
        auto line = std::make_unique<ScriptedLine>(
            std::vector<std::string>{"1", "0\r\n", "hello", "01x2/:1", std::string(64, '0')}, ends_lost);
        const ScriptedLine& reader = *line;
        const SessionTime began = clock.now();
        SerialLightSensor sensor(std::move(line), clock);
        for (int i = 0; i < 5000 && !reader.is_through; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        REQUIRE(reader.is_through);
        if (ends_lost) {
            std::string why;
            for (int i = 0; i < 5000 && why.empty(); ++i)
                try {
                    sensor.edges();
                    std::this_thread::sleep_for(std::chrono::milliseconds(1));
                } catch (const DeviceError& error) {
                    why = error.what();
                }
            CHECK(why == "the light sensor was lost: /dev/ttyACM3: it was unplugged");
            continue;
        }
        const std::vector<LightEdge> edges = sensor.edges();
        std::string told;
        for (const LightEdge& edge : edges) {
            told += edge.is_light ? '1' : '0';
            CHECK(edge.at >= began);
            CHECK(edge.at <= clock.now());
        }
        CHECK(told == "10"
                      "011" +
                          std::string(64, '0'));
    }
}
