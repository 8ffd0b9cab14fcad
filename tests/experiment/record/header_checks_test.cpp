#include "experiment/record/header_checks.h"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;
using Catch::Matchers::Contains;

namespace {

/// A header with a second view and a second slot.
SessionHeader checked_header() {
    SessionHeader header = example_header();
    header.slots = {{"left", "", {0, 0}, {400, 600}}, {"right", "", {400, 0}, {400, 600}}};
    header.blocks = {"one", "two"};
    return header;
}

/// The same with a value changed: `value` of it is what the header has then.
template <class Value, class Change> void changes(Value value, bool holds, const char* told, Change change) {
    CAPTURE(value, told);
    SessionHeader header = checked_header();
    change(header, value);
    if (holds)
        CHECK_NOTHROW(check_header(header, "a"));
    else
        CHECK_THROWS_WITH(check_header(header, "a"), Contains(told) && Contains("the file is damaged"));
}

template <class Change> void is_whole_between(int least, int most, const char* told, Change change) {
    changes(least - 1, false, told, change);
    changes(least, true, told, change);
    changes(most, true, told, change);
    changes(most + 1, false, told, change);
}

template <class Change> void is_between(double least, double most, const char* told, Change change) {
    changes(std::nextafter(least, -1e300), false, told, change);
    changes(least, true, told, change);
    changes(most, true, told, change);
    changes(std::nextafter(most, 1e300), false, told, change);
    changes(std::numeric_limits<double>::quiet_NaN(), false, told, change);
}

} // namespace

