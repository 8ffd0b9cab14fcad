/// Objects that the observer turns: by held keys, by the mouse, up to their ends.
#include "experiment/session/object_turning.h"

#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/base/random.h"
#include "experiment/protocol/slot.h"

using namespace overt;

namespace {

using TurningInput = ObserverInput::Kind;

Protocol turned_protocol(const ObserverTurn& by, double angle_deg = 0.0) {
    Protocol protocol;
    protocol.objects.resize(1);
    protocol.materials.resize(1);
    protocol.motions.front().id = "explore";
    protocol.motions.front().kind = MotionKind::observer;
    protocol.motions.front().by_observer = by;
    protocol.motions.front().angle = Degrees{angle_deg};
    protocol.motions.front().frame_count = by.pose_count();
    return protocol;
}

SessionTime turned_at_s(double s) { return SessionTime() + from_seconds(s); }

ObserverInput turning_key(double s, std::string_view name, TurningInput kind) {
    ObserverInput input;
    input.kind = kind;
    input.at = turned_at_s(s);
    input.key = ShortName(name);
    return input;
}

ObserverInput turning_mouse(double s, TurningInput kind, double right_px) {
    ObserverInput input;
    input.kind = kind;
    input.at = turned_at_s(s);
    input.right_px = right_px;
    input.button = 1;
    return input;
}

ObserverTurn turned_by_keys() {
    ObserverTurn by;
    by.with = TurnedWith::keys;
    by.step = Degrees{2.0};
    by.speed_deg_s = 60.0;
    return by;
}

int turned_frame(const ObjectTurning& turning) { return turning.pose_of(0)->frame.value; }

} // namespace

TEST_CASE("a held key turns by its speed, from the time of the press to that of the release", "[unit]") {
    const Protocol protocol = turned_protocol(turned_by_keys());
    ObjectTurning turning;
    turning.begin_trial(protocol, {}, 1, false);
    REQUIRE(turning.pose_of(0));
    CHECK_FALSE(turning.take(turning_key(0.0, "right", TurningInput::key_down))); // nothing is shown yet
    turning.begin_show({0});
    CHECK(turning.is_active());
    CHECK(turning.take(turning_key(1.0, "right", TurningInput::key_down)));
    turning.go_to(turned_at_s(1.1));
    CHECK(turned_frame(turning) == 3); // 6 deg
    CHECK(turning.pose_of(0)->input_at == turned_at_s(1.0));
    // It was let go earlier than it was looked at.
    turning.go_to(turned_at_s(1.5));
    CHECK(turned_frame(turning) == 15);
    CHECK(turning.take(turning_key(1.4, "right", TurningInput::key_up)));
    CHECK(turned_frame(turning) == 12); // 24 deg
    turning.go_to(turned_at_s(9.0));
    CHECK(turned_frame(turning) == 12);
    CHECK(turning.take(turning_key(9.0, "left", TurningInput::key_down)));
    turning.go_to(turned_at_s(10.0));
    CHECK(turned_frame(turning) == 162); // -36 deg: all round
    // Both keys at once stand still.
    CHECK(turning.take(turning_key(10.0, "right", TurningInput::key_down)));
    turning.go_to(turned_at_s(11.0));
    CHECK(turned_frame(turning) == 162);
    CHECK_FALSE(turning.take(turning_key(11.0, "x", TurningInput::key_down)));
    // The next show begins where it was left, with nothing held.
    turning.end_show();
    CHECK_FALSE(turning.take(turning_key(11.0, "left", TurningInput::key_up)));
    turning.begin_show({0});
    turning.go_to(turned_at_s(20.0));
    CHECK(turned_frame(turning) == 162);
    CHECK_FALSE(turning.pose_of(0)->input_at); // no input of this show is in it
    CHECK_FALSE(turning.take(turning_key(20.0, "left", TurningInput::key_up))); // it was held before
    std::vector<AnswerInput> inputs;
    turning.add_to(inputs);
    REQUIRE(inputs.size() == 4);
    CHECK(inputs.front().id == "explore");
    CHECK(inputs[1].number == Approx(24.0));
}

