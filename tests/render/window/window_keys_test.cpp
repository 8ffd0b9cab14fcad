/// Keys of a real window, sent to it as a keyboard's, and what they mean to a session.
#include "render/window/window_response_panel.h"

#include <cmath>
#include <optional>
#include <vector>

#include <catch2/catch.hpp>

#include "devices/host/clocks.h"
#include "experiment/ports/session_log.h"
#include "tests/support/virtual_screen.h"

// Last: it defines words.
#include "tests/support/keyboard.h"

using namespace overt;

namespace {

using Key = ResponsePress::Key;

std::vector<Key> keys_of(ResponsePanel& panel) {
    std::vector<Key> keys;
    while (const auto press = panel.poll())
        keys.push_back(press->key);
    return keys;
}

struct WindowWithKeyboard {
    WindowContext window{WindowRequest{{320, 200}, "test"}};
    SteadyClock clock;
    OperatorSettings operators;
    ConsentSettings consent;
    test::Keyboard keyboard{static_cast<Display*>(window.native().x11_display), window.native().x11_window};
    WindowResponsePanel panel() { return {window, clock, operators, consent}; }
};

} // namespace

TEST_CASE("keys of a window mean what is waited for", "[gl]") {
    const auto screen = test::VirtualScreen::start(640, 480, 24);
    WindowWithKeyboard typed_at;
    typed_at.operators.repeat = "r";
    typed_at.consent.accept_key = "j";
    WindowResponsePanel panel = typed_at.panel();
    test::Keyboard& keyboard = typed_at.keyboard;

    panel.await_key({});
    for (const KeySym symbol : {XK_space, XK_Return, XK_Left, XK_BackSpace, XK_F5, XK_r, XK_q, XK_Escape})
        keyboard.type(symbol);
    CHECK(keys_of(panel) == std::vector{Key::next, Key::next, Key::left, Key::back, Key::skip, Key::repeat,
                                        Key::next, Key::abort});

    panel.await_entry({});
    keyboard.type(XK_r);
    keyboard.type(XK_R, ShiftMask);
    keyboard.type(XK_space);
    std::u32string typed;
    while (const auto press = panel.poll())
        if (press->key == Key::character)
            typed += press->character;
    CHECK(typed == U"rR ");
    for (const KeySym symbol : {XK_BackSpace, XK_Tab, XK_Up, XK_Right, XK_Return, XK_F1})
        keyboard.type(symbol);
    CHECK(keys_of(panel) == std::vector{Key::erase, Key::down, Key::up, Key::right, Key::next, Key::pause});

    panel.await_decision(true, {});
    for (const KeySym symbol : {XK_y, XK_j, XK_space, XK_n})
        keyboard.type(symbol);
    CHECK(keys_of(panel) == std::vector{Key::yes, Key::no});
    panel.await_decision(false, {});
    for (const KeySym symbol : {XK_r, XK_2, XK_y, XK_n})
        keyboard.type(symbol);
    CHECK(keys_of(panel) == std::vector{Key::character, Key::character, Key::yes, Key::no});
}

TEST_CASE("the operator's keys are kept while something is prepared, the observer's are forgotten", "[gl]") {
    const auto screen = test::VirtualScreen::start(640, 480, 24);
    WindowWithKeyboard typed_at;
    WindowResponsePanel panel = typed_at.panel();
    panel.await_key({});
    typed_at.keyboard.type(XK_space);
    typed_at.keyboard.type(XK_F2);
    typed_at.keyboard.type(XK_Escape);
    panel.await_key({});
    CHECK(keys_of(panel) == std::vector{Key::recalibrate, Key::abort});
    // Each is given once.
    panel.await_key({});
    CHECK(keys_of(panel).empty());
}

