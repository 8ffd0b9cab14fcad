/// Objects that the observer turns: by held keys, by the mouse, up to their ends.
#include "experiment/session/object_turning.h"

#include <catch2/catch.hpp>

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