TEST_CASE("at its ends an object stays, and comes back at once", "[unit]") {
    ObserverTurn by = turned_by_keys();
    by.from = Degrees{-30.0};
    by.to = Degrees{30.0};
    const Protocol protocol = turned_protocol(by, 28.0);
    CHECK(by.pose_count() == 31);
    ObjectTurning turning;
    turning.begin_trial(protocol, {}, 1, false);
    turning.begin_show({0});
    CHECK(turned_frame(turning) == 29);
    turning.take(turning_key(0.0, "right", TurningInput::key_down));
    turning.go_to(turned_at_s(2.0));
    CHECK(turned_frame(turning) == 30);
    turning.take(turning_key(1.99, "right", TurningInput::key_up)); // told late: it does not go back
    CHECK(turned_frame(turning) == 30);
    turning.take(turning_key(2.0, "left", TurningInput::key_down));
    turning.go_to(turned_at_s(2.1));
    CHECK(turned_frame(turning) == 27);
}

TEST_CASE("a drag turns the front with the pointer, and the wheel by a pose", "[unit]") {
    ObserverTurn by;
    by.drag_deg = 180.0;
    const Protocol protocol = turned_protocol(by);
    const double width_px = slot_geometry(protocol, protocol.slots.front()).image_px.x;
    ObjectTurning turning;
    turning.begin_trial(protocol, {}, 1, false);
    turning.begin_show({0});
    CHECK(turning.shows_pointer());
    CHECK_FALSE(turning.take(turning_mouse(0.0, TurningInput::pointer_moved, 5.0)));
    CHECK_FALSE(turning.take(turning_mouse(0.0, TurningInput::pointer_down, width_px))); // beside the image
    CHECK(turning.take(turning_mouse(0.1, TurningInput::pointer_down, 0.0)));
    CHECK(turning.take(turning_mouse(0.2, TurningInput::pointer_moved, 0.24 * width_px)));
    CHECK(turned_frame(turning) == 22); // 43.2 deg
    CHECK(turning.take(turning_mouse(0.3, TurningInput::pointer_moved, -0.24 * width_px)));
    CHECK(turning.take(turning_mouse(0.3, TurningInput::pointer_up, -0.24 * width_px)));
    CHECK(turned_frame(turning) == 158); // -43.2 deg
    CHECK_FALSE(turning.take(turning_mouse(0.4, TurningInput::pointer_moved, 0.0)));
    ObserverInput wheel = turning_mouse(0.5, TurningInput::wheel, 0.0);
    wheel.steps = -3.0;
    CHECK(turning.take(wheel));
    CHECK(turned_frame(turning) == 155);
    CHECK_FALSE(turning.take(turning_key(1.0, "right", TurningInput::key_down))); // keys turn nothing
    ObserverInput dial = wheel;
    dial.kind = TurningInput::dial;
    CHECK_FALSE(turning.take(dial)); // nor does a knob
}

TEST_CASE("an object goes round with a knob, and tilts with it where it has elevations", "[unit]") {
    ObserverTurn by = turned_by_keys();
    by.from = Degrees{-20.0};
    by.to = Degrees{20.0};
    by.elevation_step = Degrees{5.0};
    by.elevation_from = Degrees{-10.0};
    by.elevation_to = Degrees{10.0};
    by.keys = {"left", "right", "up", "down"};
    const Protocol protocol = turned_protocol(by);
    ObjectTurning turning;
    turning.begin_trial(protocol, {}, 1, false);
    turning.begin_show({0});
    ObserverInput knob;
    knob.kind = TurningInput::dial;
    knob.at = turned_at_s(1.0);
    knob.steps = 3.0; // clockwise seen from above
    CHECK(turning.take(knob));
    CHECK(by.angle_of(turned_frame(turning)).value == -6.0);
    knob.steps = -100.0;
    CHECK(turning.take(knob));
    CHECK(by.angle_of(turned_frame(turning)).value == 20.0); // its end
    knob.kind = TurningInput::tilt;
    knob.steps = 1.0; // with its top towards the hand
    CHECK(turning.take(knob));
    CHECK(by.elevation_of(turned_frame(turning)).value == 5.0);
    knob.steps = -7.0;
    CHECK(turning.take(knob));
    CHECK(by.elevation_of(turned_frame(turning)).value == -10.0);
    CHECK(by.angle_of(turned_frame(turning)).value == 20.0);
    CHECK(turning.pose_of(0)->input_at == turned_at_s(1.0));
    ObserverTurn flat = turned_by_keys();
    const Protocol flat_protocol = turned_protocol(flat);
    ObjectTurning only_turns;
    only_turns.begin_trial(flat_protocol, {}, 1, false);
    only_turns.begin_show({0});
    CHECK_FALSE(only_turns.take(knob));
}

