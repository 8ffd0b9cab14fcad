#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/stimulus/photodiode_patch.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

using Lines = std::vector<std::string>;

TEST_CASE("keys that a mode of output cannot follow are errors at these keys", "[unit]") {
    CHECK(ReadText(minimal_protocol, "[display]\noutput = \"vpixx-c48\"\nwidth_px = 1919\n").lines() ==
          Lines{"14:12: vpixx-c48 joins pixels in pairs: the width has to be even"});
    CHECK(ReadText(minimal_protocol, "[display]\noutput = \"mono++\"\npair_filter = \"lanczos\"\n").lines() ==
          Lines{"14:15: mono++ joins no pixels in pairs: pair_filter has no meaning"});
    CHECK(
        ReadText(minimal_protocol, "[display]\ndither = \"ordered\"\n").lines() ==
        Lines{
            "13:10: color++ carries 16 bits in bytes that noise would turn into others: nothing to dither"});
    CHECK(ReadText(minimal_protocol, "[display]\noutput = \"native-10bit\"\ngamma = 2.2\nonset_trigger = 1\n")
              .lines() ==
          Lines{"15:17: native-10bit has no digital outputs: onset_trigger needs mono++, color++, bits++, "
                "vpixx-m16 or vpixx-c48"});
    CHECK(ReadText(minimal_protocol, "[display]\noutput = \"bits++\"\nonset_trigger = 1024\n").lines() ==
          Lines{"14:17: bits++ has ten digital outputs: onset_trigger may be 1023 at most"});
    CHECK(ReadText(minimal_protocol,
                   "[display]\noutput = \"bits++\"\nwidth_px = 512\nheight_px = 288\n[view]\n"
                   "width_px = 64\nheight_px = 64\n[screens]\ntext_height_deg = 1\n")
              .lines() == Lines{"14:12: bits++ carries messages in rows of 524 px: the screen is narrower"});
    for (const char* sound : {"output = \"native-8bit\"\ngamma = 2.2\ndither = \"blue-noise\"\n",
                              "output = \"vpixx-c48\"\npair_filter = \"lanczos\"\n",
                              "output = \"bits++\"\nonset_trigger = 1023\n",
                              "output = \"vpixx-m16\"\nonset_trigger = 16777215\n"}) {
        CAPTURE(sound);
        CHECK(ReadText(minimal_protocol, std::string("[display]\n") + sound).lines().empty());
    }
}

TEST_CASE("a display box is named by its port, and only where the output goes through one", "[unit]") {
    CHECK(ReadText(minimal_protocol, "[display]\nbox = \"ttyACM0\"\n").lines() ==
          Lines{"13:7: \"ttyACM0\" is no serial port"});
    CHECK(ReadText(minimal_protocol, "[display]\noutput = \"vpixx-m16\"\nbox = \"/dev/ttyACM0\"\n").lines() ==
          Lines{"14:7: vpixx-m16 is sent through no box: box needs mono++, color++ or bits++"});
    for (const char* sound : {"box = \"auto\"\n", "box = \"none\"\n", "box = \"/dev/pts/3\"\n",
                              "output = \"vpixx-m16\"\nbox = \"none\"\n"}) {
        CAPTURE(sound);
        CHECK(ReadText(minimal_protocol, std::string("[display]\n") + sound).lines().empty());
    }
    CHECK(ReadText(minimal_protocol, "").protocol->display.box == "auto");
}

TEST_CASE("what linearises the display is said once, and agrees with gamma and the table of the box",
          "[unit]") {
    const auto lines = [](const std::string& keys) {
        return ReadText(minimal_protocol, "[display]\n" + keys).lines();
    };
    CHECK(lines("linearised_by = \"display\"\ngamma = 2.2\n") ==
          Lines{"14:9: light is said to be proportional to the signal already: with gamma = 2.2 it would be "
                "corrected twice"});
    CHECK(lines("output = \"native-8bit\"\nlinearised_by = \"none\"\ngamma = 1\n") ==
          Lines{"14:17: nothing is said to linearise the display, and gamma = 1 corrects for nothing"});
    CHECK(lines("output = \"native-8bit\"\nlinearised_by = \"box\"\n") ==
          Lines{"14:17: native-8bit is sent through no box whose table could linearise the display"});
    CHECK(lines("linearised_by = \"box\"\n") ==
          Lines{"13:17: 13bitLinearLUT.txt leaves values as they are, and linearises nothing"});
    CHECK(
        lines("linearised_by = \"display\"\nbox_gamma_table = \"lab3.txt\"\n") ==
        Lines{
            "14:19: a table of the box changes values, where the box is not said to linearise the display"});
    CHECK(lines("output = \"native-8bit\"\ngamma = 2.2\nbox_gamma_table = \"lab3.txt\"\n") ==
          Lines{"15:19: native-8bit is sent through no box: box_gamma_table has no meaning"});
    for (const char* sound : {"linearised_by = \"display\"\n", "linearised_by = \"none\"\ngamma = 2.2\n",
                              "linearised_by = \"box\"\nbox_gamma_table = \"lab3.txt\"\n",
                              "output = \"native-8bit\"\nlinearised_by = \"display\"\n"}) {
        CAPTURE(sound);
        CHECK(lines(sound).empty());
    }
}

