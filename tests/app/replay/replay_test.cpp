/// Recorded sessions presented again: all comes out the same, and what was changed in a record is named.
#include "tests/app/replay/replayed_session.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/app/session/interrupted_run.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("a session with faults, broken off and resumed, is presented again and comes out the same",
          "[session]") {
    const SmallExperiment experiment(full_protocol(), Cache::own);
    const std::string faults =
        experiment.folder()
            .file("faults.toml", std::string(faults_of_both) + std::string(an_unplugged_tracker))
            .string();
    const ProgramRun first =
        experiment.run({"--faults", faults, "--observer-field", "age=31", "--simulate-operator",
                        "task screen@1+0.1=pause", "--simulate-operator", "stimulus@3+0.4=abort"});
    INFO(first.err);
    REQUIRE(first.exit_code == 1);
    // The second sitting has another observer and other faults.
    const std::string others =
        experiment.folder().file("others.toml", with(faults_of_both, "ms = 20", "ms = 12")).string();
    REQUIRE(experiment.run({"--resume", "--trials", "5", "--faults", others}).exit_code == 0);
    // Maps and frames are drawn anew.
    fs::remove_all(experiment.cache());
    fs::remove(faults);
    const ProgramRun run = replay(experiment);
    INFO(run.out << run.err);
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("sitting 1: 3 attempts") && Contains("sitting 2: ") &&
                            Contains("exports in all formats") && Contains("the replay is the same"));
    const ProgramRun by_file =
        experiment.overt({"replay", (experiment.session() / "session.sqlite").string(), "--json"});
    const auto json = nlohmann::json::parse(by_file.out);
    CHECK(json["same"] == true);
    CHECK(json["presented_again"] == true);
    CHECK(json["differences"].empty());
    // The record itself is as it was.
    CHECK(experiment.overt({"verify", experiment.session().string()}).exit_code == 0);
}

TEST_CASE("a session that was killed is compared up to its last row, and its resumption after it",
          "[session]") {
    const SmallExperiment experiment(with(small_protocol, "duration_s = 1", "duration_s = 20"));
    make_interrupted_session(experiment, 1, {"--trials", "3"});
    const ProgramRun cut_off = replay(experiment);
    INFO(cut_off.out << cut_off.err);
    CHECK(cut_off.exit_code == 0);
    CHECK_THAT(cut_off.out, Contains("sitting 1: 2 attempts") && Contains("the program was killed in it"));

    REQUIRE(experiment.overt(run_arguments(experiment, "P01", {"--virtual-time", "--resume"})).exit_code ==
            0);
    const ProgramRun whole = replay(experiment);
    INFO(whole.out << whole.err);
    CHECK(whole.exit_code == 0);
    CHECK_THAT(whole.out, Contains("sitting 2: 2 attempts with "));

    // What a later sitting recorded does not excuse an earlier one.
    change(experiment.session(), "UPDATE flip SET shown = shown + 1 WHERE trial_id = 2 AND n = 3");
    const ProgramRun changed = replay(experiment);
    CHECK(changed.exit_code == 1);
    CHECK_THAT(changed.out, Contains("first difference: table flip, trial 2, n 3, shown: recorded"));
}

/// All rows of an attempt are taken out, as if the program had been killed before the first of them.
static void forget_attempt(const fs::path& session, std::int64_t attempt) {
    SQLite::Database database((session / "session.sqlite").string(), SQLite::OPEN_READWRITE);
    std::vector<std::string> tables;
    SQLite::Statement found(database, "SELECT m.name FROM sqlite_master m JOIN pragma_table_info(m.name) c "
                                      "WHERE m.type = 'table' AND c.name = 'trial_id'");
    while (found.executeStep())
        tables.push_back(found.getColumn(0).getString());
    for (const std::string& table : tables)
        database.exec(fmt::format("DELETE FROM {} WHERE trial_id = {}", table, attempt));
}

