/// The keys of simulated observers: each that goes down goes up.
#include "devices/simulated/simulated_keys.h"

#include <catch2/catch.hpp>

using namespace overt;
using namespace std::chrono_literals;

namespace {

Protocol asked() {
    Protocol protocol;
    protocol.tasks.emplace_back().id = "judge";
    return protocol;
}

AnswerOffer number_keys() {
    AnswerOffer offer;
    offer.id = "quality";
    offer.item = "gloss";
    offer.kind = "scale";
    offer.values = offer.keys = {"1", "2", "3"};
    offer.numbers = {1.0, 2.0, 3.0};
    offer.low = 1.0;
    offer.high = 3.0;
    offer.step = 1.0;
    offer.accept_key = "enter";
    return offer;
}

/// All that come until then, in turn.
std::vector<ObserverInput> until(SimulatedKeys& keys, SessionTime end) {
    std::vector<ObserverInput> inputs;
    while (const std::optional<ObserverInput> input = keys.next(end))
        inputs.push_back(*input);
    return inputs;
}

/// The key that accepts is down, and not up yet; gives when it came down.
SessionTime press_to_accept(SimulatedKeys& keys, const SimulatedAnswers& answers) {
    keys.plan(answers, {number_keys()}, {});
    keys.awaited(SessionTime(1s));
    keys.window_opened(SessionTime(2s));
    for (SessionTime now = SessionTime(2s); now < SessionTime(60s); now += 1ms)
        if (const std::optional<ObserverInput> input = keys.next(now);
            input && input->kind == ObserverInput::Kind::key_down && input->key.view() == "enter")
            return input->at;
    return {};
}

} // namespace

TEST_CASE("a key that is down when the next screen is planned is let go at its time, before its presses",
          "[unit]") {
    const Protocol protocol = asked();
    const SimulatedAnswers answers(protocol, 3);
    SimulatedKeys keys;
    const SessionTime down = press_to_accept(keys, answers);
    REQUIRE(down > SessionTime(2s));
    keys.plan(answers, {number_keys()}, {});
    keys.window_opened(down);
    CHECK(until(keys, down + 69ms).empty());
    const std::vector<ObserverInput> inputs = until(keys, down + 60s);
    REQUIRE(inputs.size() == 5);
    CHECK(inputs[0].kind == ObserverInput::Kind::key_up);
    CHECK(inputs[0].key.view() == "enter");
    CHECK(inputs[0].at == down + 70ms);
    CHECK(inputs[1].kind == ObserverInput::Kind::key_down);
    CHECK(inputs[1].at > inputs[0].at);
    CHECK(inputs[4].kind == ObserverInput::Kind::key_up);
}

TEST_CASE("after the last screen a key that is down is let go, and nothing else comes", "[unit]") {
    const Protocol protocol = asked();
    const SimulatedAnswers answers(protocol, 3);
    SimulatedKeys keys;
    const SessionTime down = press_to_accept(keys, answers);
    keys.clear();
    const std::vector<ObserverInput> inputs = until(keys, down + 60s);
    REQUIRE(inputs.size() == 1);
    CHECK(inputs[0].kind == ObserverInput::Kind::key_up);
    CHECK(until(keys, down + 120s).empty());
    // What was let go already is not let go again.
    keys.clear();
    CHECK(until(keys, down + 120s).empty());
}

TEST_CASE("clicks on places go to where the eye points then, but for a few pixels", "[unit]") {
    const Protocol protocol = asked();
    const SimulatedAnswers answers(protocol, 3);
    AnswerOffer offer;
    offer.id = "where";
    offer.kind = "point";
    SimulatedKeys keys;
    SessionTime asked_at{};
    keys.let_gaze_guide([&](SessionTime at) {
        asked_at = at;
        return glm::dvec2(200.0, -100.0);
    });
    keys.plan(answers, {offer}, {});
    keys.awaited(SessionTime(1s));
    keys.window_opened(SessionTime(2s));
    const std::vector<ObserverInput> inputs = until(keys, SessionTime(60s));
    REQUIRE(inputs.size() == 3);
    CHECK(inputs[1].kind == ObserverInput::Kind::pointer_down);
    CHECK(inputs[1].right_px == Approx(200.0).margin(20.0));
    CHECK(inputs[1].down_px == Approx(-100.0).margin(20.0));
    CHECK(inputs[1].right_px != 200.0);
    CHECK(asked_at == inputs[2].at);
}
