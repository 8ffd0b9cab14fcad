/// Keys of a real window, sent to it as a keyboard's, and what they mean to a session.
#include "render/window/window_response_panel.h"

#include <optional>
#include <vector>

#include <catch2/catch.hpp>

#include "devices/host/clocks.h"
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