TEST_CASE("a session that was killed between an attempt's first event and its row is the same up to there",
          "[session]") {
    const SmallExperiment experiment(with(small_protocol, "duration_s = 1", "duration_s = 20"));
    make_interrupted_session(experiment, 1, {"--trials", "3"});
    std::int64_t last = 0;
    {
        const SessionRecord record(experiment.session());
        REQUIRE(record.trials().size() == 2);
        last = record.trials().back().id;
        REQUIRE_FALSE(record.trials().back().has_outcome());
    }
    forget_attempt(experiment.session(), last);
    const ProgramRun run = replay(experiment);
    INFO(run.out << run.err);
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("sitting 1: 1 attempt with") && Contains("the replay is the same"));
    // Nor does it take an attempt of the next sitting for its own.
    REQUIRE(experiment.overt(run_arguments(experiment, "P01", {"--virtual-time", "--resume"})).exit_code ==
            0);
    CHECK_THAT(replay(experiment).out,
               Contains("sitting 2: 2 attempts with ") && Contains("the replay is the same"));
    // What the record has of the attempt that it lacks is compared.
    change(experiment.session(),
           "UPDATE event SET at_ns = at_ns + 1 WHERE id = (SELECT MAX(id) FROM event WHERE sitting = 1)");
    CHECK_THAT(replay(experiment).out, Contains("first difference: table event"));
}

TEST_CASE("a session that a signal ended is compared up to its end", "[session]") {
    const SmallExperiment experiment(with(small_protocol, "duration_s = 1", "duration_s = 20"));
    bool was_ended = false;
    for (int tries = 0; tries < 10 && !was_ended; ++tries) {
        fs::remove_all(experiment.session());
        RunningProgram program(run_arguments(experiment, "P01", {"--virtual-time"}),
                               {"OVERT_CACHE=" + experiment.cache().string()},
                               experiment.folder().path() / "said");
        while (program.is_running() && attempts_so_far(experiment.session()).size() < 2)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        program.signal(SIGINT);
        program.wait();
        const SessionRecord record(experiment.session());
        was_ended =
            record.trials().size() > 1 && record.trials().back().status == TrialRecord::Status::aborted;
    }
    REQUIRE(was_ended);
    const ProgramRun run = replay(experiment);
    INFO(run.out << run.err);
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("it was ended by a signal") && Contains("exports in all formats") &&
                            Contains("the replay is the same"));
    change(experiment.session(), "UPDATE flip SET pose = pose + 1 WHERE trial_id = 1 AND n = 2");
    CHECK_THAT(replay(experiment).out, Contains("first difference: table flip, trial 1, n 2, pose"));
}

