#include "experiment/record/header_rows.h"

#include <catch2/catch.hpp>

#include "experiment/record/header_tables.h"
#include "experiment/record/preview_file.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_schema.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;

TEST_CASE("a session's header comes back from the disk in every field", "[unit]") {
    const TemporaryFolder root;
    SessionHeader in = example_header();
    in.objects[0].origin = {565400.0, 5934200.25, -35.5};
    in.objects[0].surface_sha256 = std::string(64, 'c');
    in.objects[0].surface_files = "bust.glb; skin.png";
    in.display.stereo = "mirrors";
    in.display.interocular_mm = 61.5;
    for (RecordedObject& object : in.objects) {
        object.cameras.resize(2 * in.views_of_an_eye(), object.cameras.front());
        object.cameras.front().aside = -30.75;
        object.cameras.back().aside = 30.75;
    }
    const SessionRecord record(make_session(root.path(), in));
    const SessionHeader& out = record.header();

    CHECK(out.protocol.name == in.protocol.name);
    CHECK(out.protocol.title == in.protocol.title);
    CHECK(out.protocol.text == in.protocol.text);
    CHECK(out.protocol.sha256 == in.protocol.sha256);
    CHECK(out.schedule.observer.label == in.schedule.observer.label);
    CHECK(out.schedule.observer.number == in.schedule.observer.number);
    CHECK(out.schedule.seed == in.schedule.seed);
    CHECK(out.schedule.trials == in.schedule.trials);
    CHECK(out.session_number == in.session_number);
    CHECK(out.started_utc == in.started_utc);
    CHECK(out.clock == in.clock);
    CHECK(out.program.version == in.program.version);
    CHECK(out.program.compiler == in.program.compiler);
    CHECK(out.program.flags == in.program.flags);
    CHECK(out.program.commit == in.program.commit);
    CHECK(out.graphics.context == in.graphics.context);
    CHECK(out.graphics.vendor == in.graphics.vendor);
    CHECK(out.graphics.renderer == in.graphics.renderer);
    CHECK(out.graphics.version == in.graphics.version);
    CHECK(out.tracker.name == in.tracker.name);
    CHECK(out.tracker.sample_rate_hz == in.tracker.sample_rate_hz);
    CHECK(out.tracker.eye == in.tracker.eye);
    CHECK(out.display.screen.screen_px == in.display.screen.screen_px);
    CHECK(out.display.screen.screen_mm == in.display.screen.screen_mm);
    CHECK(out.display.screen.viewing_distance_mm == in.display.screen.viewing_distance_mm);
    CHECK(out.display.screen.image_origin_px == in.display.screen.image_origin_px);
    CHECK(out.display.screen.image_px == in.display.screen.image_px);
    CHECK(out.display.refresh_hz == in.display.refresh_hz);
    CHECK(out.display.latency == in.display.latency);
    CHECK(out.display.output_mode == in.display.output_mode);
    CHECK(out.display.background == in.display.background);
    CHECK(out.display.stereo == in.display.stereo);
    CHECK(out.display.interocular_mm == in.display.interocular_mm);
    REQUIRE(out.objects.size() == in.objects.size());
    for (std::size_t i = 0; i < in.objects.size(); ++i)
        CHECK(out.objects[i].cameras == in.objects[i].cameras);
    CHECK(out.animations[0].frame_count == in.animations[0].frame_count);
    CHECK(out.animations[0].frame_rate_hz == in.animations[0].frame_rate_hz);
    CHECK(out.animations[0].amplitude == in.animations[0].amplitude);
    CHECK(out.animations[0].playback == in.animations[0].playback);
    CHECK(out.animations[0].duration_s == in.animations[0].duration_s);
    CHECK(out.poses.angles == in.poses.angles);
    CHECK(out.poses.of_motion == in.poses.of_motion);
    REQUIRE(out.tasks.size() == 2);
    CHECK(out.tasks[1].id == in.tasks[1].id);
    CHECK(out.tasks[1].question == in.tasks[1].question);
    REQUIRE(out.materials.size() == 2);
    CHECK(out.materials[1].id == in.materials[1].id);
    CHECK(out.materials[1].title == in.materials[1].title);
    REQUIRE(out.objects.size() == 2);
    const RecordedObject &bust = out.objects[0], &given = in.objects[0];
    CHECK(bust.id == given.id);
    CHECK(bust.title == given.title);
    CHECK(bust.mesh_sha256 == given.mesh_sha256);
    CHECK(bust.surface_sha256 == given.surface_sha256);
    CHECK(bust.surface_files == given.surface_files);
    CHECK(bust.mesh_file == given.mesh_file);
    CHECK(bust.part_names == given.part_names);
    CHECK(bust.camera(0).position == given.camera(0).position);
    CHECK(bust.camera(0).target == given.camera(0).target);
    CHECK(bust.camera(0).vertical_fov == given.camera(0).vertical_fov);
    CHECK(bust.axis_point == given.axis_point);
    CHECK(bust.bounds.min == given.bounds.min);
    CHECK(bust.bounds.max == given.bounds.max);
    CHECK(bust.unit == given.unit);
    CHECK(bust.origin == given.origin);
    REQUIRE(out.stimuli.size() == 2);
    CHECK(out.stimuli[1].stimulus == in.stimuli[1].stimulus);
    CHECK(out.stimuli[1].source == in.stimuli[1].source);
    CHECK(out.stimuli[0].frames_sha256 == in.stimuli[0].frames_sha256);
    CHECK(out.stimuli[0].made_from_sha256 == in.stimuli[0].made_from_sha256);
    CHECK(out.stimuli[0].drawn_by == in.stimuli[0].drawn_by);
    REQUIRE(out.maps.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(out.maps[i].viewed == in.maps[i].viewed);
        CHECK(out.maps[i].pose == in.maps[i].pose);
        CHECK(out.maps[i].file == in.maps[i].file);
        CHECK(out.maps[i].sha256 == in.maps[i].sha256);
        CHECK(out.maps[i].made == in.maps[i].made);
        CHECK(out.maps[i].kind == in.maps[i].kind);
    }
}