TEST_CASE("a header's screen, rates and times are within what can be, to the last of it", "[unit]") {
    const char* const screen = "the screen of the session";
    is_whole_between(1, 100'000, screen, [](SessionHeader& h, int px) {
        h.slots.resize(1); // which need not be on the screen
        h.display.screen.screen_px.x = px;
    });
    is_whole_between(1, 100'000, screen, [](SessionHeader& h, int px) {
        h.slots.resize(1);
        h.display.screen.screen_px.y = px;
    });
    is_whole_between(1, 100'000, screen, [](SessionHeader& h, int px) { h.display.screen.image_px.x = px; });
    is_whole_between(1, 100'000, screen, [](SessionHeader& h, int px) { h.display.screen.image_px.y = px; });
    is_whole_between(-100'000, 100'000, screen,
                     [](SessionHeader& h, int px) { h.display.screen.image_origin_px.x = px; });
    is_whole_between(-100'000, 100'000, screen,
                     [](SessionHeader& h, int px) { h.display.screen.image_origin_px.y = px; });
    is_between(0.0, 1e6, screen, [](SessionHeader& h, double mm) { h.display.screen.screen_mm.x = mm; });
    is_between(0.0, 1e6, screen, [](SessionHeader& h, double mm) { h.display.screen.screen_mm.y = mm; });
    is_between(0.0, 1e6, screen,
               [](SessionHeader& h, double mm) { h.display.screen.viewing_distance_mm = mm; });
    is_between(0.0, 1e6, "the tracker's rate",
               [](SessionHeader& h, double hz) { h.tracker.sample_rate_hz = hz; });
    constexpr std::int64_t hour_ns = 3'600'000'000'000;
    for (const std::int64_t ns : {hour_ns, -hour_ns, hour_ns + 1, -hour_ns - 1})
        changes(ns, std::abs(ns) == hour_ns, "the display's latency",
                [](SessionHeader& h, std::int64_t of) { h.display.latency = SessionDuration(of); });
}

TEST_CASE("a header's presentations are such as can be laid out refresh by refresh", "[unit]") {
    const char* const told = "the animation, or the display's refresh rate,";
    const auto with = [](auto member) {
        return [member](SessionHeader& h, double value) {
            h.animations.front().duration_s = 1e-4;
            h.animations.front().*member = Degrees{value};
        };
    };
    is_between(-1e6, 1e6, told, with(&Animation::amplitude));
    is_between(-1e6, 1e6, told, with(&Animation::angle));
    is_between(-1e6, 1e6, told, with(&Animation::light_amplitude));
    is_between(1e-3, 1e5, told, [](SessionHeader& h, double hz) {
        h.display.refresh_hz = 0.0;
        h.animations.front().frame_rate_hz = hz;
    });
    is_between(0.1, 1e5, told, [](SessionHeader& h, double hz) { h.display.refresh_hz = hz; });
    changes(0.0, true, told, [](SessionHeader& h, double hz) { h.display.refresh_hz = hz; });
    is_between(0.0, 1e6, told, [](SessionHeader& h, double s) {
        h.display.refresh_hz = 0.0;
        h.animations.front().frame_rate_hz = 1.0;
        h.animations.front().duration_s = s;
    });
    // Ten million refreshes, or frames, are the most: of the presentation, and of a pass of all frames.
    for (const double s : {1e5, 1e5 + 1.0}) {
        changes(s, s == 1e5, told, [](SessionHeader& h, double of) {
            h.display.refresh_hz = 100.0;
            h.animations.front().frame_rate_hz = 1.0;
            h.animations.front().duration_s = of;
        });
        changes(s, s == 1e5, told, [](SessionHeader& h, double of) {
            h.display.refresh_hz = 1.0;
            h.animations.front().frame_rate_hz = 100.0;
            h.animations.front().duration_s = of;
        });
    }
    for (const double hz : {0.03125, 0.015625}) // 3 frames at that rate: 96 s and 192 s
        changes(hz, hz == 0.03125, told, [](SessionHeader& h, double of) {
            h.display.refresh_hz = 100'000.0;
            h.animations.front().frame_rate_hz = of;
        });
    for (const int count : {0, 1, 1'000'000, 1'000'001})
        changes(count, count == 1 || count == 1'000'000, told, [](SessionHeader& h, int of) {
            h.animations.front().frame_rate_hz = 100.0;
            h.animations.front().frame_count = of;
            h.poses.of_motion.front().assign(static_cast<std::size_t>(of), PoseIndex{0});
        });
}

TEST_CASE("what a header counts off is in the list that it counts", "[unit]") {
    const char* const poses = "the table of poses";
    is_whole_between(0, 2, poses,
                     [](SessionHeader& h, int pose) { h.poses.of_motion[0][1] = PoseIndex{pose}; });
    for (const std::size_t count : {2u, 3u, 4u})
        changes(count, count == 3, poses,
                [](SessionHeader& h, std::size_t of) { h.poses.of_motion[0].resize(of, PoseIndex{0}); });
    for (const std::size_t count : {0u, 1u, 2u})
        changes(count, count == 1, poses,
                [](SessionHeader& h, std::size_t of) { h.poses.of_motion.resize(of); });
    changes(0, false, poses, [](SessionHeader& h, int) { h.poses.angles.clear(); });

    const char* const map = "the object or the pose of map \"maps/bust_02.exr\"";
    is_whole_between(0, 1, map, [](SessionHeader& h, int of) { h.maps[0].viewed.object = of; });
    is_whole_between(0, 0, map, [](SessionHeader& h, int of) { h.maps[0].viewed.view = of; });
    is_whole_between(0, 2, map, [](SessionHeader& h, int of) { h.maps[0].pose = PoseIndex{of}; });

    const char* const stimulus = "the object or the material of a stimulus";
    is_whole_between(0, 1, stimulus, [](SessionHeader& h, int of) { h.stimuli[0].stimulus.object = of; });
    is_whole_between(0, 1, stimulus, [](SessionHeader& h, int of) { h.stimuli[0].stimulus.material = of; });
    is_whole_between(0, 0, stimulus, [](SessionHeader& h, int of) { h.stimuli[0].stimulus.light = of; });
    is_whole_between(0, 0, stimulus, [](SessionHeader& h, int of) { h.stimuli[0].stimulus.motion = of; });
    is_whole_between(0, 0, stimulus, [](SessionHeader& h, int of) { h.stimuli[0].stimulus.view = of; });

    const char* const trial = "the task, object, material or block of planned trial 3";
    is_whole_between(0, 1, trial, [](SessionHeader& h, int of) { h.schedule.trials[2].task = of; });
    is_whole_between(0, 1, trial, [](SessionHeader& h, int of) { h.schedule.trials[2].block = of; });
    is_whole_between(0, 1, trial,
                     [](SessionHeader& h, int of) { h.schedule.trials[2].stimulus.object = of; });
    is_whole_between(0, 0, trial,
                     [](SessionHeader& h, int of) { h.schedule.trials[2].stimulus.background = of; });
    // Each object has the cameras of all views, and each motion its frames.
    for (const std::size_t cameras : {1u, 2u})
        changes(cameras, cameras == 2, trial, [](SessionHeader& h, std::size_t of) {
            h.views = {{"front", ""}, {"side", ""}};
            h.schedule.trials[2].stimulus.view = 1;
            h.objects[0].cameras.resize(of);
        });
    // Where the eyes have pictures of their own, each has its cameras.
    for (const std::size_t cameras : {1u, 2u, 3u})
        changes(cameras, cameras > 1, "the two eyes' cameras before object \"bust\"",
                [](SessionHeader& h, std::size_t of) {
                    h.display.stereo = "mirrors";
                    for (RecordedObject& object : h.objects)
                        object.cameras.resize(of);
                });
    changes(1, false, trial, [](SessionHeader& h, int of) {
        h.motions = {{"sway", ""}, {"still", ""}};
        h.schedule.trials[2].stimulus.motion = of;
    });
    changes(7, true, trial, [](SessionHeader& h, int of) {
        h.blocks.clear();
        h.schedule.trials[2].block = of;
    });
    const char* const shown = "a slot, or what is in it, of planned trial 3";
    is_whole_between(0, 1, shown, [](SessionHeader& h, int of) { h.schedule.trials[2].slot = of; });
    is_whole_between(0, 1, shown, [](SessionHeader& h, int of) {
        h.schedule.trials[2].beside = {{{0, 0}, of}};
    });
    is_whole_between(0, 1, shown, [](SessionHeader& h, int of) {
        h.schedule.trials[2].beside = {{{of, 0}, 1}};
    });
}

TEST_CASE("of several slots each lies on the screen, to its edges", "[unit]") {
    const char* const told = "the id or the place of slot \"right\"";
    is_whole_between(0, 400, told, [](SessionHeader& h, int px) { h.slots[1].origin_px.x = px; });
    is_whole_between(0, 200, told, [](SessionHeader& h, int px) {
        h.slots[1].size_px.y = 400;
        h.slots[1].origin_px.y = px;
    });
    is_whole_between(1, 400, told, [](SessionHeader& h, int px) { h.slots[1].size_px.x = px; });
    is_whole_between(1, 600, told, [](SessionHeader& h, int px) { h.slots[1].size_px.y = px; });
    changes(-5, true, told, [](SessionHeader& h, int px) {
        h.slots.resize(1);
        h.slots[0].origin_px.x = px;
    });
}

TEST_CASE("what names files in a header are plain names", "[unit]") {
    for (const char* const label : {"", "a b", "a/", "A7"})
        changes(label, std::string(label) == "A7", "the observer's label",
                [](SessionHeader& h, const char* of) { h.schedule.observer.label = of; });
    for (const char* const name : {"a/b", "..", "", "bust"}) {
        const bool is_plain = std::string(name) == "bust";
        changes(name, is_plain || std::string(name).empty(), "the protocol's name",
                [](SessionHeader& h, const char* of) { h.protocol.name = of; });
        changes(name, is_plain, "the id or the mesh file of object",
                [](SessionHeader& h, const char* of) { h.objects[1].id = of; });
        changes(name, is_plain, "the id or the place of slot",
                [](SessionHeader& h, const char* of) { h.slots[1].id = of; });
        changes(name, is_plain, "the id of a task",
                [](SessionHeader& h, const char* of) { h.tasks[1].id = of; });
        changes(name, is_plain, "the id of a material",
                [](SessionHeader& h, const char* of) { h.materials[1].id = of; });
        changes(name, is_plain, "a column of silver", [](SessionHeader& h, const char* of) {
            h.materials[1].columns = {{of, "1", 1.0}};
        });
    }
    changes("", true, "the id or the mesh file",
            [](SessionHeader& h, const char* of) { h.objects[1].mesh_file = of; });
    changes("../a", false, "the id or the mesh file of object \"vase\"",
            [](SessionHeader& h, const char* of) { h.objects[1].mesh_file = of; });
    changes("../a", false, "the map file \"../a\"",
            [](SessionHeader& h, const char* of) { h.maps[1].file = of; });
}
