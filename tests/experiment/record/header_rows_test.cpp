/// A header in which no two things are alike, in its tables, row by row.
#include "experiment/record/header_rows.h"

#include <map>
#include <set>

#include <SQLiteCpp/SQLiteCpp.h>
#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/record/header_checks.h"
#include "experiment/record/session_schema.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

/// Two views, slots, blocks, motions and lights; every list has several entries, every number is another.
SessionHeader crowded_header() {
    SessionHeader header = example_header();
    header.dataset = {{"authors", "A. One"}, {"authors", "B. Two"}, {"licence", "CC0"}};
    header.protocol.included = {{"parts/a.toml", "a = 1\n", hash_of_text("a = 1\n")},
                                {"parts/b.toml", "b = 2\n", hash_of_text("b = 2\n")}};
    header.blocks = {"first", "second"};
    header.lights = {{"day", "Day"}, {"dusk", "Dusk"}};
    header.motions = {{"sway", "To and fro"}, {"still", "Not at all"}};
    header.views = {{"front", "From the front"}, {"side", "From the side"}};
    header.backgrounds = {{"grey", "Grey"}, {"black", "Black"}};
    header.materials[1].columns = {{"price", "12.5", 12.5}, {"kind", "metal"}};
    header.lights[0].columns = {{"hour", "9", 9.0}};
    header.objects[1].columns = {{"age", "70", 70.0}, {"sex", "f"}};
    Animation still = header.animations.front();
    still.frame_count = 2;
    still.duration_s = 1.5;
    header.animations.push_back(still);
    header.poses.angles = {{{-12.5}}, {{0.1}, glm::dquat(0.5, 0.5, -0.5, 0.5), {1.25, 2.25, 3.25}}, {{12.5}}};
    header.poses.of_motion = {{PoseIndex{0}, PoseIndex{1}, PoseIndex{2}}, {PoseIndex{2}, PoseIndex{1}}};
    header.objects[0].cameras.push_back({{7.0, 8.0, 9.0}, {10.0, 11.0, 12.0}, Degrees{13.0}, -31.5});
    header.objects[1].cameras = {{{14.0, 15.0, 16.0}, {17.0, 18.0, 19.0}, Degrees{20.0}},
                                 {{21.0, 22.0, 23.0}, {24.0, 25.0, 26.0}, Degrees{27.0}}};
    header.slots = {{"left", "On the left", {10, 20}, {300, 400}},
                    {"right", "On the right", {410, 21}, {300, 400}}};
    header.stimuli = {{{0, 1, 1, 0, 1, 1}, "rendered", std::string(64, '1'), std::string(64, '2'), "a"},
                      {{1, 0, 0, 1, 0, 0}, "given", std::string(64, '3'), std::string(64, '4'), "b"}};
    header.maps = {{{0, 1},
                    {2},
                    "maps/a.exr",
                    std::string(64, '5'),
                    RecordedMap::Made::live,
                    RecordedMap::Kind::coordinates},
                   {{1, 0}, {1}, "maps/b.exr", std::string(64, '6')}};
    header.points = {{0, "eye.1", 11, {0.5, 0.25, 0.25}, {1.5, 2.5, 3.5}, 12, "head"},
                     {1, "lip.1", 13, {0.125, 0.375, 0.5}, {4.5, 5.5, 6.5}, {}, "body"}};
    std::vector<Trial>& trials = header.schedule.trials;
    trials[0].block = trials[1].block = 0;
    trials[2].block = trials[3].block = 1;
    trials[1].levels = {{"side", "left"}, {"cue", "valid"}};
    trials[3].levels = {{"side", "right"}};
    trials[1].correct = "yes";
    trials[2].role = TrialRole::catch_trial;
    trials[3].role = TrialRole::practice;
    trials[2].slot = 1;
    trials[3].beside = {{{1, 0, 1, 0, 1, 0}, 1}};
    RecordedCharacterisation light;
    light.display = "A screen";
    light.date = "2024-02-28";
    light.instrument = "A meter";
    light.sha256 = std::string(64, '7');
    light.black_xyz = {0.1, 0.2, 0.3};
    light.primaries_xyz = {glm::dvec3{1.0, 2.0, 3.0}, glm::dvec3{4.0, 5.0, 6.0}, glm::dvec3{7.0, 8.0, 9.0}};
    light.files = {{"a.toml", "x"}, {"b.csv", "y"}};
    header.characterisation = light;
    return header;
}

