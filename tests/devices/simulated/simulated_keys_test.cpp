/// The keys of simulated observers: each that goes down goes up.
#include "devices/simulated/simulated_keys.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/ports/recorded_key_press.h"

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
    CHECK(inputs[1].button == 1);
    CHECK(inputs[1].right_px == Approx(200.0).margin(20.0));
    CHECK(inputs[1].down_px == Approx(-100.0).margin(20.0));
    CHECK(inputs[1].right_px != 200.0);
    CHECK(asked_at == inputs[2].at);
}

namespace {

AnswerOffer offer_called(std::string kind) {
    AnswerOffer offer;
    offer.id = "what";
    offer.kind = std::move(kind);
    return offer;
}

/// What comes of one offer, after its window opened at 2 s; a line each, with its time after that in ms.
std::vector<std::string> lines_of(const AnswerOffer& offer, const Trial& trial, std::uint64_t seed = 3) {
    const Protocol protocol = asked();
    const SimulatedAnswers answers(protocol, seed);
    SimulatedKeys keys;
    keys.awaited(SessionTime(1s));
    keys.plan(answers, {offer}, trial);
    keys.window_opened(SessionTime(2s));
    std::vector<std::string> lines;
    const SessionDuration after = answers.answer(offer, trial).after;
    for (const ObserverInput& input : until(keys, SessionTime(300s))) {
        CHECK(input.device.view() == simulated_observer_device);
        const auto ms = (input.at - SessionTime(2s) - after) / 1ms;
        constexpr std::string_view names[] = {"down", "up", "text", "moved", "pressed", "released"};
        using Kind = ObserverInput::Kind;
        const std::size_t name = input.kind == Kind::key_down        ? 0
                                 : input.kind == Kind::key_up        ? 1
                                 : input.kind == Kind::text          ? 2
                                 : input.kind == Kind::pointer_moved ? 3
                                 : input.kind == Kind::pointer_down  ? 4
                                                                     : 5;
        lines.push_back(fmt::format("{} {} {}{}", ms, names[name], input.key.view(),
                                    name == 2 ? std::string(1, static_cast<char>(input.character)) : ""));
    }
    return lines;
}

/// The names of keys that go down, in turn.
std::vector<std::string> pressed_of(const std::vector<std::string>& lines) {
    std::vector<std::string> names;
    for (const std::string& line : lines)
        if (const std::size_t at = line.find(" down "); at != std::string::npos)
            names.push_back(line.substr(at + 6));
    return names;
}

} // namespace

TEST_CASE("a choice is the key of what is meant, held for 70 ms, and accepted 300 ms after it", "[unit]") {
    AnswerOffer offer = offer_called("choice");
    offer.values = {"near", "far", "same"};
    offer.keys = {"f", "j", "space"};
    const Protocol protocol = asked();
    const SimulatedAnswers answers(protocol, 3);
    std::array<int, 3> often{};
    for (int index = 0; index < 30; ++index) {
        Trial trial;
        trial.index = index;
        const auto meant = static_cast<std::size_t>(answers.answer(offer, trial).choice);
        ++often[meant];
        const std::string& key = offer.keys[meant];
        offer.accept_key.clear();
        CHECK(lines_of(offer, trial) == std::vector<std::string>{"0 down " + key, "70 up " + key});
        offer.accept_key = "enter";
        CHECK(lines_of(offer, trial) ==
              std::vector<std::string>{"0 down " + key, "70 up " + key, "300 down enter", "370 up enter"});
    }
    for (const int count : often)
        CHECK(count > 0);
    offer.keys.clear(); // by the mouse alone: simulated observers have none
    CHECK(lines_of(offer, {}).empty());
}

TEST_CASE("a number is its nearest step's key, or is typed, and words are", "[unit]") {
    const Protocol protocol = asked();
    const SimulatedAnswers answers(protocol, 3);
    AnswerOffer steps = number_keys();
    AnswerOffer number = offer_called("number");
    number.low = 2.0;
    number.high = 9.0;
    number.step = 0.5;
    for (int index = 0; index < 20; ++index) {
        Trial trial;
        trial.index = index;
        const double judged = answers.answer(steps, trial).number.value();
        CHECK(pressed_of(lines_of(steps, trial)) ==
              std::vector<std::string>{fmt::format("{:.0f}", judged), "enter"});
        const std::string typed = fmt::format("{:.10g}", answers.answer(number, trial).number.value());
        const std::vector<std::string> lines = lines_of(number, trial);
        REQUIRE(lines.size() == typed.size());
        for (std::size_t i = 0; i < typed.size(); ++i)
            CHECK(lines[i] == fmt::format("{} text {}", 120 * i, typed[i]));
    }
    CHECK(lines_of(offer_called("text"), {}) ==
          std::vector<std::string>{"0 text s", "120 text e", "240 text e", "360 text n"});
}

