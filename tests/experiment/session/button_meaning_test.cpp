#include "experiment/ports/button_meaning.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"

using namespace overt;
using Key = ResponsePress::Key;

TEST_CASE("a button's meaning is its name and a word, and answers keep their words", "[unit]") {
    const ButtonMeaning next = parse_button_meaning("1 next", false);
    CHECK(next.button == "1");
    CHECK(next.key == Key::next);
    CHECK(next.answer.empty());

    // Names of keys have blanks in them.
    const ButtonMeaning answer = parse_button_meaning("  key 57   answer imitation  gold ", false);
    CHECK(answer.button == "key 57");
    CHECK(answer.key == Key::next);
    CHECK(answer.answer == "imitation  gold");
    CHECK(answer.words == "answer imitation  gold");

    const ButtonMeaning pause = parse_button_meaning("F pause", true);
    CHECK(pause.button == "F");
    CHECK(pause.key == Key::pause);
    const ButtonMeaning reason = parse_button_meaning("key 5 3", true);
    CHECK(reason.button == "key 5");
    CHECK(reason.key == Key::character);
    CHECK(reason.character == U'3');
    CHECK(parse_button_meaning("2 no", true).key == Key::no);
    CHECK(parse_button_meaning("2 no", false).key == Key::no);
}

TEST_CASE("what a button cannot mean is refused, and what it could is said", "[unit]") {
    for (const char* text : {"", "1", "1 ", "next", "1 abort", "1 answer", "1 answer ", "1 left", "1 3"}) {
        CAPTURE(text);
        CHECK_THROWS_WITH(parse_button_meaning(text, false),
                          Catch::Contains("says no meaning of a button") && Catch::Contains("1 answer gold"));
    }
    for (const char* text : {"", "1", "1 next", "1 answer gold", "1 0", "1 10", "key 5"}) {
        CAPTURE(text);
        CHECK_THROWS_WITH(parse_button_meaning(text, true), Catch::Contains("recalibrate, repeat"));
    }
}