/// The rows of every table, in the order of its key, as text.
std::map<std::string, std::string> tables_in(const fs::path& file) {
    SQLite::Database database(file.string(), SQLite::OPEN_READONLY);
    std::map<std::string, std::string> tables;
    SQLite::Statement names(database, "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT IN "
                                      "('seal', 'sealed_table')");
    while (names.executeStep()) {
        std::string& text = tables[names.getColumn(0).getString()];
        SQLite::Statement rows(database, "SELECT * FROM " + names.getColumn(0).getString());
        while (rows.executeStep()) {
            for (int column = 0; column < rows.getColumnCount(); ++column)
                text += (column == 0 ? "" : "|") + rows.getColumn(column).getString();
            text += "\n";
        }
    }
    return tables;
}

SessionHeader read_from(const fs::path& file) {
    return read_session_header(SQLite::Database(file.string(), SQLite::OPEN_READONLY));
}

} // namespace

TEST_CASE("a header that is written again from what is read has the same rows in every table", "[unit]") {
    const TemporaryFolder root;
    const fs::path first = root.path() / "a.sqlite", second = root.path() / "b.sqlite";
    const SessionHeader header = crowded_header();
    REQUIRE_NOTHROW(check_header(header, first));
    create_session_file(first, header);
    const SessionHeader read = read_from(first);
    CHECK(read.schedule.trials == header.schedule.trials);
    CHECK(read.slots == header.slots);
    CHECK(read.dataset == header.dataset);
    REQUIRE(read.animations.size() == 2);
    REQUIRE(read.animations[0].given.size() == 3);
    REQUIRE(read.animations[1].given.size() == 2);
    CHECK(read.animations[0].given[2].object == header.poses.angles[2]);
    CHECK(read.animations[1].given[1].object == header.poses.angles[1]);
    create_session_file(second, read);
    const auto as_written = tables_in(first), again = tables_in(second);
    REQUIRE(as_written.size() > 40);
    for (const auto& [name, rows] : as_written) {
        INFO(name);
        CHECK(again.at(name) == rows);
    }
}