TEST_CASE("the marker of a line comes by arrows and coarse steps to where it is meant, on either side",
          "[unit]") {
    const Protocol protocol = asked();
    for (const bool is_turned : {false, true})
        for (std::uint64_t seed = 0; seed < 30; ++seed) {
            const SimulatedAnswers answers(protocol, seed);
            AnswerOffer offer = offer_called("scale");
            offer.low = -1.0;
            offer.high = 5.0;
            offer.step = seed % 3 == 0 ? 0.05 : seed % 3 == 1 ? 0.5 : 2.0;
            offer.is_turned = is_turned;
            Trial trial;
            trial.index = static_cast<int>(seed);
            const int moves = static_cast<int>(std::lround(6.0 / offer.step));
            const double judged = answers.answer(offer, trial).number.value();
            const int target = static_cast<int>(std::lround((judged + 1.0) / offer.step));
            // The first press has the marker come up in the middle.
            int at = moves / 2;
            const std::vector<std::string> pressed = pressed_of(lines_of(offer, trial, seed));
            REQUIRE_FALSE(pressed.empty());
            for (std::size_t i = 1; i < pressed.size(); ++i) {
                const std::string& key = pressed[i];
                const int right = key == "right" ? 1 : key == "left" ? -1 : key == "page up" ? 10 : -10;
                CHECK((key == "right" || key == "left" || key == "page up" || key == "page down"));
                at += is_turned ? -right : right;
                CHECK(at >= 0);
                CHECK(at <= moves);
            }
            CHECK(at == target);
            CHECK(pressed.size() <= 3 + 10 + static_cast<std::size_t>(moves / 10));
        }
}

TEST_CASE("a match is set column by column, by coarse steps first, with no step too many", "[unit]") {
    const Protocol protocol = asked();
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const SimulatedAnswers answers(protocol, seed);
        AnswerOffer offer = offer_called("match");
        for (int i = 0; i < 3; ++i) {
            OfferedAxis axis;
            for (int k = 0; k < 20; ++k)
                axis.values.push_back(k);
            axis.start = i == 0 ? 0 : 19;
            axis.less = i == 2 ? "" : fmt::format("less {}", i);
            axis.more = i == 2 ? "" : fmt::format("more {}", i);
            if (i == 0) {
                axis.much_less = "down";
                axis.much_more = "up";
                axis.coarse = 4;
            }
            offer.axes.push_back(axis);
        }
        const std::vector<int> at = answers.answer(offer, {}).at;
        REQUIRE(at.size() == 3);
        std::array<int, 2> here{0, 19};
        const std::vector<std::string> pressed = pressed_of(lines_of(offer, {}, seed));
        for (const std::string& key : pressed) {
            if (key == "up" || key == "down")
                here[0] += key == "up" ? 4 : -4;
            else
                here[key.back() == '0' ? 0 : 1] += key.starts_with("more") ? 1 : -1;
        }
        CHECK(here[0] == at[0]);
        CHECK(here[1] == at[1]);
        CHECK(static_cast<int>(pressed.size()) == at[0] / 4 + at[0] % 4 + (19 - at[1]));
    }
}

TEST_CASE("a gauge is leaned by one drag from the attitude that it has to that which is meant", "[unit]") {
    const Protocol protocol = asked();
    const SimulatedAnswers answers(protocol, 3);
    AnswerOffer offer = offer_called("gauge");
    offer.attitude = Attitude{{20.0}, {90.0}}; // up
    offer.true_attitude = Attitude{{40.0}, {0.0}};
    offer.slant_per_px_deg = 0.5;
    SimulatedKeys keys;
    keys.plan(answers, {offer}, {});
    keys.window_opened(SessionTime(2s));
    const Attitude meant = answers.answer(offer, {}).attitude.value();
    const std::vector<ObserverInput> inputs = until(keys, SessionTime(300s));
    REQUIRE(inputs.size() == 3);
    CHECK(inputs[0].kind == ObserverInput::Kind::pointer_down);
    CHECK(inputs[0].right_px == 0.0);
    CHECK(inputs[1].kind == ObserverInput::Kind::pointer_moved);
    CHECK(inputs[2].kind == ObserverInput::Kind::pointer_up);
    CHECK(inputs[1].at - inputs[0].at == 120ms);
    CHECK(inputs[2].at - inputs[1].at == 120ms);
    const double tilt = to_radians(meant.tilt).value;
    for (const std::size_t i : {1u, 2u}) {
        CHECK(inputs[i].right_px == Approx(meant.slant.value * std::cos(tilt) / 0.5));
        CHECK(inputs[i].down_px == Approx(-(meant.slant.value * std::sin(tilt) - 20.0) / 0.5));
        CHECK(inputs[i].button == 1);
    }
    offer.true_attitude.reset(); // nobody knows what is meant
    CHECK(lines_of(offer, {}).empty());
}

