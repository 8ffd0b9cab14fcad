/// Lights, suns and lamps that cannot be, at their places.
#include <catch2/catch.hpp>

#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

using LightLines = std::vector<std::string>;

/// What stands from line 12 on.
LightLines findings_of_lights(const std::string& text) { return ReadText(minimal_protocol, text).lines(); }

const std::string a_lamp =
    "[[lamp]]\nid = \"bulb\"\nshape = \"sphere\"\nluminance_cd_m2 = 10\nposition = [0, -9, 3]\nradius = 1\n";

} // namespace

TEST_CASE("sun and lamps need to know how bright the probe is", "[unit]") {
    CHECK(findings_of_lights("[light]\nprobe = \"dark\"\nsun_lux = 1000\n").empty());
    CHECK(findings_of_lights("[light]\nsun_lux = 1000\nunit_cd_m2 = 5000\n").empty());
    CHECK(findings_of_lights("[light]\nsun_lux = 1000\n") ==
          LightLines{
              "13:11: nothing says how bright the probe of light \"light\" is beside its sun and lamps"});
    CHECK(findings_of_lights("[light]\nprobe = \"dark\"\n") ==
          LightLines{"13:9: there is no light in \"light\": its probe is dark"});
    CHECK(findings_of_lights("[light]\nsun_elevation_deg = 10\n") ==
          LightLines{"13:21: \"sun_elevation_deg\" has no effect without \"sun_lux\""});
    CHECK(findings_of_lights("[light]\nprobe = \"dark\"\nsun_lux = 10\nsun_colour = [0, 0, 0]\n") ==
          LightLines{"15:14: a sun of no colour gives no light"});
}

TEST_CASE("lamps have what their shape needs, and lights that name them", "[unit]") {
    const std::string lit = "[light]\nprobe = \"dark\"\nlamps = [\"bulb\"]\n";
    CHECK(findings_of_lights(lit + a_lamp).empty());
    const ReadText read(minimal_protocol, lit + a_lamp);
    REQUIRE(read.protocol);
    REQUIRE(read.protocol->lights[0].shining.size() == 1);
    CHECK(read.protocol->lights[0].shining[0].radius == 1.0);
    CHECK(findings_of_lights("[light]\nprobe = \"dark\"\nlamps = [\"bulp\"]\n" + a_lamp).front() ==
          "14:9: there is no [[lamp]] \"bulp\"");
    CHECK(findings_of_lights("[light]\nprobe = \"dark\"\nlamps = [\"bulb\", \"bulb\"]\n" + a_lamp) ==
          LightLines{"14:9: the lamp \"bulb\" stands there twice"});
    CHECK(findings_of_lights(a_lamp) == LightLines{"12:1: no light has the lamp \"bulb\""});
    CHECK(findings_of_lights(lit + "[[lamp]]\nid = \"bulb\"\nluminance_cd_m2 = 10\nposition = [0, 0, 3]\n") ==
          LightLines{"15:1: the disc \"bulb\" has no radius"});
    CHECK(findings_of_lights(
              lit + "[[lamp]]\nid = \"bulb\"\nshape = \"rectangle\"\nluminance_cd_m2 = 10\nposition = [0, "
                    "0, 3]\nwidth = 2\nradius = 3\n") ==
          LightLines{"15:1: the rectangle \"bulb\" has no height",
                     "21:10: \"radius\" has no effect on a rectangle"});
    CHECK(findings_of_lights(
              lit + "[[lamp]]\nid = \"bulb\"\nluminance_cd_m2 = 10\nposition = [0, 0, 3]\nradius = 1\n"
                    "faces = [0, 0, 3]\n") ==
          LightLines{"20:9: the disc \"bulb\" faces the very place that it stands at"});
    CHECK(findings_of_lights(lit + a_lamp + a_lamp).front() == "22:6: id \"bulb\" is taken already");
}