TEST_CASE("what a header says of its trials, slots, lists and objects stands in their tables", "[unit]") {
    const TemporaryFolder root;
    const fs::path file = root.path() / "a.sqlite";
    create_session_file(file, crowded_header());
    const auto tables = tables_in(file);
    CHECK(tables.at("schedule_level") == "1|0|side|left\n1|1|cue|valid\n3|0|side|right\n");
    CHECK(tables.at("schedule_answer") == "1|yes|trial\n2||catch\n3||practice\n");
    CHECK(tables.at("schedule_slot") == "2|0|1|0|0|0|0|0|0\n3|0|0|1|1|0|0|0|0\n3|1|1|1|0|1|0|1|0\n");
    CHECK(tables.at("slot") == "0|left|On the left|10|20|300|400\n1|right|On the right|410|21|300|400\n");
    CHECK(tables.at("block") == "0|first\n1|second\n");
    CHECK(tables.at("task") == "0|free|Look around\n1|age|How old?\tSay it.\n");
    CHECK(tables.at("dataset_entry") == "0|authors|A. One\n1|authors|B. Two\n2|licence|CC0\n");
    CHECK_THAT(tables.at("protocol_file"), Contains("0|parts/a.toml|a = 1\n") && Contains("1|parts/b.toml|"));
    CHECK(tables.at("entry_column") == "light|0|0|hour|9|9.0\nmaterial|1|0|price|12.5|12.5\n"
                                       "material|1|1|kind|metal|\nobject|1|0|age|70|70.0\n"
                                       "object|1|1|sex|f|\n");
    CHECK(tables.at("light") == "0|day|Day\n1|dusk|Dusk\n");
    CHECK(tables.at("part") == "0|0|body\n0|1|head\n1|0|body\n");
    CHECK(tables.at("camera") == "0|0|1.0|-200.5|3.0|0.25|0.5|0.75|11.5|0.0\n"
                                 "0|1|7.0|8.0|9.0|10.0|11.0|12.0|13.0|-31.5\n"
                                 "1|0|14.0|15.0|16.0|17.0|18.0|19.0|20.0|0.0\n"
                                 "1|1|21.0|22.0|23.0|24.0|25.0|26.0|27.0|0.0\n");
    CHECK(tables.at("pose") == "0|-12.5|1.0|0.0|0.0|0.0|0.0|0.0|0.0\n"
                               "1|0.1|0.5|0.5|-0.5|0.5|1.25|2.25|3.25\n2|12.5|1.0|0.0|0.0|0.0|0.0|0.0|0.0\n");
    CHECK(tables.at("animation_frame") == "0|0|0|0.0\n0|1|1|0.0\n0|2|2|0.0\n1|0|2|0.0\n1|1|1|0.0\n");
    CHECK(tables.at("point") == "0|0|eye.1|11|0.5|0.25|0.25|1.5|2.5|3.5|12|head\n"
                                "1|1|lip.1|13|0.125|0.375|0.5|4.5|5.5|6.5||body\n");
    CHECK(tables.at("stimulus") == "0|1|1|0|1|1|rendered|" + std::string(64, '1') + "|" +
                                       std::string(64, '2') + "|a\n1|0|0|1|0|0|given|" +
                                       std::string(64, '3') + "|" + std::string(64, '4') + "|b\n");
    CHECK(tables.at("map") == "0|1|2|maps/a.exr|" + std::string(64, '5') +
                                  "|live|coordinates\n1|0|1|maps/b.exr|" + std::string(64, '6') +
                                  "|prepared|triangles\n");
    CHECK(tables.at("characterisation_file") == "0|a.toml|x\n1|b.csv|y\n");
}

TEST_CASE("rows of a header that name what is not there are refused with the table", "[unit]") {
    const auto [change, told] = GENERATE(table<const char*, const char*>({
        {"UPDATE schedule_slot SET trial = 4 WHERE trial = 3", "schedule_slot: there is no trial 4"},
        {"UPDATE schedule_level SET trial = 4 WHERE trial = 3", "there is no trial 4"},
        {"PRAGMA ignore_check_constraints = ON; UPDATE schedule_answer SET role = 'other' WHERE trial = 2",
         "table schedule_answer: there is no such role of a trial"},
        {"UPDATE schedule_answer SET trial = 4 WHERE trial = 3", "there is no trial 4"},
        {"UPDATE animation_frame SET motion = 2 WHERE motion = 1", "there is no motion 2"},
        {"UPDATE animation_frame SET pose = 3 WHERE pose = 2", "there is no pose 3"},
        {"UPDATE camera SET object = 2 WHERE object = 1", "there is no object 2"},
        {"UPDATE camera SET view = 256 WHERE view = 1 AND object = 1", "in view 256"},
        {"UPDATE point SET object = 2 WHERE object = 1", "table point: there is no object 2"},
        {"UPDATE point SET object = -1 WHERE object = 1", "table point: there is no object -1"},
        {"UPDATE part SET object = 2 WHERE object = 1", "table part: there is no object 2"},
        {"UPDATE entry_column SET entry = 2 WHERE list = 'light'", "there is no light 2"},
        {"DELETE FROM session", "the one row that describes the session is missing"},
    }));
    CAPTURE(change);
    const TemporaryFolder root;
    const fs::path file = root.path() / "a.sqlite";
    create_session_file(file, crowded_header());
    SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec(change);
    CHECK_THROWS_WITH(read_from(file), Contains(told));
}