TEST_CASE("who misses presses nothing, and who is too early presses before the window too", "[unit]") {
    Protocol protocol = asked();
    protocol.tasks[0].answers.resize(1);
    TaskAnswer& answer = protocol.tasks[0].answers[0];
    answer.id = "what";
    AnswerOffer offer = offer_called("choice");
    offer.values = {"near", "far"};
    offer.keys = {"f", "j"};
    const auto inputs_with = [&](double missing, double early) {
        answer.truth.missing = missing;
        answer.truth.early = early;
        const SimulatedAnswers answers(protocol, 3);
        SimulatedKeys keys;
        keys.awaited(SessionTime(1s));
        keys.plan(answers, {offer}, {});
        keys.window_opened(SessionTime(2s));
        return until(keys, SessionTime(300s));
    };
    CHECK(inputs_with(1.0, 0.0).empty());
    CHECK(inputs_with(0.0, 0.0).size() == 2);
    const auto early = inputs_with(1.0, 1.0);
    REQUIRE(early.size() == 2);
    CHECK(early[0].at == SessionTime(1s) + 20ms);
    CHECK(early[1].at == SessionTime(1s) + 90ms);
    CHECK(early[0].key.view() == "f");
    CHECK(inputs_with(0.0, 1.0).size() == 4);
}

TEST_CASE("a gauge is meant as the surface leans by its gain, sheared as the observer sees it", "[unit]") {
    Protocol protocol = asked();
    protocol.tasks[0].answers.resize(1);
    TaskAnswer& answer = protocol.tasks[0].answers[0];
    answer.id = "what";
    answer.truth.noise = 0.0;
    answer.truth.gain = 1.0;
    AnswerOffer offer = offer_called("gauge");
    offer.attitude = Attitude{{20.0}, {90.0}};
    const auto meant = [&](const Attitude& surface) {
        offer.true_attitude = surface;
        return SimulatedAnswers(protocol, 3).answer(offer, {}).attitude.value();
    };
    CHECK(meant({{40.0}, {0.0}}).slant.value == Approx(40.0));
    CHECK(meant({{40.0}, {70.0}}).tilt.value == Approx(70.0));
    answer.truth.shear = {0.3, 0.4};
    // Of a surface that is seen from the front the shear is all: a rise of a half.
    CHECK(meant({{0.0}, {0.0}}).slant.value == Approx(to_degrees({std::atan(0.5)}).value));
    answer.truth.shear.clear();
    answer.truth.gain = 0.5;
    CHECK(meant({{45.0}, {0.0}}).slant.value == Approx(to_degrees({std::atan(0.5)}).value));
}

TEST_CASE("what is planned comes at its instant, and not before", "[unit]") {
    const Protocol protocol = asked();
    const SimulatedAnswers answers(protocol, 3);
    AnswerOffer offer = offer_called("choice");
    offer.values = {"near"};
    offer.keys = {"f"};
    SimulatedKeys keys;
    keys.plan(answers, {offer}, {});
    keys.awaited(SessionTime(1s));
    CHECK(until(keys, SessionTime(300s)).empty()); // no window has opened
    keys.window_opened(SessionTime(2s));
    const SessionTime down = SessionTime(2s) + answers.answer(offer, {}).after;
    CHECK(until(keys, down - 1ns).empty());
    CHECK(until(keys, down).size() == 1);
    CHECK(until(keys, down + 70ms - 1ns).empty());
    SimulatedKeys left = keys;
    CHECK(until(keys, down + 70ms).size() == 1);
    left.clear(); // and what was down is let go at that instant, too
    CHECK(until(left, down + 70ms - 1ns).empty());
    CHECK(until(left, down + 70ms).size() == 1);
    // Who has told all has nothing to let go, whatever was planned once.
    for (const bool accepts : {false, true}) {
        offer.accept_key = accepts ? "enter" : "";
        keys.plan(answers, {offer, offer}, {});
        keys.window_opened(SessionTime(2s));
        CHECK(until(keys, SessionTime(300s)).size() == (accepts ? 8 : 4));
        keys.clear();
        CHECK(until(keys, SessionTime(300s)).empty());
        // Nor who has told nothing.
        keys.plan(answers, {offer}, {});
        keys.window_opened(SessionTime(2s));
        keys.clear();
        CHECK(until(keys, SessionTime(300s)).empty());
    }
}

