// What each call of the EyeLink's library does on the set-up screen, one at a time and to its bounds.
#include "devices/eyelink/eyelink_setup.h"

#include <cstring>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/devices/eyelink/eyelink_bench.h"
#include "tests/support/counted_clock.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

/// A set-up whose functions are called here and not by the library.
struct CalledSetup {
    StandIn stand_in;
    EyelinkLibrary library{stand_in.path};
    bool is_open = library->open_eyelink_connection(0) == 0; ///< the link stands
    CountedClock clock;
    DiarySetupScreen screen{clock};
    EyelinkSetup setup{library, &screen, Degrees{0.5}, clock, SessionTime(110s)};
};

struct KeyEvent {
    std::uint8_t type = 0, state = 0;
    std::uint16_t code = 0, modifiers = 0, character = 0;
    friend bool operator==(const KeyEvent&, const KeyEvent&) = default;
};

/// The event that the library is given; nothing without a key.
std::optional<KeyEvent> asked_key(EyelinkSetup& setup) {
    std::array<unsigned char, 14> bytes{};
    bytes.fill(0xEE);
    if (setup.input_key(bytes.data()) == 0) {
        CHECK(std::ranges::all_of(bytes, [](unsigned char byte) { return byte == 0xEE; }));
        return std::nullopt;
    }
    KeyEvent event{bytes[0], bytes[1]};
    std::memcpy(&event.code, bytes.data() + 2, 2);
    std::memcpy(&event.modifiers, bytes.data() + 4, 2);
    std::memcpy(&event.character, bytes.data() + 6, 2);
    CHECK((bytes[8] == 0 && bytes[9] == 0 && bytes[10] == 0 && bytes[11] == 0));
    CHECK((bytes[12] == 0xEE && bytes[13] == 0xEE)); // nothing beyond the event
    return event;
}

} // namespace

TEST_CASE("each sound of an EyeLink's set-up is that of the same name", "[unit]") {
    CalledSetup called;
    for (const auto& [which, beep] : {std::pair{-3, Beep::target_appears},
                                      {-2, Beep::drift_bad},
                                      {-1, Beep::calibration_bad},
                                      {0, Beep::calibration_good},
                                      {1, Beep::target_appears},
                                      {2, Beep::drift_good},
                                      {3, Beep::target_appears}}) {
        called.screen.diary.clear();
        CHECK(called.setup.beep(which) == 0);
        CHECK(called.screen.diary == std::vector{fmt::format("beep {}", static_cast<int>(beep))});
    }
    CHECK(called.setup.draw_target(3.5, 4.25) == 0);
    CHECK(called.screen.showed("target 3.5 4.25 of 0.5"));
    CHECK(called.setup.alert("no pupil") == 0);
    CHECK(called.screen.showed("text no pupil"));
    CHECK(called.setup.set_up() == 0);
    CHECK_THAT(called.screen.diary.back(), Catch::Contains("C: calibrate"));
    CHECK(called.setup.clear() == 0);
    CHECK(called.screen.cleared == 1);
}

TEST_CASE(
    "an EyeLink's camera image is taken line by line, in its palette's colours, and shown when it is whole",
    "[unit]") {
    CalledSetup called;
    const std::array<std::uint8_t, 3> red{1, 2, 3}, green{11, 12, 13}, blue{21, 22, 23};
    CHECK(called.setup.image_palette(red, green, blue) == 0);
    CHECK(called.setup.image_title("Right") == 0);
    const std::array<std::uint8_t, 4> line{0, 1, 2, 3}; // the last has no colour
    CHECK(called.setup.image_line(4, 1, 2, line.data()) == 0);
    CHECK(called.screen.diary.empty());
    CHECK(called.setup.image_line(4, 2, 2, line.data()) == 0);
    CHECK(called.screen.diary == std::vector<std::string>{"camera 4x2 Right"});
    std::vector<int> bytes;
    for (const std::byte one : called.screen.camera.rgba)
        bytes.push_back(std::to_integer<int>(one));
    const std::vector<int> row{1, 11, 21, 255, 2, 12, 22, 255, 3, 13, 23, 255, 0, 0, 0, 0};
    REQUIRE(bytes.size() == 32);
    CHECK(std::vector(bytes.begin(), bytes.begin() + 16) == row);
    CHECK(std::vector(bytes.begin() + 16, bytes.end()) == row);

    // Sizes and lines that no camera has are left out, and the largest is not.
    std::vector<std::uint8_t> wide(4097);
    const auto shows = [&](int width, int of_line, int lines, const std::uint8_t* indices) {
        called.screen.diary.clear();
        CHECK(called.setup.image_line(width, of_line, lines, indices) == 0);
        return !called.screen.diary.empty();
    };
    CHECK(shows(1, 1, 1, wide.data()));
    CHECK(called.screen.camera.rgba.size() == 4);
    CHECK(shows(4096, 1, 1, wide.data()));
    CHECK(shows(1, 4096, 4096, wide.data()));
    CHECK_FALSE(shows(4097, 1, 1, wide.data()));
    CHECK_FALSE(shows(1, 4097, 4097, wide.data()));
    CHECK_FALSE(shows(0, 1, 1, wide.data()));
    CHECK_FALSE(shows(1, 0, 0, wide.data()));
    CHECK_FALSE(shows(1, 0, 1, wide.data()));
    CHECK_FALSE(shows(1, 2, 1, wide.data()));
    CHECK_FALSE(shows(1, 1, 1, nullptr));
    // As many lines of another width are another image: nothing of the last one shows through.
    CHECK(shows(2, 1, 1, std::array<std::uint8_t, 2>{3, 1}.data()));
    CHECK(called.screen.camera.rgba[0] == std::byte{0});
    CHECK(called.screen.camera.rgba[4] == std::byte{2});
}