TEST_CASE("with elevations each turn is a pose at each of them", "[unit]") {
    ObserverTurn by = turned_by_keys();
    by.from = Degrees{-30.0};
    by.to = Degrees{30.0};
    by.step = Degrees{10.0};
    by.elevation_step = Degrees{15.0};
    by.elevation_from = Degrees{-15.0};
    by.elevation_to = Degrees{45.0};
    CHECK(by.turn_count() == 7);
    CHECK(by.elevation_count() == 5);
    CHECK(by.pose_count() == 35);
    for (int pose = 0; pose < by.pose_count(); ++pose) {
        CAPTURE(pose);
        CHECK(by.nearest(by.angle_of(pose), by.elevation_of(pose)) == pose);
        CHECK(by.pose_of(pose).angle.value == by.angle_of(pose).value);
        CHECK(elevation_of(by.pose_of(pose)).value == Approx(by.elevation_of(pose).value).margin(1e-9));
        CHECK(by.pose_of(pose).is_turn() == (by.elevation_of(pose).value == 0.0));
    }
    CHECK(by.nearest({400.0}, {-90.0}) == 6); // the ends stay ends
    CHECK(by.nearest({-400.0}, {90.0}) == 28);
    // Of a positive one the object is seen more from above: its top comes to the observer, who is at -y.
    const glm::dvec3 top = by.pose_of(28).tilt * glm::dvec3(0.0, 0.0, 1.0);
    CHECK(top.y == Approx(-std::sqrt(0.5)));
    CHECK(top.z == Approx(std::sqrt(0.5)));
    by.to = Degrees{330.0}; // all round
    CHECK(by.pose_count() == 36 * 5);
    CHECK(by.nearest({350.0}, {0.0}) == by.nearest({-10.0}, {0.0}));
}

TEST_CASE("keys and drags up and down tilt an object, up to its ends, while others turn it", "[unit]") {
    ObserverTurn by = turned_by_keys();
    by.with = TurnedWith::both;
    by.keys = {"left", "right", "up", "down"};
    by.step = Degrees{10.0};
    by.elevation_step = Degrees{10.0};
    by.elevation_from = Degrees{-20.0};
    by.elevation_to = Degrees{40.0};
    by.drag_deg = 180.0;
    const Protocol protocol = turned_protocol(by);
    const auto pose = [&](const ObjectTurning& turning) {
        const int frame = turned_frame(turning);
        return std::pair(by.angle_of(frame).value, by.elevation_of(frame).value);
    };
    ObjectTurning turning;
    turning.begin_trial(protocol, {}, 1, false);
    turning.begin_show({0});
    CHECK(pose(turning) == std::pair(0.0, 0.0));
    CHECK(turning.take(turning_key(0.0, "down", TurningInput::key_down))); // the front goes down
    turning.go_to(turned_at_s(0.5));
    CHECK(pose(turning) == std::pair(0.0, 30.0));
    CHECK(turning.take(turning_key(0.5, "right", TurningInput::key_down)));
    turning.go_to(turned_at_s(1.5));
    CHECK(pose(turning) == std::pair(60.0, 40.0)); // one goes on, the other has come to its end
    CHECK(turning.take(turning_key(1.5, "right", TurningInput::key_up)));
    CHECK(turning.take(turning_key(1.5, "down", TurningInput::key_up)));
    CHECK(turning.take(turning_key(2.0, "up", TurningInput::key_down)));
    turning.go_to(turned_at_s(9.0));
    CHECK(turning.take(turning_key(9.0, "up", TurningInput::key_up)));
    CHECK(pose(turning) == std::pair(60.0, -20.0));
    // A drag downwards over a ninth of the width.
    const double width_px = slot_geometry(protocol, protocol.slots.front()).image_px.x;
    CHECK(turning.take(turning_mouse(10.0, TurningInput::pointer_down, 0.0)));
    ObserverInput moved = turning_mouse(10.1, TurningInput::pointer_moved, 0.0);
    moved.down_px = width_px / 9.0;
    CHECK(turning.take(moved));
    CHECK(pose(turning) == std::pair(60.0, 0.0));
    CHECK(turning.offers(0, {}, 1.0).size() == 2);
    // Without elevations the same keys, and drags, tilt nothing.
    ObserverTurn flat = by;
    flat.elevation_step = Degrees{0.0};
    const Protocol flat_protocol = turned_protocol(flat);
    ObjectTurning only_turns;
    only_turns.begin_trial(flat_protocol, {}, 1, false);
    only_turns.begin_show({0});
    CHECK_FALSE(only_turns.take(turning_key(0.0, "up", TurningInput::key_down)));
    CHECK(only_turns.take(turning_mouse(10.0, TurningInput::pointer_down, 0.0)));
    CHECK(only_turns.take(moved));
    CHECK(turned_frame(only_turns) == 0);
    CHECK(only_turns.offers(0, {}, 1.0).size() == 1);
}