TEST_CASE("a line of one step is set by one key to either side, and steps without keys by the marker",
          "[unit]") {
    Protocol protocol = asked();
    protocol.tasks[0].answers.resize(1);
    TaskAnswer& truth = protocol.tasks[0].answers[0];
    truth.id = "what";
    AnswerOffer offer = offer_called("scale");
    offer.low = 0.0;
    offer.high = 1.0;
    const auto pressed = [&](double meant) {
        truth.truth.offset = meant;
        const SimulatedAnswers answers(protocol, 3);
        SimulatedKeys keys;
        keys.plan(answers, {offer}, {});
        keys.window_opened(SessionTime(2s));
        std::vector<std::string> names;
        for (const ObserverInput& input : until(keys, SessionTime(300s)))
            if (input.kind == ObserverInput::Kind::key_down)
                names.emplace_back(input.key.view());
        return names;
    };
    using Names = std::vector<std::string>;
    offer.step = 1.0;
    CHECK(pressed(0.0) == Names{"right", "right", "left"});
    CHECK(pressed(1.0) == Names{"right", "right"});
    offer.step = 5.0; // wider than the line
    CHECK(pressed(0.0) == Names{"right", "right", "left"});
    offer.high = 4.0;
    offer.step = 1.0;
    offer.numbers = {0.0, 1.0, 2.0, 3.0, 4.0};
    CHECK(pressed(4.0) == Names{"right", "right", "right"});
    offer.keys = {"0", "1", "2", "3"}; // not one each
    CHECK(pressed(4.0) == Names{"right", "right", "right"});
    offer.keys.emplace_back("4");
    CHECK(pressed(4.0) == Names{"4"});
    CHECK(pressed(1.4) == Names{"1"});
}

TEST_CASE("a column of a match goes by coarse steps where it has keys for them and a size", "[unit]") {
    Protocol protocol = asked();
    protocol.tasks[0].answers.resize(1);
    TaskAnswer& truth = protocol.tasks[0].answers[0];
    truth.id = "what";
    truth.truth.offset = 9.0;
    const SimulatedAnswers answers(protocol, 3);
    for (const auto& [coarse, has_keys, presses] : {std::tuple(4, true, 3u),
                                                    {4, false, 9u},
                                                    {0, true, 9u},
                                                    {0, false, 9u},
                                                    {9, true, 1u},
                                                    {10, true, 9u}}) {
        CAPTURE(coarse, has_keys);
        OfferedAxis axis;
        for (int k = 0; k < 20; ++k)
            axis.values.push_back(k);
        axis.less = "less";
        axis.more = "more";
        axis.coarse = coarse;
        if (has_keys) {
            axis.much_less = "down";
            axis.much_more = "up";
        }
        AnswerOffer offer = offer_called("match");
        offer.axes = {axis};
        SimulatedKeys keys;
        keys.plan(answers, {offer}, {});
        keys.window_opened(SessionTime(2s));
        CHECK(until(keys, SessionTime(300s)).size() == 2 * presses);
    }
}

TEST_CASE("all that a simulated observer does is told as its own", "[unit]") {
    const Protocol protocol = asked();
    const SimulatedAnswers answers(protocol, 3);
    std::vector<AnswerOffer> offers(4);
    offers[0] = number_keys();
    offers[1].kind = "point";
    offers[2].kind = "text";
    offers[3].kind = "gauge";
    offers[3].attitude = Attitude{Degrees{10.0}, Degrees{20.0}};
    offers[3].true_attitude = Attitude{Degrees{30.0}, Degrees{100.0}};
    offers[3].slant_per_px_deg = 0.25;
    for (AnswerOffer& offer : offers)
        offer.id = "any";
    for (const auto& [offer, most] : {std::pair{0, 4}, {1, 3}, {2, 4}, {3, 3}}) {
        CAPTURE(offer);
        SimulatedKeys keys;
        keys.plan(answers, {offers[static_cast<std::size_t>(offer)]}, {});
        keys.awaited(SessionTime(1s));
        keys.window_opened(SessionTime(2s));
        const std::vector<ObserverInput> inputs = until(keys, SessionTime(60s));
        CHECK(static_cast<int>(inputs.size()) == most);
        for (const ObserverInput& input : inputs)
            CHECK(input.device.view() == simulated_observer_device);
    }
}

TEST_CASE("what was planned and cleared does not come when a window opens", "[unit]") {
    const Protocol protocol = asked();
    const SimulatedAnswers answers(protocol, 3);
    SimulatedKeys keys;
    keys.plan(answers, {number_keys()}, {});
    keys.awaited(SessionTime(1s));
    keys.window_opened(SessionTime(2s));
    keys.clear();
    CHECK(until(keys, SessionTime(60s)).empty());
    // Its window is over, too: what is planned next waits for its own.
    keys.plan(answers, {number_keys()}, {});
    CHECK(until(keys, SessionTime(60s)).empty());
    keys.window_opened(SessionTime(100s));
    const std::vector<ObserverInput> inputs = until(keys, SessionTime(160s));
    REQUIRE(inputs.size() == 4);
    CHECK(inputs[0].at > SessionTime(100s));
}
