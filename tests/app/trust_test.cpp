/// What files of strangers can do to a lab, by the commands that a user types.
#include <fstream>
#include <set>
#include <thread>

#include <SQLiteCpp/SQLiteCpp.h>
#include <catch2/catch.hpp>
#include <sys/stat.h>

#include "experiment/record/read/session_record.h"
#include "tests/app/small_experiment.h"
#include "tests/support/running_program.h"

namespace fs = std::filesystem;
using namespace overt::test;
using Catch::Contains;

namespace {

/// A session of three trials.
fs::path short_session(const SmallExperiment& experiment, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"--trials", "3"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = experiment.run(arguments);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    return experiment.session();
}

bool any_file_has(const fs::path& folder, const std::string& words) {
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && text_of(entry.path()).find(words) != std::string::npos)
            return true;
    return false;
}

std::vector<fs::path> cached_frames(const fs::path& cache) {
    std::set<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(cache / "frames"))
        if (entry.path().extension() == ".exr")
            files.insert(entry.path());
    return {files.begin(), files.end()};
}

std::string frames_told_of(const fs::path& session) {
    const overt::SessionRecord record(session);
    std::string hashes;
    for (const overt::RecordedStimulus& stimulus : record.header().stimuli)
        hashes += stimulus.frames_sha256 + "\n";
    return hashes;
}

} // namespace

TEST_CASE("links and pipes in a session are neither read nor exported, and verify names them", "[session]") {
    const SmallExperiment experiment;
    const fs::path session = short_session(experiment);
    const fs::path secret = experiment.folder().file("secret.txt", "the secret of the lab");
    fs::path preview;
    for (const auto& entry : fs::directory_iterator(session / "stimuli"))
        if (entry.path().extension() == ".png") {
            preview = entry.path();
            fs::remove(preview);
            fs::create_symlink(secret, preview);
        }
    REQUIRE_FALSE(preview.empty());
    REQUIRE(::mkfifo((session / "stimuli/pipe").c_str(), 0600) == 0);
    const fs::path dataset = experiment.folder().path() / "bids";
    const ProgramRun exported =
        experiment.overt({"export", session.string(), "--format", "bids", "--out", dataset.string()});
    INFO(exported.out << exported.err);
    CHECK(exported.exit_code == 0);
    CHECK_FALSE(any_file_has(dataset, "the secret"));
    const ProgramRun verified = experiment.overt({"verify", session.string()});
    CHECK(verified.exit_code == 1);
    CHECK_THAT(verified.out + verified.err, Contains("is a link") && Contains("stimuli/pipe: is no file"));
    // A picture that the manifest does not know is none of the session's, either.
    fs::remove(preview);
    std::ofstream(preview) << "another picture";
    const fs::path again = experiment.folder().path() / "again";
    REQUIRE(experiment.overt({"export", session.string(), "--format", "bids", "--out", again.string()})
                .exit_code == 0);
    CHECK_FALSE(any_file_has(again, "another picture"));
    fs::remove(session / "manifest.json");
    REQUIRE(::mkfifo((session / "manifest.json").c_str(), 0600) == 0);
    CHECK(experiment.overt({"verify", session.string()}).exit_code == 1);
}

TEST_CASE("frames that were swapped in the cache, or cut off, are made anew, and the record is of the pixels",
          "[session]") {
    const SmallExperiment experiment(Cache::own);
    const std::string first = frames_told_of(short_session(experiment));
    CHECK(first.size() == 4 * 65);
    const std::vector<fs::path> frames = cached_frames(experiment.cache());
    REQUIRE(frames.size() > 3);
    fs::rename(frames[0], frames[0].string() + ".kept");
    fs::rename(frames[1], frames[0]);
    fs::rename(frames[0].string() + ".kept", frames[1]);
    fs::resize_file(frames[2], fs::file_size(frames[2]) - 100);
    const ProgramRun second = experiment.run({"--trials", "3"});
    INFO(second.err);
    REQUIRE(second.exit_code == 0);
    CHECK_THAT(second.err, Contains(frames[0].string() + " is the frame at") &&
                               Contains(frames[2].string() + " is not whole: it was made anew"));
    CHECK(frames_told_of(experiment.session(2)) == first);
    CHECK_THAT(text_of(experiment.session() / "manifest.json"), Contains(first.substr(0, 64)));
    const overt::SessionRecord record(experiment.session());
    CHECK_THAT(record.header().stimuli.front().drawn_by, Contains("OpenGL"));
    CHECK(record.header().stimuli.front().made_from_sha256.size() == 64);
    // Nothing drew the frames of a session without pictures.
    REQUIRE(experiment.run({"--trials", "1", "--no-pictures"}).exit_code == 0);
    CHECK(frames_told_of(experiment.session(3)) == "\n\n\n\n");
}

