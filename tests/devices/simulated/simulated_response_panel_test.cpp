#include <catch2/catch.hpp>

#include <cmath>
#include <set>

#include "devices/simulated/operator_script.h"
#include "devices/simulated/simulated_response_panel.h"
#include "experiment/ports/session_log.h"
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

namespace {

/// Keeps the key presses, and nothing else.
class PressedKeys final : public SessionLog {
  public:
    std::vector<RecordedKeyPress> presses;
    int calls = 0;
    void key_presses(const std::vector<RecordedKeyPress>& more) override {
        ++calls;
        presses.insert(presses.end(), more.begin(), more.end());
    }
    void flip(const FlipRecord&) noexcept override {}
    void missed(const MissedRefresh&) noexcept override {}
    void sample(int, const GazeSample&) noexcept override {}
    void clock_pair(const ClockPair&) noexcept override {}
    void event(const SessionEvent&) override {}
    void trial_started(const Trial&, SessionTime) override {}
    void trial_finished(const Trial&, const TrialOutcome&) override {}
};

} // namespace

TEST_CASE("each key of a simulated observer is written down once, with its time, trial and screen",
          "[unit]") {
    SimulatedSitting sitting(26);
    SimulatedResponsePanel panel(sitting.clock, sitting.observer);
    PressedKeys log;
    panel.write_down(log);
    CHECK(log.calls == 0);
    const Trial trial{3, 1, {}};
    panel.entered(SessionPhase::trial, 3);
    panel.entered(SessionPhase::response_screen, 3);
    panel.await(Awaited::response, sitting.clock.now(), &trial);
    std::vector<SessionTime> pressed;
    const auto press_until = [&](std::size_t count) {
        while (pressed.size() < count) {
            sitting.clock.wait_until(sitting.clock.now() + 100ms);
            if (const auto press = panel.poll())
                pressed.push_back(press->pressed_at);
        }
    };
    press_until(3);
    panel.write_down(log);
    CHECK(log.calls == 1);
    REQUIRE(log.presses.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(log.presses[i].at == pressed[i]);
        CHECK(log.presses[i].trial == 3);
        CHECK(log.presses[i].device == simulated_observer_device);
        CHECK(log.presses[i].name == "space");
        CHECK(log.presses[i].screen == SessionPhase::response_screen);
        CHECK(log.presses[i].meaning == "next");
    }
    panel.write_down(log);
    CHECK(log.calls == 1);
    // There is room for sixty-four until they are written down.
    press_until(3 + 70);
    panel.write_down(log);
    CHECK(log.presses.size() == 3 + 64);
    CHECK(log.presses.back().at == pressed[3 + 63]);
    // Before a stimulus nothing is pressed that goes on, and what is decided is the operator's.
    panel.entered(SessionPhase::stimulus, 3);
    panel.await(Awaited::key, sitting.clock.now(), nullptr);
    press_until(75);
    panel.entered(SessionPhase::task_screen, 3);
    panel.await(Awaited::decision, sitting.clock.now(), nullptr);
    press_until(76);
    panel.write_down(log);
    CHECK(log.presses.size() == 3 + 64);
}

