/// A gauge that is leaned by drags and arrows.
#include <catch2/catch.hpp>

#include "experiment/answers/answer_kinds.h"
#include "experiment/answers/answer_sheet.h"

using namespace overt;

namespace {

using GaugeInput = ObserverInput::Kind;
using namespace std::chrono_literals;

struct Leaned {
    TaskAnswer settings;
    std::unique_ptr<AnswerSheet> sheet;
    SessionTime now{1s};

    explicit Leaned(Attitude start = {{0.0}, {0.0}}) {
        settings.id = "lean";
        settings.kind = kind_called<AnswerKind>("gauge");
        settings.accept_key = "space";
        settings.slant_per_px_deg = 0.5;
        settings.key_step_deg = 4.0;
        AnswerForm form;
        form.settings = &settings;
        form.probe = "place";
        form.point = "seen.3";
        form.start = start;
        sheet = std::make_unique<AnswerSheet>(std::vector{form}, true);
        sheet->stimulus_lit(now);
    }
    void key(std::string_view name) {
        ObserverInput input{
            .kind = GaugeInput::key_down, .at = now += 100ms, .device = ShortName("keyboard")};
        input.key = ShortName(name);
        sheet->take(input, {});
        input.kind = GaugeInput::key_up;
        sheet->take(input, {});
    }
    void mouse(GaugeInput kind, double right, double down, int button = 1) {
        ObserverInput input{.kind = kind, .at = now += 20ms, .device = ShortName("mouse")};
        input.right_px = right;
        input.down_px = down;
        input.button = kind == GaugeInput::pointer_moved ? 0 : button;
        sheet->take(input, {});
    }
    void drag(double from_right, double from_down, double right, double down) {
        mouse(GaugeInput::pointer_down, from_right, from_down);
        mouse(GaugeInput::pointer_moved, from_right + right, from_down + down);
        mouse(GaugeInput::pointer_up, from_right + right, from_down + down);
    }
    Attitude set() const { return *sheet->gauge()->attitude(); }
    GivenAnswer given() const {
        std::vector<GivenAnswer> answers;
        std::vector<AnswerInput> inputs;
        sheet->add_to(answers, inputs);
        return answers.front();
    }
};

} // namespace

TEST_CASE("a drag leans the gauge to where it goes, from where it stood", "[unit]") {
    Leaned gauge({{10.0}, {0.0}});
    gauge.drag(100.0, 50.0, 20.0, 0.0); // 10 deg more to the right, wherever the drag began
    CHECK(gauge.set().slant.value == Approx(20.0));
    CHECK(gauge.set().tilt.value == Approx(0.0).margin(1e-9));
    gauge.drag(-30.0, 0.0, 0.0, -40.0); // 20 deg upwards
    CHECK(gauge.set().slant.value == Approx(std::hypot(20.0, 20.0)));
    CHECK(gauge.set().tilt.value == Approx(45.0));
    gauge.drag(0.0, 0.0, -80.0, 80.0);
    CHECK(gauge.set().tilt.value == Approx(225.0));
}

TEST_CASE("arrows lean it by steps, and what was done last is taken back", "[unit]") {
    Leaned gauge;
    gauge.key("right");
    gauge.key("up");
    gauge.key("up");
    CHECK(gauge.set().slant.value == Approx(std::hypot(4.0, 8.0)));
    gauge.key("backspace");
    CHECK(gauge.set().slant.value == Approx(std::hypot(4.0, 4.0)));
    gauge.drag(0.0, 0.0, 10.0, 10.0);
    gauge.key("backspace"); // the whole drag
    CHECK(gauge.set().tilt.value == Approx(45.0));
    CHECK(gauge.set().slant.value == Approx(std::hypot(4.0, 4.0)));
}

