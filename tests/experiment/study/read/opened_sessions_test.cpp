/// What sessions have in common when they are opened for a study: which are the same, and which objects are.
#include "experiment/study/read/open_sessions.h"

#include <functional>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/record/gaze_rows.h"
#include "experiment/record/session_schema.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;

namespace {

using HeaderChange = std::function<void(SessionHeader&)>;

std::string refusal_to_open(const std::vector<fs::path>& sessions) {
    try {
        open_sessions(sessions, {});
    } catch (const InputError& error) {
        return error.what();
    }
    return "opened";
}

void run_sql_in(const fs::path& session, const std::string& sql) {
    SQLite::Database((session / session_file_name).string(), SQLite::OPEN_READWRITE).exec(sql);
}

} // namespace

TEST_CASE("an object is the same only where all that makes its maps and its size is", "[unit]") {
    SessionHeader plain = example_header();
    plain.objects[1] = plain.objects[0];
    plain.objects[1].id = "other";
    plain.maps = {{{0, 0}, {0}, "a", "1"}, {{0, 0}, {1}, "b", "2"}, {{1, 0}, {0}, "c", "9"}};
    const auto same = [&](const HeaderChange& change, bool has_mesh = true) {
        SessionHeader one = plain, other = plain;
        if (!has_mesh)
            one.objects[0].mesh_file = other.objects[0].mesh_file = "";
        change(other);
        const bool is_same = is_same_object(one, {0, 0}, other, {0, 0});
        CHECK(is_same_object(other, {0, 0}, one, {0, 0}) == is_same);
        return is_same;
    };
    CHECK(same([](SessionHeader&) {}));
    CHECK(same([](SessionHeader&) {}, false));
    // Titles and screens' places of the image say nothing of it.
    CHECK(same([](SessionHeader& h) { h.objects[0].title = "Another"; }));
    CHECK(same([](SessionHeader& h) { h.display.screen.image_origin_px.x += 3; }));
    const std::vector<HeaderChange> changes{
        [](SessionHeader& h) { h.poses.angles[1] = {{3.0}}; },
        [](SessionHeader& h) { h.objects[0].id = "another"; },
        [](SessionHeader& h) { h.objects[0].mesh_file = ""; },
        [](SessionHeader& h) { h.objects[0].mesh_sha256 = std::string(64, 'z'); },
        [](SessionHeader& h) { h.objects[0].cameras[0].position.y += 1.0; },
        [](SessionHeader& h) { h.objects[0].cameras[0].target.z += 1.0; },
        [](SessionHeader& h) { h.objects[0].cameras[0].vertical_fov.value += 1.0; },
        [](SessionHeader& h) { h.display.screen.image_px.x += 1; },
        [](SessionHeader& h) { h.display.screen.screen_px.y += 1; },
        [](SessionHeader& h) { h.display.screen.screen_mm.x += 1.0; },
        [](SessionHeader& h) { h.display.screen.viewing_distance_mm += 1.0; }};
    for (std::size_t i = 0; i < changes.size(); ++i) {
        CAPTURE(i);
        CHECK_FALSE(same(changes[i]));
    }
    // Maps tell two objects apart that have no mesh, in whatever order they stand; with a mesh they do not.
    const HeaderChange another_map = [](SessionHeader& h) { h.maps[1].sha256 = "3"; };
    CHECK(same(another_map));
    CHECK_FALSE(same(another_map, false));
    CHECK(same([](SessionHeader& h) { std::swap(h.maps[0], h.maps[2]); }, false));
    CHECK(same([](SessionHeader& h) { h.maps[2].sha256 = "3"; }, false)); // of the other object
}

TEST_CASE("an object is called by its view and by the size that its slot has", "[unit]") {
    SessionHeader header = example_header();
    header.views = {{.id = "front", .title = "from the front"}, {.id = "side", .title = "from the side"}};
    header.slots = {{"left", "Left", {0, 0}, {512, 511}}, {"right", "Right", {0, 0}, {256, 250}}};
    RecordedObject& bust = header.objects[0];
    bust.cameras.assign(4, bust.cameras[0]);
    for (int view = 0; view < 4; ++view)
        bust.cameras[static_cast<std::size_t>(view)].position.x = 10.0 * view;
    bust.unit = "own";
    bust.origin = {7.0, 8.0, 9.0};
    CHECK(describe_object(header, {0, 0}).title == "A bust, from the front, at 511 px");
    const StudyObject last = describe_object(header, {0, 3});
    CHECK(last.title == "A bust, from the side, at 250 px");
    CHECK(last.id == "bust");
    CHECK(last.camera.position.x == 30.0);
    CHECK(last.screen.image_px == glm::ivec2(256, 250));
    CHECK(last.axis_point == glm::dvec3(1.5, 2.5, 3.5));
    CHECK(last.unit == "own");
    CHECK(last.origin == glm::dvec3(7.0, 8.0, 9.0));
    CHECK(last.part_names == std::vector<std::string>{"body", "head"});
    CHECK(last.areas.names() == Areas(last.part_names).names());
    // One view, or none that is listed, has no name of its own; nor has one size.
    header.slots.clear();
    bust.cameras.resize(2);
    CHECK(describe_object(header, {0, 1}).title == "A bust, from the side");
    header.views.resize(1);
    bust.cameras.resize(1);
    CHECK(describe_object(header, {0, 0}).title == "A bust");
    header.views.clear();
    CHECK(describe_object(header, {0, 0}).title == "A bust");
}