TEST_CASE("spoken answers begin in the first half of an answer's time, end before its key, and have their "
          "tasks' texts",
          "[unit]") {
    SimulatedSitting sitting(27); // of the tasks "free" and "clothes"
    std::set<std::string> free, clothes;
    int at_half = 0;
    double log_sum = 0.0, voice_log_sum = 0.0, shortest_answer_s = 99.0;
    constexpr int trials = 3000;
    for (int trial = 0; trial < trials; ++trial) {
        const SimulatedAnswer answer = sitting.observer.answer_to({trial, trial % 2, {}});
        const double after_s = to_seconds(answer.after), voice_s = to_seconds(answer.voice_after),
                     end_s = to_seconds(answer.voice_until);
        REQUIRE(after_s >= 0.8);
        REQUIRE(after_s <= 45.0);
        REQUIRE(voice_s <= 0.5 * after_s + 1e-9);
        REQUIRE(voice_s >= std::min(0.25, 0.5 * after_s) - 1e-9);
        REQUIRE(voice_s <= 3.0);
        REQUIRE(end_s == Approx(std::max(voice_s + 0.2, after_s - 0.3)));
        shortest_answer_s = std::min(shortest_answer_s, after_s);
        at_half += std::abs(voice_s - 0.5 * after_s) < 1e-9;
        (trial % 2 == 0 ? free : clothes).insert(answer.text);
        if (trial % 2 == 0)
            log_sum += std::log(after_s) / (0.5 * trials);
        voice_log_sum += std::log(voice_s) / trials;
    }
    CHECK(at_half > 0);
    CHECK(shortest_answer_s < 1.6);
    CHECK(std::exp(log_sum) == Approx(4.0).epsilon(0.03)); // the median of "free"
    CHECK(std::exp(voice_log_sum) == Approx(0.7).epsilon(0.03));
    CHECK(free == std::set<std::string>{"I have finished.", "I looked all around it.", "Done.",
                                        "A figure, turning slowly."});
    CHECK(clothes == std::set<std::string>{"A long loose robe.", "A cloak over one shoulder.",
                                           "Hardly any, a cloth around the hips.", "A tunic with a belt."});
    // As short as it gets, where the median leaves it no room above.
    double shortest_s = 99.0;
    for (int count = 0; count < 5000; ++count) {
        const double reading_s = to_seconds(sitting.observer.reading_time(count));
        REQUIRE(reading_s >= 0.8);
        REQUIRE(reading_s <= 15.0);
        shortest_s = std::min(shortest_s, reading_s);
    }
    CHECK(shortest_s < 1.2);
}

