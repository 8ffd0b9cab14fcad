#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/design/schedule.h"
#include "experiment/protocol/all_stimuli.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

using Lines = std::vector<std::string>;

namespace {

/// The lines of a protocol whose task, in line 9, shows stimuli in `slots`; what follows begins in line 13.
Lines slot_lines(const std::string& slots, const std::string& more) {
    return ReadText(minimal_protocol, "slots = " + slots + "\n" + more).lines();
}

std::string slot_of(const std::string& id, const std::string& keys) {
    return "[[slot]]\nid = \"" + id + "\"\n" + keys + "\n";
}

} // namespace

TEST_CASE("without slots there is one, where the view has the stimulus", "[unit]") {
    const ReadText read(minimal_protocol,
                        "[view]\nwidth_px = 301\nheight_px = 200\nleft_px = 55\ntop_px = 20\n");
    REQUIRE(read.protocol);
    REQUIRE(read.protocol->slots.size() == 1);
    CHECK(read.protocol->slots[0].id == "centre");
    const ScreenGeometry at = slot_geometry(*read.protocol, read.protocol->slots[0]);
    CHECK(at.image_origin_px == glm::ivec2(55, 20));
    CHECK(at.image_px == glm::ivec2(301, 200));
    CHECK(slots_of_task(*read.protocol, 0) == std::vector<int>{0});
    const Schedule schedule = make_schedule(*read.protocol, {"01", 1}, 1);
    for (const Trial& trial : schedule.trials)
        CHECK(trial.shown_count() == 1);
}

TEST_CASE("a slot's place and size are angles from the middle of the screen", "[unit]") {
    const ReadText read(minimal_protocol, "slots = [\"left\", \"right\"]\n" +
                                              slot_of("left", "right_deg = -5\nsize_deg = 8") +
                                              slot_of("right", "right_deg = 5\nup_deg = 2\nsize_deg = 8"));
    CHECK(read.lines() == Lines{});
    REQUIRE(read.protocol);
    const ScreenGeometry left = slot_geometry(*read.protocol, read.protocol->slots[0]);
    const ScreenGeometry right = slot_geometry(*read.protocol, read.protocol->slots[1]);
    CHECK(left.image_px == right.image_px);
    CHECK(left.image_px.x % 2 == 0);
    CHECK(left.image_origin_px.x % 2 == 0);
    CHECK(right.image_origin_px.x % 2 == 0);
    // As far to the left as the other to the right, to the pixel that makes columns even.
    const int sum = left.image_origin_px.x + right.image_origin_px.x + left.image_px.x;
    CHECK(std::abs(sum - 1920) <= 2);
    const auto middle_of = [](const ScreenGeometry& at) {
        return ScreenPoint{at.image_origin_px.x + 0.5 * at.image_px.x,
                           at.image_origin_px.y + 0.5 * at.image_px.y};
    };
    const ScreenPoint centre = left.centre();
    CHECK(middle_of(left).x_px < centre.x_px);
    CHECK(left.angle_between(middle_of(left), centre).value == Approx(5.0).margin(0.03));
    CHECK(middle_of(right).y_px < centre.y_px); // upwards
    CHECK(left.middle_deg().x == Approx(-5.0).margin(0.03));
    CHECK(right.middle_deg().y == Approx(2.0).margin(0.02));
    CHECK(left.angle_between({centre.x_px, middle_of(right).y_px}, centre).value == Approx(2.0).margin(0.02));
    CHECK(left.angle_between({centre.x_px - 0.5 * left.image_px.x, centre.y_px},
                             {centre.x_px + 0.5 * left.image_px.x, centre.y_px})
              .value == Approx(8.0).margin(0.03));
}