TEST_CASE("imports of one recording are told with each other, and copies with whose they are", "[unit]") {
    const TemporaryFolder root;
    std::vector<fs::path> sessions;
    for (const char* const observer : {"A1", "B2", "C3", "D4"}) {
        SessionHeader header = example_header();
        header.schedule.observer.label = observer;
        header.stimuli.clear();
        sessions.push_back(make_session(root.path(), header));
        run_sql_in(
            sessions.back(),
            "INSERT INTO sitting (sitting, started_utc, closed) VALUES (1, '2024-03-01T00:00:00Z', 1)");
        run_sql_in(sessions.back(), std::string("INSERT INTO gaze_source VALUES (1, 'a.asc', '") +
                                        (*observer == 'C'   ? "other"
                                         : *observer == 'D' ? ""
                                                            : "same") +
                                        "', '', 'area', 500, 'both', 1, 1, 0)");
    }
    CHECK(refusal_to_open({sessions[0], sessions[2], sessions[3]}) == "opened");
    CHECK(refusal_to_open(sessions) == sessions[1].string() + " was imported from the same recording as " +
                                           sessions[0].string() +
                                           ". Its gaze would count twice: give one of them.");
    // Of a recorded session it is no matter from where its gaze was brought.
    SessionHeader header = example_header();
    header.schedule.observer.label = "E5";
    const fs::path own = make_session(root.path(), header);
    run_sql_in(own,
               "INSERT INTO sitting (sitting, started_utc, closed) VALUES (1, '2024-03-01T00:00:00Z', 1);"
               "INSERT INTO gaze_source VALUES (1, 'a.asc', 'same', '', 'area', 500, 'both', 1, 1, 0)");
    CHECK(refusal_to_open({sessions[0], own}) == "opened");
    // A copy is the same whatever it was imported from.
    const fs::path copies = root.path() / "copies";
    fs::create_directory(copies);
    fs::copy(sessions[0], copies / "of A1", fs::copy_options::recursive);
    fs::copy(sessions[2], copies / "of C3", fs::copy_options::recursive);
    CHECK(
        refusal_to_open({sessions[0], copies / "of A1", sessions[2], copies / "of C3"}) ==
        (copies / "of A1").string() + " is the same session as " + sessions[0].string() +
            " (observer A1, session 3, begun 2024-02-29T23:59:59Z);\n" + (copies / "of C3").string() +
            " is the same session as " + sessions[2].string() +
            " (observer C3, session 3, begun 2024-02-29T23:59:59Z). Its gaze would count twice: give one of "
            "them.");
    CHECK(refusal_to_open(
              {sessions[2], root.path() / "copies" / ".." / fs::relative(sessions[2], root.path())}) ==
          (root.path() / "copies" / ".." / fs::relative(sessions[2], root.path())).string() +
              ": this session was named twice.");
}

TEST_CASE("sessions differ by observer, number, begin, seed and protocol", "[unit]") {
    const TemporaryFolder root;
    int number = 0;
    const auto together = [&](const HeaderChange& change) {
        std::vector<fs::path> both;
        for (const bool is_changed : {false, true}) {
            SessionHeader header = example_header();
            if (is_changed)
                change(header);
            const fs::path folder = root.path() / std::to_string(number++);
            fs::create_directory(folder);
            both.push_back(make_session(folder, header));
        }
        return refusal_to_open(both) == "opened";
    };
    CHECK_FALSE(together([](SessionHeader& h) { h.session_number += 0; }));
    CHECK(together([](SessionHeader& h) { h.schedule.observer.label = "Other"; }));
    CHECK(together([](SessionHeader& h) { h.session_number += 1; }));
    CHECK(together([](SessionHeader& h) { h.started_utc = "2025-02-28T23:59:59Z"; }));
    CHECK(together([](SessionHeader& h) { h.schedule.seed += 1; }));
    CHECK(together([](SessionHeader& h) { h.protocol.name = "other"; }));
    CHECK(together([](SessionHeader& h) {
        h.protocol.text += "\n";
        h.protocol.sha256 = hash_of_text(h.protocol.text);
    }));
}

TEST_CASE("a session is described by its folder, title, form and the trials that give results", "[unit]") {
    const TemporaryFolder root;
    SessionHeader header = example_header();
    header.schedule.trials[1].role = TrialRole::practice;
    header.schedule.trials[2].role = TrialRole::catch_trial;
    header.protocol.title = "";
    const fs::path session = make_session(root.path(), header);
    {
        SessionStore store(session / session_file_name, patient());
        store.observer_fields({{"age", "Age", "34"}, {"hand", "Hand", "left"}});
        for (const Trial& trial : header.schedule.trials) {
            store.trial_started(trial, at_ms(10'000 * trial.index));
            store.trial_finished(trial, outcome_at(10'000 * trial.index));
        }
        store.close();
    }
    const auto opened = open_sessions(std::array{session}, {});
    const std::string folder = session.filename().string();
    for (const fs::path& name : {session, session / "", session / session_file_name, session / "."}) {
        CAPTURE(name);
        const StudySession described = describe_session(opened[0], name);
        CHECK(described.folder == folder);
        CHECK(described.protocol == "tiny");
        CHECK(described.observer == "AB7");
        CHECK(described.number == 3);
        CHECK(described.form == std::vector<StudyKey>{{"age", "34"}, {"hand", "left"}});
        CHECK(described.is_complete);
        CHECK(described.trials == 2);
        CHECK(described.setup.program_version == "0.1.0");
    }
    CHECK(opened[0].presentations.size() == 4);
    CHECK(opened[0].path == fs::weakly_canonical(session));
    CHECK_FALSE(opened[0].is_one_of_many);
    CHECK(state_of(opened[0].record()) == "4 trials, last time 34000000000 ns");
}
