/// Sessions whose trials come from a rule, a table and a draw, by the commands that a user types.
#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>
#include <set>

#include "experiment/record/read/session_record.h"
#include "tests/app/session/interrupted_run.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

/// Pairs of materials side by side with catch trials, and before them two rows of a table as practice.
std::string pairs_and_table() {
    std::string text(small_protocol);
    text.erase(text.find("[[task]]"));
    return text + R"(
[[slot]]
id = "left"
right_deg = -3
size_deg = 5

[[slot]]
id = "right"
right_deg = 3
size_deg = 5

[[task]]
id = "glossier"
question = "Which is glossier?"
slots = ["left", "right"]
trials = { rule = "pairs", of = "material", side = "crossed" }
catch = { trials = "obvious.csv", count = 1 }

[[task]]
id = "warm"
question = "Which is warmer?"
slots = ["left", "right"]
trials = "lists/warm.tsv"

[[block]]
id = "first"
tasks = "warm"
practice = true

[[block]]
id = "proper"
tasks = "glossier"
max_run = { side = 1 }
)";
}

void write_tables(const SmallExperiment& experiment) {
    const std::filesystem::path folder = experiment.folder().path();
    std::filesystem::create_directories(folder / "lists");
    std::ofstream(folder / "obvious.csv") << "left,right,correct\nbust/matt,tall/smooth,right\n";
    std::ofstream(folder / "lists/warm.tsv")
        << "object\tleft.material\tright.material\tease\nbust\tmatt\tsmooth\t0.5\ntall\tsmooth\tmatt\t1\n";
}

} // namespace

TEST_CASE("trials of a rule and of a table are run, killed, resumed, replayed, exported and analysed",
          "[session]") {
    const SmallExperiment experiment(pairs_and_table());
    write_tables(experiment);
    const ProgramRun check = experiment.overt({"check", experiment.protocol().string()});
    CAPTURE(check.out, check.err);
    REQUIRE(check.exit_code == 0);
    CHECK_THAT(check.out, Contains("first, warm: 2 trials") && Contains("the 2 rows of warm.tsv") &&
                              Contains("proper, glossier: 5 trials") && Contains("sides crossed"));

    const std::vector<std::string> arguments = run_arguments(experiment, "P01", {"--virtual-time"});
    REQUIRE(run_and_kill(experiment, arguments,
                         [&] { return attempts_so_far(experiment.session()).size() >= 4; }));
    std::vector<std::string> again = arguments;
    again.insert(again.end(), {"--resume", "redo"});
    const ProgramRun resumed = experiment.overt(again);
    CAPTURE(resumed.out, resumed.err);
    REQUIRE(resumed.exit_code == 0);

    const std::string session = experiment.session().string();
    const SessionRecord record(session);
    CHECK(record.is_complete());
    const std::vector<Trial>& planned = record.header().schedule.trials;
    REQUIRE(planned.size() == 7);
    CHECK(std::ranges::count(planned, TrialRole::practice, &Trial::role) == 2);
    CHECK(std::ranges::count(planned, TrialRole::catch_trial, &Trial::role) == 1);
    int with_gaze = 0;
    for (const TrialRecord& attempt : record.trials()) {
        CHECK(attempt.trial == planned[static_cast<std::size_t>(attempt.trial.index)]);
        if (attempt.counts && attempt.trial.role == TrialRole::practice)
            with_gaze += record.sample_span(attempt).has_value();
    }
    CHECK(with_gaze == 2);
    std::set<std::string> kept;
    for (const RecordedProtocol::Included& file : record.header().protocol.included)
        kept.insert(file.name);
    CHECK(kept == std::set<std::string>{"lists/warm.tsv", "obvious.csv"});

    // From here on only the record is there.
    std::filesystem::remove_all(experiment.folder().path() / "lists");
    CHECK(experiment.overt({"verify", session}).exit_code == 0);
    CHECK_THAT(experiment.overt({"show", session, "--order"}).out, Contains("seed 7: the same"));
    const ProgramRun replay = experiment.overt({"replay", session});
    CAPTURE(replay.out, replay.err);
    CHECK(replay.exit_code == 0);

    const std::filesystem::path tables = experiment.folder().path() / "tables";
    REQUIRE(experiment.overt({"export", session, "--out", tables.string()}).exit_code == 0);
    const TsvFile trials(tables / "trials.tsv");
    int practice = 0, checks = 0;
    for (std::size_t i = 0; i < trials.size(); ++i) {
        if (trials.text(i, "role") == "practice") {
            ++practice;
            CHECK((trials.text(i, "ease") == "0.5" || trials.text(i, "ease") == "1"));
            CHECK_FALSE(trials.has(i, "side"));
        } else if (trials.text(i, "role") == "catch") {
            checks += trials.text(i, "counts") == "yes";
            CHECK(trials.text(i, "correct") == "right");
        } else {
            CHECK((trials.text(i, "side") == "left" || trials.text(i, "side") == "right"));
        }
    }
    CHECK(practice >= 2);
    CHECK(checks == 1);

    // Results are of the four pairs, in both of their slots.
    const std::filesystem::path study = experiment.folder().path() / "study";
    const ProgramRun analysis =
        experiment.overt({"analyze", session, "--by", "side", "--format", "tsv", "--out", study.string()});
    CAPTURE(analysis.out, analysis.err);
    REQUIRE(analysis.exit_code == 0);
    CHECK(TsvFile(study / "trials.tsv").size() == 2 * 4);
}

TEST_CASE("a protocol whose table is wrong runs no session, and says all that is wrong with it",
          "[session]") {
    const SmallExperiment experiment(pairs_and_table());
    write_tables(experiment);
    std::ofstream(experiment.folder().path() / "obvious.csv")
        << "left,right,corect\nbust/mat,tall/smooth,right\n,,left\nbust/matt,right\n";
    const ProgramRun run = experiment.run();
    CHECK(run.exit_code == 2);
    CHECK_THAT(run.err, Contains("obvious.csv:4:1: error: 2 cells in this row, 3 in the header"));
    std::ofstream(experiment.folder().path() / "obvious.csv")
        << "left,right,corect\nbust/mat,tall/smooth,right\n,,left\n";
    const ProgramRun other = experiment.run();
    CHECK(other.exit_code == 2);
    CHECK_THAT(other.err, Contains("obvious.csv:1:12: error: unknown column \"corect\"") &&
                              Contains("obvious.csv:2:1: error: there is no material \"mat\"") &&
                              Contains("obvious.csv:3:1: error: all slots stay empty in this row") &&
                              Contains("did you mean \"correct\""));
    CHECK_FALSE(std::filesystem::exists(experiment.sessions()));
}
