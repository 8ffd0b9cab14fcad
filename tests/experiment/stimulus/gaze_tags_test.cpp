/// Where AprilTags stand around the stimulus, and what a protocol must not ask of them.
#include "experiment/stimulus/gaze_tags.h"

#include <catch2/catch.hpp>

#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

using Lines = std::vector<std::string>;

namespace {

std::vector<int> ids_of(const std::vector<TagPlace>& tags) {
    std::vector<int> ids;
    for (const TagPlace& tag : tags)
        ids.push_back(tag.id);
    return ids;
}

} // namespace

TEST_CASE("tags stand in the corners, and at the edges where there is room", "[unit]") {
    ScreenGeometry geometry; // 1920 x 1080, the stimulus in columns 448 to 1471 and rows 28 to 1051
    DisplaySettings display;
    display.output = OutputMode::native_8bit;
    CHECK(gaze_tags_of(geometry, display).empty());
    display.tags_px = 200;
    const std::vector<TagPlace> tags = gaze_tags_of(geometry, display);
    CHECK(ids_of(tags) == std::vector<int>{0, 1, 2, 3, 4, 5});
    CHECK(tags[0].origin_px == glm::ivec2(0, 0));
    CHECK(tags[1].end_px() == glm::ivec2(1920, 200));
    CHECK(tags[2].origin_px == glm::ivec2(0, 440));
    CHECK(tags.back().end_px() == glm::ivec2(1920, 1080));
    const TaggedArea area = tagged_area(tags);
    CHECK(area.origin_px == glm::dvec2(20.0, 20.0));
    CHECK(area.size_px == glm::dvec2(1880.0, 1040.0));

    // A wide stimulus leaves no room at the edges.
    geometry.image_px = {1600, 400};
    geometry.image_origin_px = {160, 340};
    CHECK(ids_of(gaze_tags_of(geometry, display)) == std::vector<int>{0, 1, 4, 5});
    geometry.image_px = {400, 400};
    geometry.image_origin_px = {760, 340};
    // Below the rows of messages, and in whole pairs.
    display.output = OutputMode::color_plus_plus;
    for (const TagPlace& tag : gaze_tags_of(geometry, display)) {
        CHECK(tag.origin_px.y >= 3);
        CHECK(tag.origin_px.x % 2 == 0);
    }
    // The square for a photodiode comes before a tag at an edge.
    display.photodiode = PatchCorner::top_left;
    display.photodiode_px = 700;
    CHECK(ids_of(gaze_tags_of(geometry, display)) == std::vector<int>{0, 1, 3, 4, 5});
}

TEST_CASE("tags have a white border, a black one in it, and codes that differ", "[unit]") {
    for (int id = 0; id < most_tags; ++id) {
        for (int i = 0; i < tag_modules; ++i) {
            CHECK((is_white_module(id, i, 0) && is_white_module(id, 0, i) && is_white_module(id, i, 9) &&
                   is_white_module(id, 9, i)));
            if (i > 0 && i < 9)
                CHECK_FALSE((is_white_module(id, i, 1) || is_white_module(id, 1, i) ||
                             is_white_module(id, i, 8) || is_white_module(id, 8, i)));
        }
        // The family's least distance is 11 bits, under any quarter turn.
        for (int other = 0; other < id; ++other) {
            std::array<int, 4> differing{};
            for (int y = 2; y < 8; ++y) {
                for (int x = 2; x < 8; ++x) {
                    const bool mine = is_white_module(id, x, y);
                    differing[0] += mine != is_white_module(other, x, y);
                    differing[1] += mine != is_white_module(other, y, 9 - x);
                    differing[2] += mine != is_white_module(other, 9 - x, 9 - y);
                    differing[3] += mine != is_white_module(other, 9 - y, x);
                }
            }
            CHECK(*std::ranges::min_element(differing) >= 11);
        }
    }
}

TEST_CASE("tags that meet the stimulus, the photodiode's square or each other are errors", "[unit]") {
    const auto only_line = [](const std::string& keys) {
        const Lines lines = ReadText(minimal_protocol, "[display]\n" + keys).lines();
        CAPTURE(lines);
        REQUIRE(lines.size() == 1);
        return lines.front();
    };
    CHECK(ReadText(minimal_protocol, "[display]\ntags_px = 200\ntags_light = 1\n").lines().empty());
    CHECK_THAT(only_line("tags_px = 205\n"), Contains("ten") || Contains("10 modules"));
    CHECK_THAT(only_line("output = \"color++\"\ntags_px = 210\n"), Contains("whole pairs"));
    CHECK_THAT(only_line("tags_px = 440\n"), Contains("closer than 12 px to the stimulus"));
    CHECK_THAT(only_line("tags_px = 200\nphotodiode = \"top-left\"\n"),
               Contains("closer than 12 px to the square for a photodiode"));
    CHECK_THAT(only_line("tags_light = 0.4\n"), Contains("no tags are shown"));
}