TEST_CASE("a circle and a grid are written out as places with numbers", "[unit]") {
    const ReadText read(minimal_protocol,
                        "slots = \"ring\"\n" + slot_of("ring", "circle = 4\nradius_deg = 4\nsize_deg = 3") +
                            slot_of("page", "grid = [3, 2]\ndistance_deg = 4\nsize_deg = 3"));
    CHECK(read.lines() == Lines{});
    REQUIRE(read.protocol);
    const std::vector<Slot>& slots = read.protocol->slots;
    REQUIRE(slots.size() == 10);
    CHECK(slots[0].id == "ring-1");
    const double places[][2] = {{0, 4}, {4, 0}, {0, -4},  {-4, 0}, {-4, 2},
                                {0, 2}, {4, 2}, {-4, -2}, {0, -2}, {4, -2}};
    for (std::size_t i = 0; i < slots.size(); ++i) {
        CAPTURE(i, slots[i].id);
        CHECK(*slots[i].right_deg == Approx(places[i][0]).margin(1e-12));
        CHECK(*slots[i].up_deg == Approx(places[i][1]).margin(1e-12));
    }
    CHECK(slots[9].id == "page-6");
    CHECK(slots_of_task(*read.protocol, 0) == std::vector<int>{0, 1, 2, 3});
    const Schedule schedule = make_schedule(*read.protocol, {"01", 1}, 1);
    REQUIRE(!schedule.trials.empty());
    const Trial& trial = schedule.trials.front();
    REQUIRE(trial.shown_count() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(trial.shown(i).slot == static_cast<int>(i));
        CHECK(trial.shown(i).stimulus == trial.stimulus);
    }
}

TEST_CASE("the object takes the same share of a slot as of the image of the view", "[unit]") {
    const std::string slot = "slots = \"x\"\n" + slot_of("x", "width_deg = 4\nheight_deg = 3");
    const ReadText fitted(minimal_protocol, slot);
    REQUIRE(fitted.protocol);
    const ScreenGeometry at = slot_geometry(*fitted.protocol, fitted.protocol->slots[0]);
    CHECK(screen_geometry_of(*fitted.protocol).image_px == at.image_px);
    CHECK(at.image_px.x > at.image_px.y);
    CHECK(!fitted.protocol->views.front().vertical_fov_deg); // what the observer sees of the slot
    // A camera that stands somewhere sees as much of the object as in the image of the view.
    const ReadText placed(minimal_protocol,
                          slot + "[view]\ncamera_position = [0, -900, 0]\nheight_px = 1000\n");
    REQUIRE(placed.protocol);
    CHECK(std::tan(0.5 * to_radians({*placed.protocol->views.front().vertical_fov_deg}).value) ==
          Approx(0.5 * 1000 * (392.9 / 1080) / 1750.0));
}

TEST_CASE("slots that overlap, leave the screen or are unknown are errors at their place", "[unit]") {
    const std::string left = slot_of("left", "right_deg = -5\nsize_deg = 8"),
                      right = slot_of("right", "right_deg = 5\nsize_deg = 8");
    CHECK(slot_lines("[\"left\", \"right\"]", left + right) == Lines{});
    CHECK(slot_lines("[\"left\", \"rihgt\"]", left + right) == Lines{"12:9: there is no slot \"rihgt\""});
    CHECK(slot_lines("[\"left\", \"left\"]", left + right) == Lines{"12:9: slot \"left\" is listed twice"});
    CHECK(ReadText(minimal_protocol, left + right).lines() ==
          Lines{"9:1: task \"free\" does not say in which of the 2 slots it shows stimuli"});
    CHECK(slot_lines("\"left\"", left + slot_of("left", "right_deg = 5\nsize_deg = 8")) ==
          Lines{"18:6: id \"left\" is taken already"});
    const Lines overlap =
        slot_lines("[\"left\", \"wide\"]", left + slot_of("wide", "right_deg = 2\nsize_deg = 8"));
    REQUIRE(overlap.size() == 1);
    CHECK(overlap[0].starts_with("12:9: the slots \"left\" and \"wide\" overlap: columns "));
    const Lines beyond = slot_lines("\"far\"", slot_of("far", "right_deg = 9\nsize_deg = 8"));
    REQUIRE(beyond.size() == 1);
    CHECK(beyond[0].starts_with("15:13: slot \"far\" takes columns "));
    // One finding for all the places of a circle.
    CHECK(slot_lines("\"ring\"", slot_of("ring", "circle = 8\nradius_deg = 9\nsize_deg = 8")).size() == 1);
    // Neighbours of a circle meet.
    CHECK(slot_lines("\"ring\"", slot_of("ring", "circle = 8\nradius_deg = 3\nsize_deg = 3")).size() == 1);
    const Lines rows = slot_lines("\"high\"", slot_of("high", "up_deg = 4.535\nsize_deg = 3.75") +
                                                  "[display]\noutput = \"bits++\"\n");
    REQUIRE(rows.size() == 1);
    CHECK(rows[0].find("for messages to the display") != std::string::npos);
}