namespace {

class PressLog final : public SessionLog {
  public:
    void flip(const FlipRecord&) noexcept override {}
    void missed(const MissedRefresh&) noexcept override {}
    void sample(int, const GazeSample&) noexcept override {}
    void clock_pair(const ClockPair&) noexcept override {}
    void event(const SessionEvent&) override {}
    void key_presses(const std::vector<RecordedKeyPress>& more) override {
        all.insert(all.end(), more.begin(), more.end());
    }
    void trial_started(const Trial&, SessionTime) override {}
    void trial_finished(const Trial&, const TrialOutcome&) override {}
    std::vector<RecordedKeyPress> all;
};

/// Looks at the keys until there is nothing left.
std::vector<RecordedKeyPress> recorded(WindowResponsePanel& panel) {
    keys_of(panel);
    PressLog log;
    panel.write_down(log);
    return log.all;
}

using Names = std::vector<std::string>;
Names names_of_presses(const std::vector<RecordedKeyPress>& presses) {
    Names names;
    for (const RecordedKeyPress& press : presses)
        names.push_back(press.name);
    return names;
}

} // namespace

TEST_CASE("every key that is pressed while an answer is awaited is recorded, by its name", "[gl]") {
    const auto screen = test::VirtualScreen::start(640, 480, 24);
    WindowWithKeyboard typed_at;
    WindowResponsePanel panel = typed_at.panel();
    test::Keyboard& keyboard = typed_at.keyboard;
    const Trial trial{4, 0, {}};
    panel.entered(SessionPhase::response_screen, 4);
    panel.await_response(trial, {});
    for (const KeySym symbol : {XK_7, XK_3, XK_space, XK_Return, XK_KP_Enter, XK_F9, XK_Shift_L, XK_Home})
        keyboard.type(symbol);
    keyboard.type(XK_a, ShiftMask);
    const std::vector<RecordedKeyPress> presses = recorded(panel);
    CHECK(names_of_presses(presses) ==
          Names{"7", "3", "space", "enter", "keypad enter", "f9", "left shift", "home", "a"});
    REQUIRE(presses.size() == 9);
    for (const RecordedKeyPress& press : presses) {
        CHECK(press.device == "keyboard");
        CHECK(press.screen == SessionPhase::response_screen);
        CHECK(press.trial == 4);
        CHECK(press.code);
        CHECK(press.uncertainty >= SessionDuration::zero());
    }
    CHECK(presses[0].text == "7");
    CHECK(presses[0].meaning == "next");
    CHECK(presses[5].meaning.empty());
    CHECK(presses[6].modifiers.empty());
    CHECK(presses[8].modifiers == "shift");
    CHECK(presses[8].text == "A");
    CHECK(recorded(panel).empty());
}

TEST_CASE("a key that is held is one press, and answers only once", "[gl]") {
    const auto screen = test::VirtualScreen::start(640, 480, 24);
    WindowWithKeyboard typed_at;
    WindowResponsePanel panel = typed_at.panel();
    panel.entered(SessionPhase::response_screen, 0);
    panel.await_response(Trial{}, {});
    typed_at.keyboard.hold(XK_7, 5);
    CHECK(keys_of(panel) == std::vector{Key::next});
    CHECK(names_of_presses(recorded(panel)) == Names{"7"});
    // One that GLFW knows by no number of its own.
    typed_at.keyboard.hold_code(93 + 8, 4);
    const std::vector<RecordedKeyPress> unknown = recorded(panel);
    REQUIRE(unknown.size() == 1);
    CHECK(unknown[0].code == 93 + 8);
    CHECK_FALSE(unknown[0].name.empty());
}