TEST_CASE("an EyeLink's camera image of one piece is shown as it is, within bounds", "[unit]") {
    CalledSetup called;
    std::vector<std::uint8_t> rgba(4 * 4097);
    for (std::size_t i = 0; i < rgba.size(); ++i)
        rgba[i] = static_cast<std::uint8_t>(i);
    const auto shows = [&](int width, int height, const std::uint8_t* bytes) {
        called.screen.diary.clear();
        CHECK(called.setup.image(width, height, bytes) == 0);
        return !called.screen.diary.empty();
    };
    CHECK(shows(3, 2, rgba.data()));
    CHECK((called.screen.camera.width_px == 3 && called.screen.camera.height_px == 2));
    REQUIRE(called.screen.camera.rgba.size() == 24);
    CHECK(called.screen.camera.rgba[23] == std::byte{23});
    CHECK(shows(1, 1, rgba.data()));
    CHECK(shows(4096, 1, rgba.data()));
    CHECK(shows(1, 4096, rgba.data()));
    CHECK_FALSE(shows(4097, 1, rgba.data()));
    CHECK_FALSE(shows(1, 4097, rgba.data()));
    CHECK_FALSE(shows(0, 1, rgba.data()));
    CHECK_FALSE(shows(1, 0, rgba.data()));
    CHECK_FALSE(shows(1, 1, nullptr));
}

TEST_CASE("a key comes to the EyeLink's library as an event of its form, with what is held beside it",
          "[unit]") {
    CalledSetup called;
    CHECK_FALSE(asked_key(called.setup));
    CHECK(called.clock.waits == std::vector<SessionDuration>{2ms}); // it asks again and again
    SetupKey key{SetupKey::Kind::character, U'a'};
    const auto given = [&] {
        called.screen.keys = {key};
        return asked_key(called.setup);
    };
    CHECK(given() == KeyEvent{1, 1, 'a', 0, 'a'});
    key.shift = true;
    CHECK(given() == KeyEvent{1, 1, 'a', 0x1, 'a'});
    key.control = true;
    CHECK(given() == KeyEvent{1, 1, 'a', 0x41, 'a'});
    key.shift = false;
    key.alt = true;
    CHECK(given() == KeyEvent{1, 1, 'a', 0x140, 'a'});
    key = {SetupKey::Kind::up};
    CHECK(given() == KeyEvent{1, 1, 0x4800, 0, 0});
    key = {SetupKey::Kind::character, U'\x7F'};
    CHECK(given() == KeyEvent{1, 1, 0x7F, 0, 0x7F});
    key = {SetupKey::Kind::character, U'\x80'}; // it knows none
    CHECK_FALSE(given());
    CHECK(called.setup.input_key(nullptr) == 0);
    for (const auto& [kind, code] : {std::pair{SetupKey::Kind::space, 0x20},
                                     {SetupKey::Kind::backspace, 0x08},
                                     {SetupKey::Kind::tab, 0x09}})
        CHECK(eyelink_key({kind}) == code);
    CHECK(eyelink_key({SetupKey::Kind::function, 0}) == 0);
    CHECK_NOTHROW(called.setup.check());
    CHECK_FALSE(called.setup.is_out_of_time());
}