TEST_CASE("docs/session_format.md has the columns of the header as their tables say", "[unit]") {
    const std::string page = text_of(std::filesystem::path(OVERT_SOURCE_DIR) / "docs/session_format.md");
    for (const std::string& rows :
         {describe(session_table()), describe(characterisation_table()), describe(object_table())}) {
        INFO("The page must hold these lines:\n" << rows);
        CHECK(page.find("| --- | --- |\n" + rows + "\n") != std::string::npos);
    }
}

TEST_CASE("a session that lacks a column of today reads as the column's row says", "[unit]") {
    const TemporaryFolder root;
    SessionHeader header = example_header();
    header.animations[0].when_late = WhenLate::stretch;
    const std::filesystem::path session = make_session(root.path(), header);
    CHECK(SessionRecord(session).header().animations[0].when_late == WhenLate::stretch);
    SQLite::Database(session / session_file_name, SQLite::OPEN_READWRITE)
        .exec("ALTER TABLE session DROP COLUMN when_late; DROP TABLE animation");
    CHECK(SessionRecord(session).header().animations[0].when_late == WhenLate::drop);
}

TEST_CASE("the words of the header's enumerations are all that its table takes", "[unit]") {
    const TemporaryFolder root;
    const std::filesystem::path session = make_session(root.path(), example_header());
    SQLite::Database database(session / session_file_name, SQLite::OPEN_READWRITE);
    CHECK_NOTHROW(
        database.exec("UPDATE session SET playback = 'cycle', clock = 'steady', tracker_eye = 'right'"));
    CHECK_THROWS_AS(database.exec("UPDATE session SET playback = 'back and forth'"), SQLite::Exception);
    CHECK_THROWS_AS(database.exec("UPDATE session SET duration_s = 'long'"), SQLite::Exception);
}

TEST_CASE("a slot of another size shows a further view, whose screen has its image", "[unit]") {
    SessionHeader header = example_header();
    header.views = {{"front", ""}, {"side", ""}};
    header.slots = {
        {"a", "", {0, 1}, {300, 400}}, {"b", "", {300, 2}, {300, 400}}, {"c", "", {600, 3}, {200, 100}}};
    const Stimulus side{1, 0, 0, 0, 1, 0};
    const auto view_in = [&](int slot) { return header.in_slot({side, slot}).view; };
    CHECK(view_in(0) == 1);
    CHECK(view_in(1) == 1);
    CHECK(view_in(2) == 3);
    CHECK(view_in(-1) == 1);
    CHECK(view_in(3) == 1);
    CHECK(header.in_slot({side, 2}).object == 1);
    for (const int view : {0, 1, 4, 5})
        CHECK(header.screen_of_view(view).image_px == header.display.screen.image_px);
    for (const int view : {2, 3}) {
        CHECK(header.screen_of_view(view).image_px == glm::ivec2(200, 100));
        CHECK(header.screen_of_view(view).image_origin_px == glm::ivec2(600, 3));
    }
    CHECK(header.screen_of_slot(1).image_origin_px == glm::ivec2(300, 2));
    for (const int slot : {-1, 3})
        CHECK(header.screen_of_slot(slot).image_origin_px == header.display.screen.image_origin_px);
    CHECK(stimulus_name(header, side) == "vase/gold/side");
    CHECK(stimulus_name(header, header.in_slot({side, 2}), "_") == "vase_gold_side_c");
    CHECK(stimulus_name(header, {1, 0, 0, 0, 5, 0}) == "vase/gold/side");
    CHECK(entry_counts(header) == std::array<std::size_t, stimulus_lists.size()>{2, 2, 1, 1, 2, 1});
}

TEST_CASE("a stimulus of a session is found by all of it, and named by the entries of its lists", "[unit]") {
    SessionHeader header = example_header();
    header.stimuli.clear();
    const Stimulus first{0, 0, 0, 0, 0, 0}, second{0, 0, 0, 0, 1, 0}, third{0, 0, 0, 0, 0, 1};
    CHECK(stimulus_of(header, first) == nullptr);
    header.stimuli.resize(2);
    header.stimuli[0].stimulus = first;
    header.stimuli[1].stimulus = second;
    CHECK(stimulus_of(header, first) == &header.stimuli[0]);
    CHECK(stimulus_of(header, second) == &header.stimuli[1]);
    CHECK(stimulus_of(header, third) == nullptr);
    CHECK(preview_file(header, first) == "stimuli/" + stimulus_name(header, first, "_") + ".png");
    CHECK(light_file(header, first) == "stimuli/" + stimulus_name(header, first, "_") + "_light.exr");
}