TEST_CASE("poses that are drawn are the trial's own, and each comes up", "[unit]") {
    ObserverTurn by = turned_by_keys();
    by.step = Degrees{90.0};
    by.start = TurnStart::drawn;
    const Protocol protocol = turned_protocol(by);
    std::vector<int> count(4);
    for (int index = 0; index < 200; ++index) {
        Trial trial;
        trial.index = index;
        ObjectTurning turning, again;
        turning.begin_trial(protocol, trial, 3, false);
        again.begin_trial(protocol, trial, 3, false);
        CHECK(turned_frame(turning) == turned_frame(again));
        ++count.at(static_cast<std::size_t>(turned_frame(turning)));
    }
    for (const int one : count)
        CHECK(one > 30);
}

TEST_CASE("a drag begins on the image, its first pixels included and those after it not", "[unit]") {
    ObserverTurn by;
    by.drag_deg = 180.0;
    Protocol protocol = turned_protocol(by);
    protocol.slots.front().entry = 0;
    protocol.slots.front().right_deg = 4.0;
    protocol.slots.front().up_deg = 2.0;
    protocol.slots.front().width_deg = 6.0;
    protocol.slots.front().height_deg = 3.0;
    const ScreenGeometry screen = slot_geometry(protocol, protocol.slots.front());
    const double left = screen.image_origin_px.x - 0.5 * screen.screen_px.x;
    const double top = screen.image_origin_px.y - 0.5 * screen.screen_px.y;
    const double right = left + screen.image_px.x, bottom = top + screen.image_px.y;
    CHECK(left > 0.0); // to the right of the middle, and above it
    CHECK(bottom < 0.0);
    ObjectTurning turning;
    turning.begin_trial(protocol, {}, 1, false);
    turning.begin_show({0});
    const auto begins = [&](double right_px, double down_px, int button = 1) {
        ObserverInput press = turning_mouse(0.0, TurningInput::pointer_down, right_px);
        press.down_px = down_px;
        press.button = button;
        return turning.take(press);
    };
    const double mid_x = 0.5 * (left + right), mid_y = 0.5 * (top + bottom);
    CHECK(begins(left, mid_y));
    CHECK_FALSE(begins(left - 0.01, mid_y));
    CHECK(begins(right - 0.01, mid_y));
    CHECK_FALSE(begins(right, mid_y));
    CHECK(begins(mid_x, top));
    CHECK_FALSE(begins(mid_x, top - 0.01));
    CHECK(begins(mid_x, bottom - 0.01));
    CHECK_FALSE(begins(mid_x, bottom));
    CHECK_FALSE(begins(mid_x, mid_y, 2)); // another button
    const std::vector<TurningOffer> offers = turning.offers(3, turned_at_s(2.0), 7.5);
    REQUIRE(offers.size() == 1);
    CHECK(offers[0].show == 3);
    CHECK(offers[0].place == 0);
    CHECK(offers[0].since == turned_at_s(2.0));
    CHECK(offers[0].lasts_s == 7.5);
    CHECK(offers[0].right_px == Approx(mid_x));
    CHECK(offers[0].down_px == Approx(mid_y));
    CHECK(offers[0].deg_per_px == Approx(180.0 / screen.image_px.x));
    CHECK(offers[0].speed_deg_s == by.speed_deg_s);
    CHECK(offers[0].turn_sd_deg == by.simulated_turn_deg);
    CHECK(offers[0].pause_s == by.simulated_pause_s);
    CHECK(offers[0].less.empty());
    CHECK_FALSE(offers[0].is_elevation);
    CHECK_FALSE(offers[0].drags_tilt);
    // The sum of a drag's ways turns it, whatever its pieces.
    begins(mid_x, mid_y);
    for (int i = 1; i <= 10; ++i) {
        ObserverInput moved = turning_mouse(0.1 * i, TurningInput::pointer_moved, mid_x + 2.4 * i);
        moved.down_px = mid_y;
        CHECK(turning.take(moved));
    }
    CHECK(turned_frame(turning) == std::lround(24.0 * 180.0 / screen.image_px.x / by.step.value));
}