TEST_CASE("headers of earlier programs read with what they did not know", "[unit]") {
    const TemporaryFolder root;
    const fs::path file = root.path() / "a.sqlite";
    create_session_file(file, crowded_header());
    const auto changed = [&](const char* sql) {
        SQLite::Database(file.string(), SQLite::OPEN_READWRITE).exec(sql);
        return read_from(file);
    };
    // What they called the hash of the frames is that of what frames are made from.
    const SessionHeader no_made = changed("UPDATE stimulus SET made_from_sha256 = '' WHERE object = 0");
    CHECK(no_made.stimuli[0].frames_sha256.empty());
    CHECK(no_made.stimuli[0].made_from_sha256 == std::string(64, '1'));
    CHECK(no_made.stimuli[1].frames_sha256 == std::string(64, '3'));
    CHECK(changed("DROP TABLE slot").slots ==
          std::vector<RecordedSlot>{{"centre", "centre", {144, 44}, {512, 511}}});
    const SessionHeader flat = changed("ALTER TABLE pose DROP COLUMN tilt_w");
    CHECK(flat.poses.angles[1].angle == Degrees{0.1});
    CHECK(flat.poses.angles[1].shift == glm::dvec3(0.0));
    // In version 1 all maps were of triangles.
    CHECK(changed("PRAGMA user_version = 2").maps[0].kind == RecordedMap::Kind::coordinates);
    CHECK(changed("PRAGMA user_version = 1").maps[0].kind == RecordedMap::Kind::triangles);
    CHECK(changed("UPDATE animation_frame SET light_deg = 4.5 WHERE motion = 1 AND frame = 0")
              .animations[1]
              .given[0]
              .light == Degrees{4.5});
    CHECK(changed("UPDATE camera SET view = 255 WHERE object = 1 AND view = 1").objects[1].cameras.size() ==
          256);
    CHECK(changed("DROP TABLE camera").objects[0].cameras.size() == 1);
    CHECK(changed("DROP TABLE point").points.empty());
    CHECK(changed("DROP TABLE block").blocks.empty());
    CHECK(changed("DROP TABLE dataset_entry").dataset.empty());
    CHECK(changed("DROP TABLE schedule_level").schedule.trials[2].role == TrialRole::trial);
    CHECK_FALSE(changed("DELETE FROM characterisation").characterisation);
    CHECK_FALSE(changed("DROP TABLE characterisation").characterisation);
    CHECK(changed("DROP TABLE entry_column").materials[1].columns.empty());
}

TEST_CASE("a session file that is there is not written over", "[unit]") {
    const TemporaryFolder root;
    const fs::path file = root.path() / "a.sqlite";
    create_session_file(file, example_header());
    const std::string before = text_of(file);
    CHECK_THROWS_WITH(create_session_file(file, crowded_header()), Contains("is not overwritten"));
    CHECK(text_of(file) == before);
}

TEST_CASE("an import of an earlier program, which has a motion that nothing went through, has none",
          "[unit]") {
    const TemporaryFolder root;
    const auto duration_read = [&](bool knows_stimulus, bool has_one_pose) {
        const fs::path file = root.path() / "a.sqlite";
        fs::remove(file);
        SessionHeader header = example_header();
        header.animations = {Animation()};
        header.poses = distinct_poses(header.animations.front());
        if (!knows_stimulus) {
            header.stimuli.clear();
            header.maps.clear();
            for (RecordedObject& object : header.objects)
                object.mesh_file.clear();
        }
        create_session_file(file, header);
        if (has_one_pose)
            SQLite::Database(file.string(), SQLite::OPEN_READWRITE)
                .exec("DELETE FROM animation_frame WHERE frame > 0; DELETE FROM pose WHERE pose > 0");
        return read_from(file).animations.at(0).duration_s;
    };
    CHECK(duration_read(false, true) == 0.0);
    CHECK(duration_read(false, false) == Animation().duration_s);
    CHECK(duration_read(true, true) == Animation().duration_s);
    CHECK(duration_read(true, false) == Animation().duration_s);
}