TEST_CASE("each single change of a record is found and named", "[session]") {
    const SmallExperiment experiment(full_protocol());
    const std::string faults = experiment.folder().file("faults.toml", faults_of_both).string();
    REQUIRE(experiment.run({"--faults", faults, "--trials", "3", "--verify-output"}).exit_code == 0);
    const fs::path pristine = experiment.folder().path() / "pristine.sqlite";
    const fs::path file = experiment.session() / "session.sqlite";
    fs::copy_file(file, pristine);
    const struct {
        std::string sql, named;
    } changes[] = {
        {"UPDATE flip SET vertical_blank_ns = vertical_blank_ns + 1 WHERE trial_id = 2 AND n = 7",
         "table flip, trial 2, n 7, vertical_blank_ns: recorded "},
        {"UPDATE flip SET planned = 3 WHERE trial_id = 1 AND n = 0", "table flip, trial 1, n 0, planned: "},
        {"DELETE FROM flip WHERE trial_id = 3 AND n = 100",
         "table flip, trial 3, n 100: the row is only in the replay"},
        {"UPDATE sample SET x_px = x_px + 0.001 WHERE trial_id = 2 AND n = 500",
         "table sample, trial 2, n 500, x_px: recorded "},
        {"INSERT INTO sample SELECT trial_id, 100000, tracker_us, eye, x_px, y_px, pupil_area FROM sample "
         "WHERE trial_id = 1 AND n = 9",
         "table sample, trial 1, n 100000: the row is only in the record"},
        {"UPDATE trial SET answer = 'a hat' WHERE trial_id = 2",
         "table trial, trial 2, answer: recorded a hat"},
        {"UPDATE trial SET responded_ns = responded_ns - 1000 WHERE trial_id = 3",
         "table trial, trial 3, responded_ns: recorded "},
        {"UPDATE schedule SET task = (task + 1) % 2 WHERE trial = 0",
         "table schedule, trial 1, task: recorded "},
        {"UPDATE stimulus SET frames_sha256 = lower(hex(zeroblob(32))) WHERE object = 1 AND material = 0",
         "table stimulus, object 1, material 0, light 0, motion 0, view 0, background 0, frames_sha256: "
         "recorded 000"},
        {"UPDATE session SET protocol_text = replace(protocol_text, 'duration_s = 1', 'duration_s = 2')",
         "table session, protocol_text: recorded "},
        {"UPDATE session SET seed = '8'", "table schedule, "},
        {"UPDATE map SET sha256 = lower(hex(zeroblob(32))) WHERE object = 0 AND pose = 3",
         "table map, object 0, view 0, pose 3, sha256: recorded 000"},
        {"UPDATE missed_refresh SET refresh_in_trial = refresh_in_trial + 1 WHERE trial_id = 1 AND "
         "refresh_in_trial = (SELECT max(refresh_in_trial) FROM missed_refresh WHERE trial_id = 1)",
         "table missed_refresh, trial 1, refresh_in_trial "},
        {"UPDATE gaze_event SET end_us = end_us + 1000 WHERE trial_id = 2 AND n = 1",
         "table gaze_event, trial 2, n 1, end_us: recorded "},
        {"UPDATE clock_pair SET tracker_us = tracker_us + 1 WHERE id = 4",
         "table clock_pair, row 4, tracker_us: "},
        {"UPDATE event SET detail = 'another screen' WHERE kind = 'display fault' AND trial = 1",
         "table event, trial 2, row "},
        {"UPDATE observer_field SET title = 'Height'", "table observer_field, n 1, title: recorded Height"},
        {"UPDATE consent SET at_ns = at_ns + 1", "table consent, n 1, at_ns: recorded "},
        {"UPDATE answer_recording SET voice_onset_ns = voice_onset_ns + 1 WHERE trial_id = 2",
         "table answer_recording, trial 2, voice_onset_ns: "},
        {"UPDATE event SET detail = replace(detail, 'ms = 20', 'ms = 40') WHERE kind = 'simulated display "
         "faults'",
         "table "},
    };
    for (const auto& [sql, named] : changes) {
        fs::copy_file(pristine, file, fs::copy_options::overwrite_existing);
        change(experiment.session(), sql);
        const ProgramRun run = replay(experiment);
        INFO(sql << "\n" << run.out << run.err);
        CHECK(run.exit_code == 1);
        CHECK_THAT(run.out, Contains("first difference: " + named));
    }
    fs::copy_file(pristine, file, fs::copy_options::overwrite_existing);
    CHECK(replay(experiment).exit_code == 0);

    // And of its files.
    const fs::path picture = experiment.session() / "stimuli" / "bust_matt.png";
    REQUIRE(fs::exists(picture));
    fs::copy_file(experiment.session() / "stimuli" / "bust_smooth.png", picture,
                  fs::copy_options::overwrite_existing);
    const ProgramRun run = replay(experiment);
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.out, Contains("first difference: file stimuli/bust_matt.png"));
}

TEST_CASE("what cannot be presented again is refused with its place and the remedy", "[session]") {
    const SmallExperiment experiment;
    CHECK_THAT(experiment.overt({"replay", experiment.folder().path().string()}).err,
               Contains("this folder holds no session"));
    CHECK(experiment.overt({"replay", experiment.protocol().string()}).exit_code == 1);
    REQUIRE(experiment.run({"--trials", "1"}).exit_code == 0);
    const fs::path elsewhere = experiment.folder().path() / "moved";
    fs::create_directories(elsewhere);
    fs::rename(experiment.folder().path() / "meshes", elsewhere / "meshes");
    const ProgramRun lost = replay(experiment);
    CHECK(lost.exit_code == 2);
    CHECK_THAT(lost.err, Contains("small.toml:") && Contains("meshes/bust.ply") && Contains("--files DIR"));
    const ProgramRun found = replay(experiment, {"--files", elsewhere.string()});
    INFO(found.out << found.err);
    CHECK(found.exit_code == 0);
    // The protocol's file itself is not needed: its text is in the record.
    fs::remove(experiment.protocol());
    CHECK(replay(experiment, {"--files", elsewhere.string()}).exit_code == 0);

    // A mesh of other corners is another stimulus.
    write_ply(elsewhere / "meshes/bust.ply", tall_bust());
    const ProgramRun other = replay(experiment, {"--files", elsewhere.string()});
    CHECK(other.exit_code == 1);
    CHECK_THAT(other.out, Contains("table object, object 0, mesh_sha256: recorded "));

    change(experiment.session(), "UPDATE run_option SET name = 'upside-down' WHERE name = 'maps'");
    const ProgramRun unknown = replay(experiment, {"--files", elsewhere.string()});
    CHECK(unknown.exit_code == 1);
    CHECK_THAT(unknown.err, Contains("table run_option") && Contains("--upside-down"));
}