TEST_CASE("offers to turn name the keys of each direction, and those of an elevation by themselves",
          "[unit]") {
    ObserverTurn by = turned_by_keys();
    by.keys = {"a", "d", "w", "s"};
    by.elevation_step = Degrees{10.0};
    by.elevation_from = Degrees{-20.0};
    by.elevation_to = Degrees{20.0};
    const Protocol protocol = turned_protocol(by);
    ObjectTurning turning;
    turning.begin_trial(protocol, {}, 1, false);
    CHECK(turning.offers(0, {}, 1.0).empty()); // nothing is lit
    turning.begin_show({0});
    const std::vector<TurningOffer> offers = turning.offers(0, {}, 1.0);
    REQUIRE(offers.size() == 2);
    CHECK(offers[0].less == "a");
    CHECK(offers[0].more == "d");
    CHECK_FALSE(offers[0].is_elevation);
    CHECK_FALSE(offers[0].drags_tilt);
    CHECK(offers[1].less == "w");
    CHECK(offers[1].more == "s");
    CHECK(offers[1].is_elevation);
    CHECK_FALSE(turning.shows_pointer());
    turning.end_show();
    CHECK(turning.offers(0, {}, 1.0).empty());
    CHECK_FALSE(turning.is_active());
}

TEST_CASE("each of two objects is turned where it is, and stands from show to show as it was left",
          "[unit]") {
    ObserverTurn by;
    by.with = TurnedWith::both;
    by.drag_deg = 180.0;
    Protocol protocol = turned_protocol(by, 10.0);
    protocol.slots.resize(2);
    protocol.slots[0].id = "left";
    protocol.slots[0].right_deg = -6.0;
    protocol.slots[1].id = "right";
    protocol.slots[1].right_deg = 6.0;
    for (Slot& slot : protocol.slots) {
        slot.entry = 0;
        slot.width_deg = slot.height_deg = 5.0;
    }
    Trial trial;
    trial.slot = 0;
    trial.beside.push_back({Stimulus{}, 1});
    const ScreenGeometry screen = slot_geometry(protocol, protocol.slots[1]);
    const double middle = screen.image_origin_px.x - 0.5 * screen.screen_px.x + 0.5 * screen.image_px.x;
    const auto frame = [](const ObjectTurning& turning, int place) {
        return turning.pose_of(place)->frame.value;
    };
    ObjectTurning turning;
    turning.begin_trial(protocol, trial, 1, false);
    CHECK_FALSE(turning.pose_of(2));
    turning.begin_show({0, 1});
    CHECK(turning.offers(0, {}, 1.0).size() == 2);
    CHECK(turning.take(turning_mouse(1.0, TurningInput::pointer_down, middle)));
    CHECK(turning.take(turning_mouse(1.1, TurningInput::pointer_moved, middle + 0.2 * screen.image_px.x)));
    CHECK(frame(turning, 0) == 5);  // 10 deg
    CHECK(frame(turning, 1) == 23); // 36 deg more
    CHECK_FALSE(turning.pose_of(0)->input_at);
    CHECK(turning.pose_of(1)->input_at == turned_at_s(1.1));
    // A key turns both, as long as it is held; a new show lets it go, of all of them.
    CHECK(turning.take(turning_key(2.0, "right", TurningInput::key_down)));
    turning.go_to(turned_at_s(2.1));
    CHECK(frame(turning, 0) == 8);
    CHECK(frame(turning, 1) == 26);
    turning.begin_show({1});
    CHECK_FALSE(turning.pose_of(0)->input_at);
    CHECK_FALSE(turning.pose_of(1)->input_at);
    turning.go_to(turned_at_s(3.0));
    CHECK(frame(turning, 0) == 8);
    CHECK(frame(turning, 1) == 26);
    CHECK(turning.offers(0, {}, 1.0).size() == 1);
    CHECK(turning.offers(0, {}, 1.0).front().place == 1);
    CHECK_FALSE(turning.take(turning_mouse(3.0, TurningInput::pointer_moved, middle))); // the drag is over
    CHECK(turning.take(turning_key(4.0, "left", TurningInput::key_down)));
    turning.go_to(turned_at_s(4.1));
    CHECK(frame(turning, 0) == 8); // it is not lit
    CHECK(frame(turning, 1) == 23);
    ObserverInput gone = turning_key(4.2, "", TurningInput::let_go);
    turning.take(gone);
    turning.go_to(turned_at_s(9.0));
    CHECK(frame(turning, 1) == 20); // until it was let go
    // What was done is told with the slot and the angle after it.
    std::vector<AnswerInput> inputs;
    turning.add_to(inputs);
    std::vector<std::string> rows;
    for (const AnswerInput& input : inputs)
        rows.push_back(fmt::format("{} {} {:.0f}", input.id, input.item, *input.number));
    CHECK(rows == std::vector<std::string>{"explore right 10", "explore right 46", "explore left 10",
                                           "explore right 46", "explore right 52"});
    for (const AnswerInput& input : inputs) {
        CHECK(input.state == InputState::open);
        CHECK(input.has_counted);
    }
    // A new trial begins as the protocol says, and knows nothing of the one before.
    turning.begin_trial(protocol, trial, 1, false);
    turning.begin_show({0, 1});
    CHECK(frame(turning, 0) == 5);
    CHECK(frame(turning, 1) == 5);
    inputs.clear();
    turning.add_to(inputs);
    CHECK(inputs.empty());
}

