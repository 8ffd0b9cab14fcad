/// The observer's form outside of the window.
#include "app/session/observer_questions.h"

#include <sstream>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/record/read/session_record.h"
#include "tests/app/small_experiment.h"
#include "tests/support/observer_fields.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

const std::string form = R"(
[[observer_field]]
id = "age"
[[observer_field]]
id = "handedness"
[[observer_field]]
id = "remark"
required = false
)";

} // namespace

TEST_CASE("values given on the command line are checked, and a wrong one is refused with the remedy",
          "[unit]") {
    const auto fields = three_observer_fields("remark");
    const std::vector<std::string> right{"handedness = left", "age=31", "remark=a=b"};
    CHECK(values_given(fields, right) == FieldValues{"31", "left", "a=b"});
    const auto refusal = [&](std::vector<std::string> given) -> std::string {
        try {
            values_given(fields, given);
        } catch (const InputError& error) {
            return error.what();
        }
        return {};
    };
    CHECK_THAT(refusal({"age"}), Contains("ID=VALUE"));
    CHECK_THAT(refusal({"size=31"}), Contains("there are: age, handedness, remark"));
    CHECK_THAT(refusal({"age=310"}), Contains("0 … 120"));
    CHECK_THAT(refusal({"age=31", "age=32"}), Contains("twice"));
}

TEST_CASE("the terminal asks for what is missing, again until it may stand", "[unit]") {
    const auto fields = three_observer_fields("remark");
    FieldValues values{"", "left", ""};
    std::istringstream from("abc\n\n 44 \n\n");
    std::ostringstream to;
    ask_for_values(fields, values, from, to);
    CHECK(values == FieldValues{"44", "left", ""});
    CHECK_THAT(to.str(), Contains("Age in years (a number, 0 … 120): "));
    CHECK_THAT(to.str(), Contains("\"abc\" is not a number"));
    CHECK_THAT(to.str(), Contains("may be left empty"));
    CHECK_THAT(to.str(), !Contains("Handedness"));
    FieldValues none(3);
    std::istringstream ended("31\n");
    CHECK_THROWS_AS(ask_for_values(fields, none, ended, to), InputError);
}

TEST_CASE("a session records the form: what was given, and the rest from the simulated observer's seed",
          "[session]") {
    const SmallExperiment experiment(
        std::string(small_protocol) + form +
        "[[block]]\nid = \"only\"\n"
        "[[observer_field]]\nid = \"effort\"\nkind = \"scale\"\nsteps = 5\n"
        "ends = [\"none\", \"much\"]\nwhen = \"block:only\"\n"
        "[[observer_field]]\nid = \"guess\"\nrequired = false\nwhen = \"end\"\n");
    const ProgramRun run =
        experiment.run({"--trials", "1", "--observer-field", "age=31", "--observer-field", "guess=gloss"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const SessionRecord record(experiment.session());
    const auto fields = record.observer_fields();
    REQUIRE(fields.size() == 5);
    CHECK(fields[0].id == "age");
    CHECK(fields[0].title == "Age in years");
    CHECK(fields[0].value == "31");
    CHECK(fields[1].value == simulated_value(three_observer_fields("remark")[1], 5));
    // Later parts come later: after the block's only trial, and at the end.
    CHECK(fields[0].asked == "begin");
    CHECK(fields[3].asked == "block:only");
    CHECK(fields[3].value.size() == 1);
    CHECK(fields[4].asked == "end");
    CHECK(fields[4].value == "gloss");
    const std::vector<TrialRecord> trials = record.trials();
    REQUIRE(trials.size() == 1);
    CHECK(fields[0].at < trials[0].started);
    CHECK(fields[3].at > trials[0].started);
    CHECK(fields[4].at >= fields[3].at);
}

TEST_CASE("without the required fields and somebody to ask, a session is refused and leaves nothing",
          "[session]") {
    const SmallExperiment experiment(std::string(small_protocol) + form);
    const ProgramRun run = experiment.overt(
        {"run", experiment.protocol().string(), "--observer", "P01", "--ask-at", "nobody", "--sessions",
         experiment.sessions().string(), "--observer-field", "handedness=left"});
    CHECK(run.exit_code == 2);
    CHECK_THAT(run.err, Contains("--observer-field age="));
    CHECK_THAT(run.err, !Contains("--observer-field handedness="));
    CHECK_FALSE(std::filesystem::exists(experiment.sessions()));
}
