#include <catch2/catch.hpp>

#include <set>

#include "devices/simulated/simulated_response_panel.h"
#include "tests/devices/simulated/sitting.h"

using namespace overt;
using namespace std::chrono_literals;
using test::SimulatedSitting;

TEST_CASE("the observer presses a key at its response time, and again while that has no effect", "[unit]") {
    SimulatedSitting sitting(21);
    SimulatedResponsePanel panel(sitting.clock, sitting.observer);
    CHECK_FALSE(panel.poll().has_value());
    const Trial trial{3, 1, {}};
    const SessionTime since(10s);
    sitting.clock.wait_until(since);
    panel.await_response(trial, since);
    const SimulatedAnswer expected = sitting.observer.answer_to(trial);
    CHECK_FALSE(panel.poll().has_value());

    sitting.clock.wait_until(since + expected.after - 1ns);
    CHECK_FALSE(panel.poll().has_value());
    sitting.clock.wait_until(since + expected.after + 3ms);
    const std::optional<ResponsePress> press = panel.poll();
    REQUIRE(press.has_value());
    CHECK(press->key == ResponsePress::Key::next);
    CHECK(press->pressed_at == since + expected.after);
    CHECK(panel.answer() == expected.text);
    CHECK_FALSE(panel.poll().has_value());
    sitting.clock.wait_until(since + expected.after + 1s);
    CHECK(panel.poll().has_value());
}

TEST_CASE("a text is read for a while and answered with a key alone", "[unit]") {
    SimulatedSitting sitting(22);
    SimulatedResponsePanel panel(sitting.clock, sitting.observer);
    panel.await_response({0, 0, {}}, SessionTime());
    panel.await_key(SessionTime());
    CHECK(panel.answer().empty());
    sitting.clock.wait_until(SessionTime(15s));
    const std::optional<ResponsePress> press = panel.poll();
    REQUIRE(press.has_value());
    CHECK(press->pressed_at >= SessionTime(800ms));
}

TEST_CASE("a simulated operator ends a pause, and not one that has ended by itself", "[unit]") {
    SimulatedSitting sitting(24);
    SimulatedResponsePanel panel(sitting.clock, sitting.observer);
    panel.entered(SessionPhase::pause, 0);
    sitting.clock.wait_until(SessionTime(6s));
    const std::optional<ResponsePress> press = panel.poll();
    REQUIRE(press.has_value());
    CHECK(press->key == ResponsePress::Key::pause);

    panel.entered(SessionPhase::task_screen, 0);
    panel.entered(SessionPhase::pause, 0);
    panel.entered(SessionPhase::task_screen, 0);
    sitting.clock.wait_until(SessionTime(20s));
    CHECK_FALSE(panel.poll().has_value());
}

TEST_CASE("a simulated operator says yes to what is asked five times, and then no until a new trial comes",
          "[unit]") {
    SimulatedSitting sitting(25);
    SimulatedResponsePanel panel(sitting.clock, sitting.observer);
    const auto said = [&] {
        const SessionTime since = sitting.clock.now();
        panel.await(Awaited::decision, since, nullptr);
        sitting.clock.wait_until(since + 2s);
        const std::optional<ResponsePress> press = panel.poll();
        REQUIRE(press.has_value());
        return press->key;
    };
    for (const int trial : {0, 1}) {
        for (int time = 0; time < 7; ++time) {
            // The tracker is lost, set up again, and lost in the same trial.
            panel.entered(SessionPhase::trial, trial);
            CHECK(said() == (time < 5 ? ResponsePress::Key::yes : ResponsePress::Key::no));
            panel.entered(SessionPhase::calibration, trial);
        }
    }
    panel.entered(SessionPhase::trial, 0); // one that comes again later is no new one
    CHECK(said() == ResponsePress::Key::no);
}

TEST_CASE("answers differ between trials and repeat with the seed", "[unit]") {
    SimulatedSitting one(23), same(23);
    std::set<std::string> texts;
    std::set<SessionDuration> times;
    for (int trial = 0; trial < 30; ++trial) {
        const SimulatedAnswer answer = one.observer.answer_to({trial, trial % 2, {}});
        const SimulatedAnswer again = same.observer.answer_to({trial, trial % 2, {}});
        CHECK(answer.text == again.text);
        CHECK(answer.after == again.after);
        CHECK_FALSE(answer.text.empty());
        CHECK(answer.after >= 800ms);
        CHECK(answer.after <= 45s);
        texts.insert(answer.text);
        times.insert(answer.after);
    }
    CHECK(texts.size() > 4);
    CHECK(times.size() == 30);
}

TEST_CASE("a place is pointed at from where the eye is then, counted from the middle of the screen",
          "[unit]") {
    SimulatedSitting sitting(8, test::without_wandering());
    Protocol protocol;
    protocol.tasks.emplace_back().id = "free";
    const SimulatedAnswers answers(protocol, 8);
    SimulatedResponsePanel panel(sitting.clock, sitting.observer, {}, &answers);
    Screen screen;
    screen.kind = Screen::Kind::target;
    screen.target_place = ScreenPoint{1200.0, 300.0};
    sitting.observer.screen_shown(screen, sitting.clock.now());
    sitting.clock.wait_until(sitting.clock.now() + std::chrono::seconds(2));
    AnswerOffer offer;
    offer.id = "where";
    offer.kind = "point";
    const Trial trial;
    panel.await(Awaited::answer, sitting.clock.now(), &trial);
    panel.offer({offer});
    panel.window_opened(sitting.clock.now());
    sitting.clock.wait_until(sitting.clock.now() + std::chrono::seconds(60));
    const std::optional<ObserverInput> input = panel.next_input();
    REQUIRE(input);
    CHECK(input->kind == ObserverInput::Kind::pointer_moved);
    // But for some pixels.
    const ScreenPoint middle = sitting.observer.scene().screen.centre();
    CHECK(std::abs(input->right_px - (1200.0 - middle.x_px)) < 25.0);
    CHECK(std::abs(input->down_px - (300.0 - middle.y_px)) < 25.0);
}

TEST_CASE("who presses too early does so 20 ms after the question, before it can be answered", "[unit]") {
    SimulatedSitting sitting(8);
    Protocol protocol;
    protocol.tasks.emplace_back().id = "free";
    protocol.tasks[0].answers.emplace_back().id = "which";
    protocol.tasks[0].answers[0].truth.early = 1.0;
    const SimulatedAnswers answers(protocol, 8);
    SimulatedResponsePanel panel(sitting.clock, sitting.observer, {}, &answers);
    AnswerOffer offer;
    offer.id = "which";
    offer.kind = "choice";
    offer.values = offer.keys = {"f", "j"};
    const Trial trial;
    const SessionTime asked = sitting.clock.now();
    panel.await(Awaited::answer, asked, &trial);
    panel.offer({offer});
    sitting.clock.wait_until(asked + 20ms - 1ns);
    CHECK_FALSE(panel.next_input());
    sitting.clock.wait_until(asked + 20ms);
    const auto input = panel.next_input();
    REQUIRE(input);
    CHECK(input->at == asked + 20ms);
    CHECK(input->key.view() == "f");
    CHECK(input->kind == ObserverInput::Kind::key_down);
}