TEST_CASE("it cannot be accepted before it was moved, nor after all was taken back", "[unit]") {
    Leaned gauge({{30.0}, {120.0}});
    gauge.key("space");
    CHECK_FALSE(gauge.sheet->is_complete());
    gauge.mouse(GaugeInput::pointer_down, 5.0, 5.0);
    gauge.mouse(GaugeInput::pointer_up, 5.0, 5.0); // a click moves nothing
    gauge.key("space");
    CHECK_FALSE(gauge.sheet->is_complete());
    gauge.key("left");
    gauge.key("backspace");
    gauge.key("space");
    CHECK_FALSE(gauge.sheet->is_complete());
    CHECK(gauge.given().is_missed);
    REQUIRE(gauge.given().gauge);
    CHECK(gauge.given().gauge->set.slant.value == Approx(30.0));
    gauge.key("left");
    gauge.key("space");
    CHECK(gauge.sheet->is_complete());
    const GivenAnswer given = gauge.given();
    CHECK_FALSE(given.is_missed);
    CHECK(given.key == "space");
    REQUIRE(given.gauge);
    CHECK(given.gauge->start.slant.value == 30.0);
    CHECK(given.gauge->start.tilt.value == 120.0);
    CHECK(given.gauge->probe == "place");
    CHECK(given.gauge->point == "seen.3");
    CHECK(given.number == Approx(given.gauge->set.slant.value));
}

TEST_CASE("a click with the right button accepts, and leans nothing", "[unit]") {
    Leaned gauge;
    gauge.mouse(GaugeInput::pointer_down, 0.0, 0.0, 3);
    gauge.mouse(GaugeInput::pointer_up, 0.0, 0.0, 3);
    CHECK_FALSE(gauge.sheet->is_complete());
    gauge.drag(0.0, 0.0, 8.0, 0.0);
    const Attitude before = gauge.set();
    gauge.mouse(GaugeInput::pointer_down, 300.0, 0.0, 3);
    CHECK(gauge.sheet->is_complete());
    CHECK(gauge.given().gauge->set == before);
    CHECK(gauge.given().device == "mouse");
}

TEST_CASE("its slant ends short of a right angle, which is flagged", "[unit]") {
    Leaned gauge;
    gauge.drag(0.0, 0.0, 100.0, 0.0);
    CHECK(gauge.set().slant.value == Approx(50.0));
    CHECK_FALSE(gauge.given().gauge->is_at_limit);
    gauge.drag(0.0, 0.0, 500.0, 0.0);
    CHECK(gauge.set().slant.value == Approx(89.0));
    CHECK(gauge.given().gauge->is_at_limit);
    CHECK(gauge.set().tilt.value == Approx(0.0).margin(1e-9));
}

TEST_CASE("each change is in the record with what it came to", "[unit]") {
    Leaned gauge;
    gauge.key("right");
    gauge.drag(0.0, 0.0, 0.0, -8.0);
    std::vector<GivenAnswer> answers;
    std::vector<AnswerInput> inputs;
    gauge.sheet->add_to(answers, inputs);
    REQUIRE(inputs.size() == 5); // down and up of the key, of the button, and a move
    CHECK(inputs[0].attitude->slant.value == Approx(4.0));
    CHECK(inputs[3].attitude->slant.value == Approx(std::hypot(4.0, 4.0)));
    CHECK(inputs[3].has_counted);
}

TEST_CASE("moves of the mouse that no screen shows apart are one in the record", "[unit]") {
    Leaned gauge;
    gauge.mouse(GaugeInput::pointer_down, 0.0, 0.0);
    for (int i = 1; i <= 8000; ++i) {
        ObserverInput input{
            .kind = GaugeInput::pointer_moved, .at = gauge.now += 125us, .device = ShortName("mouse")};
        input.right_px = 0.01 * i;
        gauge.sheet->take(input, {});
    }
    CHECK(gauge.set().slant.value == Approx(40.0));
    CHECK(gauge.sheet->lost_inputs() == 0);
    std::vector<GivenAnswer> answers;
    std::vector<AnswerInput> inputs;
    gauge.sheet->add_to(answers, inputs);
    CHECK(inputs.size() > 200); // of a second
    CHECK(inputs.size() < 300);
    CHECK(inputs.back().attitude->slant.value == Approx(40.0));
}
