/// What simulated observers do to turn an object.
#include "devices/simulated/simulated_turns.h"

#include <cmath>

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