TEST_CASE("the shortest spoken answers end 0.2 s after they began, and others 0.3 s before the key",
          "[unit]") {
    const SimulatedSitting sitting(28);
    int short_ones = 0, long_ones = 0;
    for (int trial = 0; trial < 120'000; ++trial) {
        const SimulatedAnswer answer = sitting.observer.answer_to({trial, 0, {}});
        const double after_s = to_seconds(answer.after), voice_s = to_seconds(answer.voice_after);
        const bool is_short = voice_s + 0.2 > after_s - 0.3;
        short_ones += is_short && std::abs(to_seconds(answer.voice_until) - voice_s - 0.2) < 1e-8;
        long_ones += !is_short && std::abs(to_seconds(answer.voice_until) - after_s + 0.3) < 1e-8;
    }
    CHECK(short_ones > 0);
    CHECK(short_ones + long_ones == 120'000);
}

TEST_CASE("turning that was planned is over with its trial, and goes on between its screens", "[unit]") {
    SimulatedSitting sitting(29);
    Protocol protocol;
    protocol.tasks.emplace_back().id = "free";
    const SimulatedAnswers answers(protocol, 29);
    SimulatedResponsePanel panel(sitting.clock, sitting.observer, {}, &answers);
    const Trial trial;
    const auto inputs_after = [&](SessionPhase phase) {
        panel.await(Awaited::answer, sitting.clock.now(), &trial);
        TurningOffer turning;
        turning.since = sitting.clock.now();
        turning.lasts_s = 60.0;
        turning.pause_s = 0.5;
        turning.turn_sd_deg = 20.0;
        turning.deg_per_px = 0.25;
        panel.offer_turning(turning);
        panel.entered(phase, 0);
        sitting.clock.wait_until(sitting.clock.now() + std::chrono::seconds(60));
        int inputs = 0;
        while (panel.next_input())
            ++inputs;
        return inputs;
    };
    CHECK(inputs_after(SessionPhase::response_screen) > 10);
    CHECK(inputs_after(SessionPhase::trial) == 0);
}

TEST_CASE("of what an observer's script does, keys are written down, and words are not", "[unit]") {
    SimulatedSitting sitting(30);
    const std::vector<ScriptedOperatorKey> script{read_operator_key("response screen+1=press 7", 0),
                                                  read_operator_key("response screen+2=type seven", 0)};
    SimulatedResponsePanel panel(sitting.clock, sitting.observer, script);
    PressedKeys log;
    const Trial trial{0, 0, {}};
    panel.entered(SessionPhase::trial, 0);
    panel.entered(SessionPhase::response_screen, 0);
    panel.await(Awaited::answer, sitting.clock.now(), &trial);
    const SessionTime began = sitting.clock.now();
    sitting.clock.wait_until(began + std::chrono::seconds(3));
    for (int i = 0; i < 5; ++i)
        panel.poll();
    panel.write_down(log);
    REQUIRE(log.presses.size() == 1);
    CHECK(log.presses[0].name == "7");
    CHECK(log.presses[0].at == began + std::chrono::seconds(1));
}

TEST_CASE("what was offered before an answer is awaited is answered, too", "[unit]") {
    SimulatedSitting sitting(31);
    Protocol protocol;
    protocol.tasks.emplace_back().id = "free";
    const SimulatedAnswers answers(protocol, 31);
    SimulatedResponsePanel panel(sitting.clock, sitting.observer, {}, &answers);
    AnswerOffer offer;
    offer.id = "which";
    offer.kind = "choice";
    offer.values = offer.keys = {"f", "j"};
    const Trial trial;
    panel.offer({offer});
    panel.await(Awaited::answer, sitting.clock.now(), &trial);
    panel.window_opened(sitting.clock.now());
    sitting.clock.wait_until(sitting.clock.now() + std::chrono::seconds(60));
    CHECK(panel.next_input());
}

TEST_CASE("the longest answers, the soonest voices and the shortest readings are as long as they may be",
          "[unit]") {
    const Mesh mesh = test::bust();
    ObservedScene scene = test::scene_with(mesh);
    scene.tasks = {{"thoughts", {0.4}}};
    const SimulatedObserver observer(scene, 28);
    double longest_s = 0.0, soonest_s = 99.0, shortest_s = 99.0;
    for (int index = 0; index < 60'000; ++index) {
        const SimulatedAnswer answer = observer.answer_to({index, 0, {}});
        longest_s = std::max(longest_s, to_seconds(answer.after));
        soonest_s = std::min(soonest_s, to_seconds(answer.voice_after));
        shortest_s = std::min(shortest_s, to_seconds(observer.reading_time(index)));
    }
    CHECK(longest_s <= 45.0);
    CHECK(longest_s > 38.0);
    CHECK(soonest_s >= 0.25);
    CHECK(soonest_s < 0.26);
    CHECK(shortest_s >= 0.8);
    CHECK(shortest_s < 0.9);
}

TEST_CASE("each text has its own reading time, counted from when it is shown", "[unit]") {
    SimulatedSitting sitting(31);
    SimulatedResponsePanel panel(sitting.clock, sitting.observer);
    for (int text = 0; text < 4; ++text) {
        sitting.clock.wait_until(sitting.clock.now() + std::chrono::seconds(20));
        const SessionTime since = sitting.clock.now();
        panel.await(text == 2 ? Awaited::consent : Awaited::key, since, nullptr);
        const SessionTime due = since + sitting.observer.reading_time(text);
        sitting.clock.wait_until(due - SessionDuration(1));
        CHECK_FALSE(panel.poll());
        sitting.clock.wait_until(due);
        const auto press = panel.poll();
        REQUIRE(press);
        CHECK(press->pressed_at == due);
        CHECK(press->key == (text == 2 ? ResponsePress::Key::yes : ResponsePress::Key::next));
        CHECK(panel.answer().empty());
    }
}