TEST_CASE("inputs beyond those that find room still turn, are counted, and are the trial's own", "[unit]") {
    ObserverTurn by;
    const Protocol protocol = turned_protocol(by);
    ObjectTurning turning;
    turning.begin_trial(protocol, {}, 1, false);
    turning.begin_show({0});
    ObserverInput wheel = turning_mouse(0.0, TurningInput::wheel, 0.0);
    wheel.steps = 1.0;
    for (int i = 0; i < 16384 + 7; ++i)
        CHECK(turning.take(wheel));
    CHECK(turning.lost_inputs() == 7);
    CHECK(turned_frame(turning) == (16384 + 7) % 180);
    std::vector<AnswerInput> inputs;
    turning.add_to(inputs);
    CHECK(inputs.size() == 16384);
    turning.begin_trial(protocol, {}, 1, false);
    CHECK(turning.lost_inputs() == 0);
}

TEST_CASE("a drawn pose in practice is another draw than that of the trial of the same number", "[unit]") {
    ObserverTurn by = turned_by_keys();
    by.start = TurnStart::drawn;
    const Protocol protocol = turned_protocol(by);
    int alike = 0, seeds = 0;
    for (int index = 0; index < 50; ++index) {
        Trial trial;
        trial.index = index;
        ObjectTurning turning, practice, other;
        turning.begin_trial(protocol, trial, 3, false);
        practice.begin_trial(protocol, trial, 3, true);
        other.begin_trial(protocol, trial, 4, false);
        RandomStream stream(3, "pose 0", static_cast<std::uint64_t>(index));
        CHECK(turned_frame(turning) ==
              static_cast<int>(stream.below(static_cast<std::uint32_t>(by.pose_count()))));
        alike += turned_frame(turning) == turned_frame(practice);
        seeds += turned_frame(turning) == turned_frame(other);
    }
    CHECK(alike < 5);
    CHECK(seeds < 5);
}

TEST_CASE("who turns by the mouse alone tilts by the drag where there are elevations", "[unit]") {
    ObserverTurn by;
    by.elevation_step = Degrees{10.0};
    by.elevation_from = Degrees{-20.0};
    by.elevation_to = Degrees{20.0};
    by.keys = {"left", "right", "up", "down"};
    for (const TurnedWith with : {TurnedWith::mouse, TurnedWith::both}) {
        by.with = with;
        const Protocol protocol = turned_protocol(by);
        ObjectTurning turning;
        turning.begin_trial(protocol, {}, 1, false);
        turning.begin_show({0});
        const auto offers = turning.offers(0, {}, 1.0);
        REQUIRE(offers.size() == (with == TurnedWith::mouse ? 1 : 2));
        CHECK(offers[0].drags_tilt == (with == TurnedWith::mouse));
    }
}
