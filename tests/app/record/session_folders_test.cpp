/// Commands that are given folders in which sessions lie.
#include "app/inputs/session_folders.h"

#include <fstream>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/app/small_experiment.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// Where sessions would lie: to find them their contents do not matter.
struct Tree {
    TemporaryFolder root;
    fs::path at(const std::string& path) const { return root.path() / path; }
    explicit Tree(const std::vector<std::string>& sessions) {
        for (const std::string& session : sessions) {
            fs::create_directories(at(session));
            std::ofstream(at(session) / "session.sqlite") << "x";
        }
    }
    std::vector<std::string> found(const std::vector<std::string>& given) const {
        std::vector<fs::path> paths;
        for (const std::string& path : given)
            paths.push_back(at(path));
        std::vector<std::string> names;
        for (const fs::path& session : sessions_in(paths))
            names.push_back(session.lexically_normal().lexically_relative(root.path()).string());
        return names;
    }
};

using Names = std::vector<std::string>;

} // namespace

TEST_CASE("sessions are found in folders up to three levels above them, each once and in their order",
          "[unit]") {
    const Tree tree({"sessions/vases/sub-02_ses-01", "sessions/vases/sub-01_ses-01",
                     "sessions/busts/sub-01_ses-01", "sessions/vases/sub-01_ses-01/trackers/eye",
                     "sessions/vases/.sub-03_ses-01.partial-x", "lab/2026/sessions/vases/sub-09_ses-01"});
    const Names vases{"sessions/vases/sub-01_ses-01", "sessions/vases/sub-02_ses-01"};
    CHECK(tree.found({"sessions/vases"}) == vases);
    CHECK(tree.found({"sessions/vases/"}) == vases);
    CHECK(tree.found({"sessions"}) == Names{"sessions/busts/sub-01_ses-01", vases[0], vases[1]});
    CHECK(tree.found({"lab/2026"}) == Names{"lab/2026/sessions/vases/sub-09_ses-01"});
    // Four levels are too deep.
    CHECK_THROWS_AS(tree.found({"lab"}), InputError);
    // A session itself, the file in it, and a further tracker's record are what they are.
    CHECK(tree.found({"sessions/vases/sub-01_ses-01/trackers/eye"}) ==
          Names{"sessions/vases/sub-01_ses-01/trackers/eye"});
    CHECK(tree.found({"sessions/vases/sub-02_ses-01/session.sqlite"}).size() == 1);
    // Of a list that mixes both, each comes once, where it is named first.
    CHECK(tree.found(
              {"sessions/vases/sub-02_ses-01", "sessions", "sessions/vases/sub-02_ses-01/session.sqlite"}) ==
          Names{vases[1], "sessions/busts/sub-01_ses-01", vases[0]});
    // Who reads what is not there says so.
    CHECK(tree.found({"sessions/none"}) == Names{"sessions/none"});
    // Not in a circle, and not twice.
    fs::create_directory_symlink(tree.at("sessions"), tree.at("sessions/vases/all"));
    CHECK(tree.found({"sessions"}).size() == 3);
    CHECK_THROWS_AS(session_in(tree.at("sessions/vases")), InputError);
    CHECK(session_in(tree.at("sessions/busts")) == tree.at("sessions/busts/sub-01_ses-01"));
}

TEST_CASE("all folders without a session are named at once, with what was looked for", "[unit]") {
    const Tree tree({"sessions/vases/sub-01_ses-01"});
    fs::create_directories(tree.at("a"));
    fs::create_directories(tree.at("b/c"));
    try {
        tree.found({"a", "sessions", "b"});
        FAIL("nothing was refused");
    } catch (const InputError& error) {
        const std::string said = error.what();
        CHECK_THAT(said, Contains((tree.at("a")).string()) && Contains(tree.at("b").string()));
        CHECK_THAT(said, Contains("session.sqlite") && Contains("3 levels"));
    }
}

TEST_CASE("analyze, export, verify and show take the folder that an experiment's sessions lie in",
          "[session]") {
    const SmallExperiment experiment;
    REQUIRE(experiment.run({"--trials", "2", "--no-pictures"}).exit_code == 0);
    REQUIRE(experiment.run({"--trials", "2", "--no-pictures"}).exit_code == 0);
    const std::string folder = experiment.session(1).parent_path().string();
    const fs::path out = experiment.folder().path();

    const ProgramRun shown = experiment.overt({"show", folder});
    CHECK(shown.exit_code == 0);
    CHECK_THAT(shown.err, Contains("2 sessions: sub-P01_ses-01, sub-P01_ses-02"));
    CHECK_THAT(shown.out, Contains("session 1, seed") && Contains("session 2, seed"));
    const ProgramRun verified = experiment.overt({"verify", experiment.sessions().string()});
    CHECK(verified.exit_code == 0);
    CHECK_THAT(verified.out, Contains("sub-P01_ses-01: sound") && Contains("sub-P01_ses-02: sound"));
    REQUIRE(experiment.overt({"export", folder, "--out", (out / "tables").string()}).exit_code == 0);
    CHECK(fs::exists(out / "tables/sub-P01_ses-01/trials.tsv"));
    CHECK(fs::exists(out / "tables/sub-P01_ses-02/trials.tsv"));
    const ProgramRun analyzed =
        experiment.overt({"analyze", folder, "--format", "tsv", "--out", (out / "analysis").string()});
    INFO(analyzed.err);
    CHECK(analyzed.exit_code == 0);
    CHECK_THAT(analyzed.err, Contains("2 sessions"));
    for (const char* const command : {"analyze", "export", "verify", "show", "replay"}) {
        CAPTURE(command);
        fs::create_directories(out / "empty");
        const ProgramRun none = experiment.overt({command, (out / "empty").string()});
        CHECK(none.exit_code == 2);
        CHECK_THAT(none.err, Contains("holds no session") && Contains("session.sqlite"));
    }
    const ProgramRun picture = experiment.overt({"show", folder, "--plot", (out / "plot.svg").string()});
    CHECK(picture.exit_code == 2);
    CHECK_THAT(picture.err, Contains("--plot is of one session"));
}