TEST_CASE(
    "keys of forms, decisions and set-ups are not recorded, and those before a screen are of the one before",
    "[gl]") {
    const auto screen = test::VirtualScreen::start(640, 480, 24);
    WindowWithKeyboard typed_at;
    WindowResponsePanel panel = typed_at.panel();
    test::Keyboard& keyboard = typed_at.keyboard;
    panel.entered(SessionPhase::set_up, -1);
    panel.await_entry({});
    keyboard.type(XK_s);
    CHECK(recorded(panel).empty());
    panel.entered(SessionPhase::task_screen, 1);
    panel.await_key({});
    panel.await_decision(false, {});
    keyboard.type(XK_y);
    CHECK(recorded(panel).empty());
    panel.await_key({});
    keyboard.type(XK_1);
    CHECK(recorded(panel).at(0).screen == SessionPhase::task_screen);
    // While the stimulus is shown, and before the response screen is lit.
    panel.entered(SessionPhase::stimulus, 1);
    keyboard.type(XK_2);
    const RecordedKeyPress early = recorded(panel).at(0);
    CHECK(early.screen == SessionPhase::stimulus);
    CHECK(early.meaning.empty());
    panel.entered(SessionPhase::response_screen, 1);
    keyboard.type(XK_3);
    panel.await_response(Trial{}, {});
    keyboard.type(XK_4);
    const std::vector<RecordedKeyPress> presses = recorded(panel);
    CHECK(names_of_presses(presses) == Names{"3", "4"});
    REQUIRE(presses.size() == 2);
    CHECK(presses[0].screen == SessionPhase::stimulus);
    CHECK(presses[1].screen == SessionPhase::response_screen);
}

TEST_CASE("every key that a protocol may name is one of the window's", "[unit]") {
    CHECK(key_called("escape").key == WindowKey::escape);
    CHECK(key_called("f1").key == WindowKey::f1);
    CHECK(key_called("f12").key == WindowKey::f12);
    CHECK(key_called("pause").key == WindowKey::pause);
    CHECK(key_called("z").is({WindowKey::character, U'Z'}));
    CHECK_FALSE(key_called("z").is({WindowKey::character, U'y'}));
    WindowKeyPress held{WindowKey::f1};
    held.is_repeated = true;
    CHECK_FALSE(key_called("f1").is(held));
}

TEST_CASE("while an answer is awaited, keys, characters and the mouse of a window are told as they are",
          "[gl]") {
    using Kind = ObserverInput::Kind;
    const auto screen = test::VirtualScreen::start(640, 480, 24);
    WindowWithKeyboard typed_at;
    WindowResponsePanel panel = typed_at.panel();
    test::Keyboard& keyboard = typed_at.keyboard;
    const auto told = [&] {
        std::vector<ObserverInput> inputs;
        CHECK_FALSE(panel.poll());
        while (const auto input = panel.next_input())
            inputs.push_back(*input);
        return inputs;
    };
    panel.await_key({});
    keyboard.type(XK_x); // too early
    panel.await_answer({}, nullptr);
    CHECK(told().empty());
    // A key that is held went down once, and writes again and again.
    keyboard.hold(XK_j, 3);
    const std::vector<ObserverInput> held = told();
    REQUIRE(held.size() == 5);
    CHECK(held[0].kind == Kind::key_down);
    CHECK(held[0].key.view() == "j");
    CHECK(held[0].device.view() == "keyboard");
    CHECK(held[0].uncertainty > SessionDuration::zero());
    CHECK(held[0].at <= typed_at.clock.now());
    for (const std::size_t i : {1u, 2u, 3u})
        CHECK(held[i].character == U'j');
    CHECK(held[4].kind == Kind::key_up);
    CHECK(held[4].key.view() == "j");
    keyboard.type(XK_Left);
    const std::vector<ObserverInput> arrow = told();
    REQUIRE(arrow.size() == 2);
    CHECK(arrow[0].key.view() == "left");
    // From the middle of the window's 320 x 200 pixels to the middle of the pixel.
    keyboard.click(200, 60);
    const std::vector<ObserverInput> clicked = told();
    REQUIRE(clicked.size() == 3);
    CHECK(clicked[0].kind == Kind::pointer_moved);
    CHECK(clicked[1].kind == Kind::pointer_down);
    CHECK(clicked[1].device.view() == "mouse");
    CHECK(clicked[1].right_px == 40.5);
    CHECK(clicked[1].down_px == -39.5);
    CHECK(clicked[1].button == 1);
    CHECK(clicked[2].kind == Kind::pointer_up);
    // The operator's keys stay the operator's.
    keyboard.type(XK_F5);
    const auto press = panel.poll();
    REQUIRE(press);
    CHECK(press->key == Key::skip);
    CHECK_FALSE(panel.next_input());
    // Where a box answers, the keyboard still writes.
    typed_at.operators.keyboard_answers = false;
    WindowResponsePanel beside_box = typed_at.panel();
    beside_box.await_answer({}, nullptr);
    keyboard.type(XK_j);
    keyboard.type(XK_BackSpace);
    CHECK_FALSE(beside_box.poll());
    std::vector<Kind> kinds;
    while (const auto input = beside_box.next_input())
        kinds.push_back(input->kind);
    CHECK(kinds == std::vector{Kind::text, Kind::key_down, Kind::key_up});
}

