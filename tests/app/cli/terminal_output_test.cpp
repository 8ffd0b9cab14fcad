/// What becomes of a command whose output cannot be written.
#include <catch2/catch.hpp>

#include "experiment/record/read/session_record.h"
#include "tests/app/small_experiment.h"

using namespace overt;
using namespace overt::test;

namespace {

/// A command with its output led elsewhere, as the shell's words in `redirections` say; the program's exit
/// code.
int exit_code_of(const SmallExperiment& experiment, const std::vector<std::string>& arguments,
                 const std::string& redirections) {
    std::string command =
        "OVERT_CACHE=" + quoted_for_shell(experiment.cache().string()) + " " + OVERT_PROGRAM;
    for (const std::string& argument : arguments)
        command += " " + quoted_for_shell(argument);
    const TemporaryFolder folder;
    const std::string code = (folder.path() / "code").string();
    REQUIRE(std::system(("{ " + command + "; echo $? >" + code + "; } </dev/null " + redirections).c_str()) !=
            -1);
    return std::stoi("0" + text_of(code));
}

} // namespace

TEST_CASE("a session goes on without its terminal, whatever became of it", "[session]") {
    const SmallExperiment experiment;
    int number = 0;
    for (const std::string redirections :
         {">/dev/full 2>&1", ">&- 2>&-", ">/dev/null 2>/dev/full", "2>&1 | true", "2>/dev/null >&-"}) {
        CAPTURE(redirections);
        CHECK(exit_code_of(experiment,
                           {"run", experiment.protocol().string(), "--observer", "P01", "--simulate-observer",
                            "5", "--virtual-time", "--context", "osmesa", "--seed", "7", "--trials", "2",
                            "--sessions", experiment.sessions().string()},
                           redirections) == 0);
        const SessionRecord record(experiment.session(++number));
        CHECK(record.is_complete());
        CHECK(record.closed_in_order());
    }
}

TEST_CASE("what was called for its output and cannot write it has failed", "[session]") {
    const SmallExperiment experiment;
    const std::vector<std::string> check{"check", experiment.protocol().string()};
    CHECK(exit_code_of(experiment, check, ">/dev/null 2>&1") == 0);
    CHECK(exit_code_of(experiment, check, ">/dev/full 2>/dev/null") == 1);
    CHECK(exit_code_of(experiment, check, "2>/dev/full >/dev/null") == 0);
    CHECK(exit_code_of(experiment, {"schema"}, ">/dev/full 2>/dev/null") == 1);
    // Bad input stays bad input.
    CHECK(exit_code_of(experiment, {"check", "not_there.toml"}, ">/dev/full 2>/dev/full") == 2);
}

TEST_CASE("a reader that has read enough ends no command with an error", "[session]") {
    const SmallExperiment experiment;
    REQUIRE(experiment.run({"--trials", "2"}).exit_code == 0);
    const std::string session = experiment.session().string(), protocol = experiment.protocol().string();
    const TemporaryFolder folder;
    const std::string out = (folder.path() / "out").string(), said = (folder.path() / "said").string();
    for (const std::vector<std::string>& call : std::vector<std::vector<std::string>>{
             {"check", protocol},
             {"check", protocol, "--all-observers", "--json"},
             {"schema"},
             {"show", session},
             {"show", session, "--json"},
             {"show", session, "--order"},
             {"verify", session, "--json"},
             {"export", session, "--out", out + "/tables"},
             {"analyze", session, "--out", out + "/analysis", "--resamples", "100", "--permutations", "100"},
             {"tracker", "list"},
             {"tracker", "show", session, "--json"},
             {"bake", protocol, "--quality", "preview", "--dry-run"},
             {"completion", "bash"},
             {"help", "run"},
             {"run", "--help"},
             {"--version"}}) {
        CAPTURE(call);
        // The reader is gone before the first word, and after it.
        for (const char* reader : {"true", "head -c 1"}) {
            CHECK(exit_code_of(experiment, call, "2>" + said + " | " + reader + " >/dev/null") == 0);
            CHECK(text_of(said).find("output") == std::string::npos);
            std::filesystem::remove_all(out);
        }
    }
    CHECK(exit_code_of(experiment, {"check", "not_there.toml"}, "2>/dev/null | true") == 2);
}