TEST_CASE("what an entry of slots lacks, or says twice, is an error at its place", "[unit]") {
    const auto lines = [](const std::string& keys) {
        return slot_lines("\"x\"", slot_of("x", "size_deg = 2\n" + keys));
    };
    CHECK(lines("width_deg = 3") == Lines{"16:13: size_deg already says how large the slot is"});
    CHECK(lines("radius_deg = 3") == Lines{"16:14: \"radius_deg\" says nothing without \"circle\""});
    CHECK(lines("distance_deg = 3") == Lines{"16:16: \"distance_deg\" says nothing without \"grid\""});
    CHECK(lines("circle = 3") ==
          Lines{"16:10: \"circle\" needs \"radius_deg\" above 0, or all places would be one"});
    CHECK(lines("grid = [2, 2]") ==
          Lines{"16:8: \"grid\" needs \"distance_deg\" above 0, or all places would be one"});
    CHECK(lines("grid = [2.5, 2]\ndistance_deg = 3") ==
          Lines{"16:8: a grid is two whole numbers: its columns and its rows"});
    CHECK(lines("circle = 3\nradius_deg = 3\ngrid = [2, 1]\ndistance_deg = 3") ==
          Lines{"18:8: the places are on a circle already"});
}

TEST_CASE("slots of one size share their pictures, and each further size has views of its own", "[unit]") {
    const std::string slots = slot_of("sample", "up_deg = 3\nsize_deg = 5") +
                              slot_of("left", "right_deg = -5\nup_deg = -3\nsize_deg = 4") +
                              slot_of("right", "right_deg = 5\nup_deg = -3\nsize_deg = 4");
    const std::string named = "slots = [\"sample\", \"left\", \"right\"]\n";
    const ReadText read(minimal_protocol, named + slots);
    CHECK(read.lines() == Lines{});
    REQUIRE(read.protocol);
    const Protocol& protocol = *read.protocol;
    const Stimulus stimulus;
    CHECK(protocol.in_slot({stimulus, 0}) == stimulus);
    const Stimulus small = protocol.in_slot({stimulus, 1});
    CHECK(small.view == 1);
    CHECK(protocol.in_slot({stimulus, 2}) == small);
    CHECK(protocol.views_at_all_sizes() == 2);
    for (int slot = 0; slot < 3; ++slot) {
        const ViewSettings& view = protocol.view_of(protocol.in_slot({stimulus, slot}));
        const ScreenGeometry at = slot_geometry(protocol, protocol.slots[static_cast<std::size_t>(slot)]);
        CHECK(glm::ivec2(view.width_px, view.height_px) == at.image_px);
    }
    CHECK(stimuli_in_slots(protocol).size() == 2 * all_stimuli(protocol).size());
    CHECK(all_viewed_objects(protocol).size() == 2 * protocol.objects.size());
    CHECK(stimulus_name(protocol, stimulus) + "/left" == stimulus_name(protocol, small));
    // What another program drew has one size.
    const Lines frames = slot_lines("[\"sample\", \"left\", \"right\"]",
                                    slots + "[[frames]]\nobject = \"muse\"\nmaterial = \"gold\"\n"
                                            "files = \"f_###.png\"\n");
    REQUIRE(!frames.empty());
    CHECK(std::ranges::any_of(frames, [](const std::string& line) {
        return line.find("ready-made frames are of one size") != std::string::npos;
    }));
}
