/// What simulated observers do to turn an object.
#include "devices/simulated/simulated_turns.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

using namespace overt;

namespace {

TurningOffer dragged(bool drags_tilt) {
    TurningOffer offer;
    offer.lasts_s = 200.0;
    offer.drags_tilt = drags_tilt;
    offer.deg_per_px = 0.5;
    offer.right_px = 100.0;
    offer.down_px = -40.0;
    offer.turn_sd_deg = 30.0;
    offer.pause_s = 0.5;
    return offer;
}

/// Of drags: the way of each, from press to release, in degrees; how often the pointer jumped.
struct Drags {
    std::vector<double> right_deg, down_deg;
    int jumps = 0;
};

Drags drags_of(const TurningOffer& offer) {
    using Kind = ObserverInput::Kind;
    SimulatedTurns turns;
    turns.plan(7, {}, offer);
    Drags drags;
    ObserverInput begin, before;
    while (const std::optional<ObserverInput> input = turns.next(SessionTime(std::chrono::hours(1)))) {
        if (input->kind == Kind::pointer_down)
            begin = *input;
        else
            drags.jumps +=
                std::hypot(input->right_px - before.right_px, input->down_px - before.down_px) > 2.5;
        before = *input;
        if (input->kind != Kind::pointer_up)
            continue;
        CHECK(begin.right_px == offer.right_px);
        CHECK(begin.down_px == offer.down_px);
        drags.right_deg.push_back((input->right_px - begin.right_px) * offer.deg_per_px);
        drags.down_deg.push_back((input->down_px - begin.down_px) * offer.deg_per_px);
    }
    return drags;
}

double sd_of(const std::vector<double>& values) {
    double squares = 0.0;
    for (const double value : values)
        squares += value * value;
    return std::sqrt(squares / static_cast<double>(values.size()));
}

} // namespace

TEST_CASE("simulated drags go to the side, and up and down only where that tilts something", "[unit]") {
    const Drags flat = drags_of(dragged(false)), tilted = drags_of(dragged(true));
    REQUIRE(flat.right_deg.size() > 50);
    REQUIRE(tilted.right_deg.size() > 50);
    CHECK(sd_of(flat.right_deg) == Approx(30.0).margin(6.0));
    CHECK(sd_of(flat.down_deg) == 0.0);
    CHECK(sd_of(tilted.right_deg) == Approx(30.0).margin(6.0));
    CHECK(sd_of(tilted.down_deg) == Approx(30.0).margin(6.0));
    // 60 deg a second, told every sixtieth of one: a hand, not a jump.
    CHECK(flat.jumps == 0);
    CHECK(tilted.jumps == 0);
}

TEST_CASE("keys turn an object by normal turns with log-normal pauses between them, up to the end",
          "[unit]") {
    TurningOffer offer;
    offer.since = SessionTime(std::chrono::seconds(3));
    offer.lasts_s = 5000.0;
    offer.less = "a";
    offer.more = "d";
    offer.speed_deg_s = 60.0;
    offer.turn_sd_deg = 30.0;
    offer.pause_s = 0.5;
    SimulatedTurns turns;
    turns.plan(7, {}, offer);
    CHECK_FALSE(turns.next(offer.since));
    std::vector<double> turned_deg, pauses_s;
    SessionTime before = offer.since, down{};
    while (const std::optional<ObserverInput> input = turns.next(SessionTime(std::chrono::hours(3)))) {
        CHECK(input->at >= before);
        CHECK(input->at < offer.since + from_seconds(offer.lasts_s));
        if (input->kind == ObserverInput::Kind::key_down) {
            pauses_s.push_back(to_seconds(input->at - before));
            down = input->at;
        } else {
            REQUIRE(input->kind == ObserverInput::Kind::key_up);
            const double deg = 60.0 * to_seconds(input->at - down);
            CHECK((input->key.view() == "a" || input->key.view() == "d"));
            turned_deg.push_back(input->key.view() == "a" ? -deg : deg);
        }
        before = input->at;
    }
    REQUIRE(turned_deg.size() > 2000);
    CHECK(turned_deg.size() == pauses_s.size());
    const auto count = static_cast<double>(turned_deg.size());
    double mean = 0.0, squares = 0.0;
    for (const double deg : turned_deg) {
        mean += deg / count;
        squares += deg * deg / count;
    }
    CHECK(std::abs(mean) < 4.0 * 30.0 / std::sqrt(count));
    CHECK(std::sqrt(squares) == Approx(30.0).epsilon(4.0 / std::sqrt(2.0 * count)));
    std::ranges::sort(pauses_s);
    CHECK(pauses_s[pauses_s.size() / 2] == Approx(0.5).epsilon(0.1));
    CHECK(pauses_s.front() > 0.0);
    // Each observer, trial, place and direction has turns of its own, and the same ones again.
    const auto first_of = [&](std::uint64_t seed, int index, int place, bool is_elevation) {
        Trial trial;
        trial.index = index;
        TurningOffer own = offer;
        own.place = place;
        own.is_elevation = is_elevation;
        SimulatedTurns one;
        one.plan(seed, trial, own);
        return one.next(SessionTime(std::chrono::hours(3)))->at;
    };
    const SessionTime first = first_of(7, 0, 0, false);
    CHECK(first == first_of(7, 0, 0, false));
    for (const SessionTime other : {first_of(8, 0, 0, false), first_of(7, 1, 0, false),
                                    first_of(7, 0, 1, false), first_of(7, 0, 0, true)})
        CHECK(other != first);
    // What is due of two objects comes in the order of time, and nothing after it is taken back.
    TurningOffer second = offer;
    second.place = 1;
    turns.clear();
    turns.plan(7, {}, offer);
    turns.plan(7, {}, second);
    before = {};
    int inputs = 0;
    while (const std::optional<ObserverInput> input = turns.next(SessionTime(std::chrono::seconds(100)))) {
        CHECK(input->at >= before);
        before = input->at;
        ++inputs;
    }
    CHECK(inputs > 100);
    turns.clear();
    CHECK_FALSE(turns.next(SessionTime(std::chrono::hours(3))));
}
