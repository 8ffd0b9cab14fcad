/// The keys of [bake], and what the numbers of ready-made frames mean.
#include <catch2/catch.hpp>

#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

using Lines = std::vector<std::string>;

namespace {

constexpr std::string_view one_sequence = R"([[frames]]
object = "a"
material = "gold"
files = "f/####.png"
)";

} // namespace

TEST_CASE("what is said of rendering is taken, and left out it is by who looks", "[unit]") {
    const ReadText nothing(minimal_protocol);
    REQUIRE(nothing.protocol);
    CHECK_FALSE(nothing.protocol->bake.quality);
    CHECK(nothing.protocol->bake.least() == BakeQuality::standard);
    CHECK(nothing.protocol->bake.least(false) == BakeQuality::preview);
    CHECK(nothing.protocol->bake.observer == StandardObserver::cie1931);
    CHECK_FALSE(nothing.protocol->bake.samples);
    const ReadText read(minimal_protocol, "[bake]\nquality = \"standard\"\nsamples = 96\n"
                                          "target_error_de = 0.5\nfilter = \"blackman-harris\"\n"
                                          "filter_width_px = 3\nseed = 7\n");
    REQUIRE(read.protocol);
    CHECK(read.lines().empty());
    const BakingSettings& bake = read.protocol->bake;
    CHECK(bake.quality == BakeQuality::standard);
    CHECK(bake.least(false) == BakeQuality::standard);
    CHECK(bake.samples == 96);
    CHECK(bake.target_error_de == 0.5);
    CHECK(bake.filter == PixelFilter::blackman_harris);
    CHECK(bake.filter_width_px == 3.0);
    CHECK(bake.seed == 7u);
}

TEST_CASE("qualities, filters and numbers that cannot be are found where they stand", "[unit]") {
    const ReadText read(minimal_protocol, "[bake]\nquality = \"best\"\nsamples = 0\nfilter = \"sinc\"\n"
                                          "filter_width_px = 3.1\ntarget_error_de = -1\nobserver = \"me\"\n"
                                          "sample = 3\n");
    CHECK_FALSE(read.protocol);
    const Lines lines = read.lines();
    REQUIRE(lines.size() == 7);
    for (std::size_t i = 0; i < lines.size(); ++i)
        CHECK(lines[i].starts_with(fmt::format("{}:", 13 + i)));
}

TEST_CASE("another observer needs the spectra of the display", "[unit]") {
    const ReadText read(minimal_protocol, "[bake]\nobserver = \"cie2006\"\n");
    CHECK(read.lines() ==
          Lines{"13:12: how CIE 2006 sees the display's light is not known without its spectra"});
}

TEST_CASE("keys that OpenGL does not heed are warned of", "[unit]") {
    const ReadText read(minimal_protocol, "[bake]\nquality = \"live\"\nsamples = 4\nseed = 1\n");
    REQUIRE(read.protocol);
    CHECK(read.lines() == Lines{"14:11: \"samples\" has no effect on frames that OpenGL draws",
                                "15:8: \"seed\" has no effect on frames that OpenGL draws"});
}

TEST_CASE("a sequence says in which colours it is, and what of it is background", "[unit]") {
    const ReadText read(minimal_protocol, std::string(one_sequence) +
                                              "encoding = \"srgb\"\ncolour_space = \"rec709\"\n"
                                              "background_colour = [0, 0.5, 1]\n"
                                              "background_tolerance = 0.01\n");
    REQUIRE(read.protocol);
    CHECK(read.lines().empty());
    const FrameSequenceSettings& sequence = read.protocol->frames.at(0);
    CHECK(sequence.colour_space == FrameColours::rec709);
    CHECK(sequence.background_colour == glm::dvec3(0.0, 0.5, 1.0));
    CHECK(sequence.background_tolerance == 0.01);
}

TEST_CASE("XYZ in sRGB's encoding are refused, and a tolerance of no colour is warned of", "[unit]") {
    const ReadText read(minimal_protocol, std::string(one_sequence) +
                                              "encoding = \"srgb\"\ncolour_space = \"xyz\"\n"
                                              "background_tolerance = 0.01\n");
    CHECK_FALSE(read.protocol);
    CHECK(read.lines() == Lines{"16:12: XYZ are not encoded as sRGB",
                                "18:24: \"background_tolerance\" has no effect without "
                                "\"background_colour\""});
}