TEST_CASE("an EyeLink's dialogue ends when its time is over, its link breaks or the session ends", "[unit]") {
    const KeyEvent terminate{1, 1, 0x7FFF, 0, 0};
    CalledSetup called;
    SECTION("its time is over") {
        called.clock.time = SessionTime(110s) - 1ns - 2ms; // it waits 2 ms for a key
        CHECK_FALSE(asked_key(called.setup));
        CHECK(asked_key(called.setup) == terminate);
        CHECK(called.setup.is_out_of_time());
        CHECK_NOTHROW(called.setup.check());
    }
    SECTION("exactly then") {
        called.clock.time = SessionTime(110s) - 2ms;
        CHECK(asked_key(called.setup) == terminate);
    }
    SECTION("the link breaks") {
        called.stand_in.set("broken", 1);
        CHECK(asked_key(called.setup) == terminate);
        called.stand_in.set("broken", 0);
        CHECK(asked_key(called.setup) == terminate); // it stays lost
        CHECK_FALSE(called.setup.is_out_of_time());
        CHECK_THROWS_WITH(called.setup.check(), Catch::Contains("was lost during its set-up"));
    }
    SECTION("the session ends") {
        called.screen.cancelled = true;
        called.screen.keys = {{SetupKey::Kind::character, U'c'}};
        CHECK(asked_key(called.setup)->code == 0x7FFF);
        CHECK_NOTHROW(called.setup.check());
    }
    SECTION("the screen fails") {
        called.screen.on_target = [] { throw DeviceError("no display"); };
        CHECK(called.setup.draw_target(1, 2) == -1);
        called.screen.diary.clear();
        CHECK(called.setup.beep(1) == -1); // and nothing is drawn after that
        CHECK(called.screen.diary.empty());
        CHECK(asked_key(called.setup) == terminate);
        CHECK_THROWS_WITH(called.setup.check(), "no display");
    }
}

TEST_CASE("a check of drift without a set-up screen draws nothing, gives no key and ends with Esc",
          "[unit]") {
    StandIn stand_in;
    const EyelinkLibrary library(stand_in.path);
    REQUIRE(library->open_eyelink_connection(0) == 0);
    CountedClock clock;
    EyelinkSetup setup(library, nullptr, Degrees{0.5}, clock, SessionTime(101s));
    CHECK(setup.draw_target(1, 2) == 0);
    CHECK(setup.beep(0) == 0);
    CHECK_FALSE(asked_key(setup));
    clock.time = SessionTime(101s);
    CHECK(asked_key(setup) == KeyEvent{1, 1, 0x1B, 0, 0x1B});
    CHECK(setup.is_out_of_time());
}

TEST_CASE("each hook of both forms does its part in an EyeLink's set-up, and nothing without one", "[unit]") {
    for (const auto& [is_old, refuses] : {std::pair(false, false), {true, false}, {true, true}}) {
        CAPTURE(is_old, refuses);
        // One that has the second form and does not take it is given the first, as an older one is.
        StandIn stand_in(is_old && !refuses ? OVERT_STAND_IN_EYELINK_OLD : OVERT_STAND_IN_EYELINK);
        stand_in.set("refuses_second_form", refuses ? 1 : 0);
        const EyelinkLibrary library(stand_in.path);
        REQUIRE(library->open_eyelink_connection(0) == 0);
        CountedClock clock;
        DiarySetupScreen screen{clock};
        {
            EyelinkSetup setup(library, &screen, Degrees{0.5}, clock, SessionTime(110s));
            CHECK(stand_in.ask("stand_in_hooks") == 0);
            CHECK_NOTHROW(setup.check());
        }
        REQUIRE_FALSE(screen.diary.empty());
        CHECK_THAT(screen.diary.front(), Catch::StartsWith("text Set-up of the EyeLink."));
        screen.diary.erase(screen.diary.begin());
        std::vector<std::string> known;
        if (is_old)
            known = {"camera 1x1 Left", "camera 1x1 Left, threshold 0", "camera 1x1 Left, threshold 80",
                     "camera 1x1 Left, threshold 80", "target 3 4 of 0.5"};
        else
            known = {"camera 1x1 Left", "target 3 4.5 of 0.5"};
        for (const Beep beep :
             is_old ? std::vector{Beep::target_appears, Beep::calibration_good, Beep::calibration_bad,
                                  Beep::drift_good, Beep::drift_bad, Beep::target_appears}
                    : std::vector{Beep::drift_bad, Beep::calibration_bad, Beep::calibration_good,
                                  Beep::target_appears, Beep::drift_good, Beep::target_appears})
            known.push_back(fmt::format("beep {}", static_cast<int>(beep)));
        known.insert(known.end(), {"text alert", "text "});
        CHECK(screen.diary == known);
        CHECK(screen.camera.rgba.front() == std::byte{is_old ? std::uint8_t{20} : std::uint8_t{1}});
        CHECK(screen.cleared == 4);
        screen.diary.clear();
        CHECK(stand_in.ask("stand_in_hooks") == 0);
        CHECK(screen.diary.empty());
        CHECK(screen.cleared == 4);
    }
}
