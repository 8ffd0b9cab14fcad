#include <catch2/catch.hpp>

#include "experiment/base/plain_text.h"

using namespace overt;

TEST_CASE("a text's marks of emphasis are gone where it is no screen, and nothing else is", "[unit]") {
    CHECK(
        plain_text_of("Look at the <b>face</b>, <big><i>not</i></big> at <u>me</u> <small>please</small>.") ==
        "Look at the face, not at me please.");
    CHECK(plain_text_of("a < b > c & d, <br>, 1 <bold>") == "a < b > c & d, <br>, 1 <bold>");
    // A letter that is written by its name is no beginning of a mark.
    CHECK(plain_text_of("&lt;b&gt; R&amp;D &amp;lt;") == "<b> R&D &lt;");
    CHECK(plain_text_of("# Welcome\n\nSit # down.") == "Welcome\n\nSit # down.");
    CHECK(plain_text_of("<b") == "<b");
    CHECK(plain_text_of("").empty());
    CHECK(plain_line_of("# <b>Welcome</b>\n\n  Sit\tdown. \n") == "Welcome Sit down.");
}