TEST_CASE("a sum is of other lights, and has nothing else", "[unit]") {
    const std::string two =
        "[[light]]\nid = \"a\"\n[[light]]\nid = \"b\"\nprobe = \"gallery\"\n[[light]]\nid = \"c\"\n";
    const ReadText read(minimal_protocol, two + "sum = { a = 0.5, b = 2 }\nexposure = 3\n");
    CHECK(read.lines().empty());
    REQUIRE(read.protocol);
    REQUIRE(read.protocol->lights[2].parts.size() == 2);
    CHECK(read.protocol->lights[2].parts[1].probe == "gallery");
    CHECK(findings_of_lights(two + "sum = { a = 0.5, d = 2 }\n") ==
          LightLines{"19:7: there is no [[light]] \"d\""});
    CHECK(findings_of_lights(two + "sum = { c = 1 }\n") ==
          LightLines{"19:7: a light cannot be a part of itself"});
    CHECK(findings_of_lights(two + "sum = { a = 0 }\n") ==
          LightLines{"19:7: nothing of any light is in this sum"});
    CHECK(findings_of_lights(two + "sum = { a = 1 }\nrotation_deg = 4\n") ==
          LightLines{"20:16: \"rotation_deg\" has no place in a sum of lights"});
    CHECK(findings_of_lights(two + "sum = { a = 1 }\n[[light]]\nid = \"d\"\nsum = { c = 1 }\n") ==
          LightLines{"22:7: \"c\" is a sum itself"});
}

TEST_CASE("a translucent body wants millimetres, and light that can be met", "[unit]") {
    const std::string wax =
        "[[material]]\nid = \"m\"\nkind = \"translucent\"\nscattering_per_mm = [1, 2, 3]\n"
        "scattering_anisotropy = -0.3\ndensity = 2\nior = 1.4\nroughness = 0.1\n";
    CHECK(findings_of_lights(wax).empty());
    CHECK(findings_of_lights(wax + "abbe = 40\n") ==
          LightLines{"20:8: \"abbe\" has no effect on a material of kind \"translucent\""});
    CHECK(findings_of_lights(wax + "[[light]]\nid = \"l\"\nsun_lux = 1000\n") ==
          LightLines{"14:8: a sun or lamp is met by chance alone where light leaves a translucent body: the "
                     "smaller it is, the more noise",
                     "22:11: nothing says how bright the probe of light \"l\" is beside its sun and lamps"});
}

TEST_CASE("what is given in place of the file's word, films and brushed metals say what has no effect",
          "[unit]") {
    const auto findings_of_material = [](const std::string& keys) {
        return findings_of_lights("[[material]]\nid = \"m\"\n" + keys);
    };
    CHECK(
        findings_of_material("kind = \"own\"\nroughness = 0.1\nof = \"glaze\"\nbumps = \"none\"\n").empty());
    CHECK(findings_of_material("kind = \"own\"\nof = \"glaze\"\n") ==
          LightLines{"15:6: \"of\" has no effect where nothing is given in place of what the file says"});
    CHECK(findings_of_material("kind = \"glass\"\nroughness = 0.1\nabbe = 60\n").empty());
    CHECK(findings_of_material("kind = \"glass\"\nmetallic = 1\n") ==
          LightLines{"15:12: \"metallic\" has no effect on a material of kind \"glass\""});
    CHECK(findings_of_material("kind = \"smooth-conductor\"\nfilm_ior = 1.5\n") ==
          LightLines{"15:12: \"film_ior\" has no effect without \"film_nm\""});
    CHECK(
        findings_of_material("kind = \"rough-conductor\"\nanisotropy = 0.5\nmultiple_scattering = true\n") ==
        LightLines{"15:14: a brushed metal is followed by one reflection at each meeting"});
    CHECK(findings_of_material("kind = \"rough-conductor\"\nclear_coat = 1\nclear_coat_roughness = 0.1\n")
              .empty());
    CHECK(findings_of_material("kind = \"rough-conductor\"\nanisotropy = 0.5\nclear_coat = 1\n") ==
          LightLines{"15:14: a brushed metal has no clear coat"});
    CHECK(findings_of_material("kind = \"plastic\"\nclear_coat_roughness = 0.1\n") ==
          LightLines{"15:24: \"clear_coat_roughness\" has no effect without \"clear_coat\""});
    // A coat out of range is one fault, not two.
    CHECK(findings_of_material("kind = \"plastic\"\nclear_coat = 2\nclear_coat_roughness = 0.1\n").size() ==
          1);
    CHECK(findings_of_material("kind = \"diffuse\"\nclear_coat = 1\n") ==
          LightLines{"15:14: \"clear_coat\" has no effect on a material of kind \"diffuse\""});
}