TEST_CASE("analysis and export say when a session is not what was recorded", "[session]") {
    const SmallExperiment experiment;
    const fs::path session = short_session(experiment);
    const auto run = [&](const std::string& command, const std::string& out) {
        return experiment.overt(
            {command, session.string(), "--out", (experiment.folder().path() / out).string()});
    };
    CHECK_THAT(run("export", "sound").err, !Contains("overt verify"));
    {
        SQLite::Database database((session / "session.sqlite").string(), SQLite::OPEN_READWRITE);
        database.exec("UPDATE sample SET pupil_area = pupil_area + 1 WHERE n = 100");
    }
    CHECK_THAT(run("export", "tables").err, Contains("is not what was recorded") && Contains("table sample"));
    const ProgramRun analyzed = run("analyze", "analysis");
    CHECK_THAT(analyzed.err, Contains("is not what was recorded"));
    CHECK_THAT(text_of(experiment.folder().path() / "analysis/study.json"),
               Contains("is not what was recorded"));
}

TEST_CASE("control characters of a protocol do not reach the terminal", "[session]") {
    const SmallExperiment experiment(with(small_protocol, "title = \"A small experiment\"",
                                          "title = \"\\u001b[2J\\u0007gone\\u009b31m\""));
    const fs::path session = short_session(experiment);
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"check", experiment.protocol().string()},
          std::vector<std::string>{"analyze", session.string(), "--out",
                                   (experiment.folder().path() / "a").string()}}) {
        const ProgramRun run = experiment.overt(arguments);
        const std::string said = run.out + run.err;
        CHECK(said.find_first_of("\x1b\x07") == std::string::npos);
        CHECK(said.find("\xc2\x9b") == std::string::npos);
        CHECK_THAT(said, Contains("\\x1b[2J"));
    }
}

TEST_CASE("a library that a protocol names is not loaded, whatever it does", "[session]") {
    const SmallExperiment experiment(
        with(small_protocol, "[tracker]\n",
             fmt::format("[tracker]\nkind = \"lsl\"\nlibrary = \"{}\"\n", OVERT_FAKE_LIBLSL)));
    const ProgramRun named =
        experiment.overt({"tracker", "test", experiment.protocol().string(), "--seconds", "0.5"});
    CHECK(named.exit_code != 0);
    CHECK_THAT(named.err, Contains("is not loaded from here") && Contains("cannot be loaded"));
    const ProgramRun given = experiment.overt({"tracker", "test", experiment.protocol().string(), "--seconds",
                                               "0.5", "--library", std::string("lsl=") + OVERT_FAKE_LIBLSL});
    CHECK_THAT(given.err, !Contains("cannot be loaded"));
    const ProgramRun none = experiment.overt({"tracker", "list", "--library", "lsl=/nowhere/liblsl.so"});
    CHECK(none.exit_code == 2);
    CHECK_THAT(none.err, Contains("there is no such file"));
    CHECK_THAT(experiment.overt({"tracker", "list", "--library", "ls=/x"}).err,
               Contains("there is no library"));
}

TEST_CASE("objects of one mesh keep one file of it, and one of each map", "[session]") {
    const SmallExperiment experiment(
        with(small_protocol, "mesh = \"meshes/tall.ply\"", "mesh = \"meshes/bust.ply\""));
    const fs::path session = short_session(experiment);
    const overt::SessionRecord record(session);
    REQUIRE(record.header().objects.size() == 2);
    CHECK(record.header().objects[0].mesh_file == record.header().objects[1].mesh_file);
    std::set<std::string> maps;
    for (const overt::RecordedMap& map : record.header().maps)
        maps.insert(map.file);
    CHECK(2 * maps.size() == record.header().maps.size());
    CHECK(std::distance(fs::directory_iterator(session / "meshes"), fs::directory_iterator()) == 1);
    CHECK(experiment.overt({"verify", session.string()}).exit_code == 0);
    CHECK(experiment.overt({"show", session.string()}).exit_code == 0);
}

TEST_CASE("a session whose cache vanishes names itself and how to go on", "[session][waits]") {
    const SmallExperiment experiment(Cache::own);
    const fs::path said = experiment.folder().path() / "said.txt";
    RunningProgram program({"run", experiment.protocol().string(), "--simulate-observer", "5", "--observer",
                            "P01", "--context", "osmesa", "--seed", "7", "--sessions",
                            experiment.sessions().string()},
                           {"OVERT_CACHE=" + experiment.cache().string()}, said);
    while (program.is_running() && !fs::exists(experiment.session()))
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    fs::remove_all(experiment.cache() / "frames");
    CHECK(program.wait() != 0);
    const std::string words = text_of(said);
    INFO(words);
    CHECK_THAT(words, Contains("session: " + experiment.session().string()) && Contains("--resume") &&
                          Contains((experiment.cache() / "frames").string()));
    CHECK(experiment.overt({"verify", experiment.session().string()}).exit_code == 0);
}