TEST_CASE("a key that is held since before an answer is awaited writes nothing into it", "[gl]") {
    using Kind = ObserverInput::Kind;
    const auto screen = test::VirtualScreen::start(640, 480, 24);
    WindowWithKeyboard typed_at;
    WindowResponsePanel panel = typed_at.panel();
    test::Keyboard& keyboard = typed_at.keyboard;
    const auto written = [&] {
        std::u32string text;
        panel.poll();
        while (const auto input = panel.next_input())
            if (input->kind == Kind::text)
                text += input->character;
        return text;
    };
    panel.await_answer({}, nullptr);
    keyboard.press(XK_f);
    keyboard.press(XK_f);
    CHECK(written() == U"ff");
    // The next answer's screen, and the key is still held.
    panel.await_answer({}, nullptr);
    keyboard.press(XK_f);
    CHECK(written().empty());
    keyboard.press(XK_g);
    keyboard.press(XK_g);
    CHECK(written() == U"gg");
}

TEST_CASE("a pointer's place is in pixels of the framebuffer, whatever the desktop's units are", "[unit]") {
    // 800 x 600 units, each of a pixel, of two, and of one and a half.
    for (const double scale : {1.0, 2.0, 1.5}) {
        CAPTURE(scale);
        const glm::ivec2 window(800, 600), framebuffer(glm::dvec2(window) * scale);
        const auto place = [&](double x, double y) {
            return pointer_from_middle_px({x, y}, window, framebuffer);
        };
        CHECK(place(0, 0) == glm::dvec2(-400.0 * scale + 0.5, -300.0 * scale + 0.5));
        CHECK(place(400, 300) == glm::dvec2(0.5));
        CHECK(place(500, 150) - place(400, 300) == glm::dvec2(100.0, -150.0) * scale);
        // A window that is not there yet has no size.
        CHECK(std::isfinite(pointer_from_middle_px({1, 1}, {}, framebuffer).x));
    }
}

TEST_CASE("of movements of the mouse the last is kept, and what nobody asks for gives way", "[unit]") {
    using Kind = ObserverInput::Kind;
    WindowInputs inputs;
    for (int i = 0; i < 5; ++i)
        inputs.push({.kind = Kind::pointer_moved, .from_middle_px = {i, 0.0}});
    inputs.push({.kind = Kind::pointer_down});
    inputs.push({.kind = Kind::pointer_moved, .from_middle_px = {9.0, 0.0}});
    WindowInput input;
    REQUIRE(inputs.next(input));
    CHECK(input.from_middle_px.x == 4.0);
    REQUIRE(inputs.next(input));
    CHECK(input.kind == Kind::pointer_down);
    REQUIRE(inputs.next(input));
    CHECK(input.from_middle_px.x == 9.0);
    CHECK_FALSE(inputs.next(input));
    for (int code = 0; code < 300; ++code)
        inputs.push({.kind = Kind::key_down, .code = code});
    REQUIRE(inputs.next(input));
    CHECK(input.code == 44); // of 300 the last 256
}