TEST_CASE("a stimulus stays on the screen and off the rows that speak to the display", "[unit]") {
    const auto lines = [](const std::string& more) { return ReadText(minimal_protocol, more).lines(); };
    CHECK(lines("[view]\nleft_px = 897\n") ==
          Lines{"13:11: the stimulus takes the columns 897 to 1920, the screen has 0 to 1919"});
    CHECK(lines("[view]\ntop_px = 57\n") ==
          Lines{"13:10: the stimulus takes the rows 57 to 1080, the screen has 0 to 1079"});
    CHECK(lines("[view]\ncentre_up_deg = 0.5\n") ==
          Lines{"13:17: the stimulus takes the rows -14 to 1009, the screen has 0 to 1079"});
    CHECK(lines("[view]\ntop_px = 2\n") ==
          Lines{"13:10: the stimulus begins in row 2, but color++ keeps the first three rows for messages to "
                "the display"});
    CHECK(lines("[view]\ntop_px = 3\n").empty());
    CHECK(lines("[view]\nheight_px = 1080\n").size() == 1);
    CHECK(lines("[display]\noutput = \"vpixx-m16\"\n[view]\ntop_px = 1\n").empty());
    CHECK(lines("[display]\noutput = \"native-8bit\"\ngamma = 2.2\n[view]\nheight_px = 1080\n").empty());
    CHECK(lines("[view]\nleft_px = 3\ncentre_right_deg = 1\n") ==
          Lines{"14:20: left_px already says where the stimulus is"});
    CHECK(lines("[view]\nwidth_px = 333\nleft_px = 101\n").empty());
}

TEST_CASE("a stimulus placed by angles is seen under these angles", "[unit]") {
    const ReadText read(minimal_protocol, "[view]\nwidth_px = 101\nheight_px = 100\ncentre_right_deg = -7.5\n"
                                          "centre_up_deg = 3\n");
    REQUIRE(read.protocol);
    const ScreenGeometry geometry = screen_geometry_of(*read.protocol);
    const ScreenPoint middle = geometry.screen_from_image(0.5 * glm::dvec2(geometry.image_px));
    CHECK(middle.x_px < geometry.centre().x_px);
    CHECK(middle.y_px < geometry.centre().y_px);
    // Half a pixel is what whole pixels may be off.
    const double half_px_deg = 0.5 / geometry.px_per_deg_at_centre();
    CHECK(geometry.angle_between(geometry.centre(), {middle.x_px, geometry.centre().y_px}).value ==
          Approx(7.5).margin(half_px_deg));
    CHECK(geometry.angle_between(geometry.centre(), {geometry.centre().x_px, middle.y_px}).value ==
          Approx(3.0).margin(half_px_deg));
}

TEST_CASE("a square for a photodiode stands in its corner, below the rows of messages and of whole pairs",
          "[unit]") {
    DisplaySettings display;
    display.width_px = 800;
    display.height_px = 600;
    display.photodiode_px = 41;
    CHECK_FALSE(photodiode_patch_of(display));
    display.output = OutputMode::color_plus_plus;
    display.photodiode = PatchCorner::top_left;
    CHECK(photodiode_patch_of(display)->origin_px == glm::ivec2(0, 3));
    CHECK(photodiode_patch_of(display)->size_px == glm::ivec2(42, 41));
    display.photodiode = PatchCorner::bottom_right;
    CHECK(photodiode_patch_of(display)->end_px() == glm::ivec2(800, 600));
    display.output = OutputMode::native_8bit;
    display.photodiode = PatchCorner::top_right;
    CHECK(photodiode_patch_of(display)->origin_px == glm::ivec2(759, 0));
    CHECK(photodiode_patch_of(display)->size_px == glm::ivec2(41, 41));
}

TEST_CASE("a square for a photodiode that comes too close to the stimulus is an error", "[unit]") {
    // The stimulus takes the columns 448 to 1471 and the rows 28 to 1051.
    const auto lines = [](const std::string& keys) {
        return ReadText(minimal_protocol, "[display]\n" + keys).lines();
    };
    CHECK(lines("photodiode = \"top-left\"\nphotodiode_px = 436\n").empty());
    for (const char* corner : {"top-left", "top-right", "bottom-left", "bottom-right"}) {
        const Lines found = lines(std::string("photodiode = \"") + corner + "\"\nphotodiode_px = 438\n");
        REQUIRE(found.size() == 1);
        CHECK(found[0].find("closer than 12 px to the stimulus in columns 448 to 1471") != std::string::npos);
    }
}

TEST_CASE("a protocol that repeats trials for misses that nothing proves is warned", "[unit]") {
    const auto lines = [](const std::string& keys) { return ReadText(minimal_protocol, keys).lines(); };
    const std::string repeats = "[repeat]\nmissed_refreshes = \"now\"\n";
    CHECK(lines(repeats).empty());
    CHECK(lines("[display]\ntiming = \"unproven\"\n").empty());
    const Lines found = lines("[display]\ntiming = \"unproven\"\n" + repeats);
    REQUIRE(found.size() == 1);
    CHECK(found[0].find("by times that nothing proves") != std::string::npos);
}
