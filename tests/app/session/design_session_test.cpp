/// Blocks, practice, breaks, repeated trials and included files through the program.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "experiment/record/read/session_record.h"
#include "tests/app/small_experiment.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

/// The small experiment in two blocks, its rig in a file of its own.
std::string blocked_protocol() {
    std::string text(small_protocol);
    const std::size_t begin = text.find("[tracker]"), end = text.find("[view]");
    text.erase(begin, end - begin);
    return "include = \"rig/tracker.toml\"\n" + text + R"(
[[block]]
id = "asked"
tasks = ["face", "clothes"]
order = "blocked"
by = "task"
instructions = "First, questions."
max_object_run = 1

[[block]]
id = "free"
tasks = "free"

[[practice]]
task = "face"
object = "tall"
material = "matt"
feedback = "Well done."

[breaks]
between_blocks = true
pace = "timed"
duration_s = 20

[repeat]
missed_refreshes = "end-of-block"
)";
}

void write_rig(const SmallExperiment& experiment) {
    std::filesystem::create_directories(experiment.folder().path() / "rig");
    std::ofstream(experiment.folder().path() / "rig/tracker.toml") << "[tracker]\nrate_hz = 1000\n";
}

} // namespace

TEST_CASE(
    "a session in blocks is recorded as it was planned, and its order can be made again from the record",
    "[session]") {
    const SmallExperiment experiment(blocked_protocol());
    write_rig(experiment);
    const ProgramRun run = experiment.run();
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const SessionRecord record(experiment.session());
    CHECK(record.damages() == std::vector<std::string>{});
    CHECK(record.header().blocks == std::vector<std::string>{"asked", "free"});
    REQUIRE(record.trials().size() == small_trials);
    for (std::size_t i = 0; i < record.trials().size(); ++i) {
        CHECK(record.trials()[i].trial == record.header().schedule.trials[i]);
        CHECK(record.trials()[i].trial.block == (i < 8 ? 0 : 1));
    }
    REQUIRE(record.header().protocol.included.size() == 1);
    CHECK(record.header().protocol.included[0].name == "rig/tracker.toml");
    CHECK(std::filesystem::exists(experiment.session() / "rig/tracker.toml"));
    int practice = 0, breaks = 0;
    for (const RecordedEvent& event : record.events()) {
        practice += event.kind == "practice" || event.kind == "practice answered";
        breaks += event.kind == "break begins" || event.kind == "break ends";
    }
    CHECK(practice == 2);
    CHECK(breaks == 2);

    const std::string session = experiment.session().string();
    const ProgramRun again = experiment.overt({"show", session, "--order"});
    CHECK(again.exit_code == 0);
    CHECK_THAT(again.out, Contains("made again from the recorded protocol and seed 7: the same") &&
                              Contains("block asked"));
    CHECK(experiment.overt({"show", session, "--order", "--json"}).out.find("\"comes_out_the_same\": true") !=
          std::string::npos);
    // What check shows before, for the same seed, is what was done.
    const ProgramRun before = experiment.overt(
        {"check", experiment.protocol().string(), "--observer", "P01", "--seed", "7", "--json"});
    INFO(before.err);
    const auto json = nlohmann::json::parse(before.out);
    const auto& order = json["design"]["orders"][0]["trials"];
    REQUIRE(order.size() == small_trials);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const Trial& trial = record.trials()[i].trial;
        CHECK(order[i]["task"] == record.header().tasks[static_cast<std::size_t>(trial.task)].id);
        CHECK(order[i]["block"] == (i < 8 ? "asked" : "free"));
        CHECK(order[i]["object"] ==
              record.header().objects[static_cast<std::size_t>(trial.stimulus.object)].id);
        CHECK(order[i]["material"] ==
              record.header().materials[static_cast<std::size_t>(trial.stimulus.material)].id);
    }
    CHECK(json["design"]["session"]["breaks_s"] == 20.0);
    CHECK(json["design"]["practice_trials"] == 1);
}

TEST_CASE(
    "a trial that missed refreshes comes again at the end of its block, and only that attempt is exported",
    "[session]") {
    const SmallExperiment experiment(blocked_protocol());
    write_rig(experiment);
    // It strikes each attempt at the second trial: the third is the last, and counts.
    const std::string faults =
        experiment.folder()
            .file("faults.toml", "[[fault]]\nkind = \"skip\"\nrefreshes = 2\nrefresh = 40\n"
                                 "trial = 2\n")
            .string();
    const ProgramRun run = experiment.run({"--faults", faults});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const SessionRecord record(experiment.session());
    REQUIRE(record.trials().size() == small_trials + 2);
    std::vector<int> order;
    for (const TrialRecord& trial : record.trials())
        order.push_back(trial.trial.index);
    CHECK(order == std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 1, 1, 8, 9});
    CHECK(record.trials()[1].status == TrialRecord::Status::aborted);
    CHECK(record.trials()[1].outcome.missed_refreshes == 2);
    CHECK(record.trials()[8].status == TrialRecord::Status::aborted);
    CHECK(record.trials()[9].status == TrialRecord::Status::completed);
    CHECK(record.trials()[9].attempt == 3);
    CHECK(record.trials()[9].trial.block == 0);

    const std::filesystem::path tables = experiment.folder().path() / "tables";
    REQUIRE(experiment.overt({"export", experiment.session().string(), "--out", tables.string()}).exit_code ==
            0);
    const TsvFile trials(tables / "trials.tsv");
    REQUIRE(trials.size() == small_trials + 2);
    CHECK(trials.text(1, "status") == "aborted");
    CHECK(trials.text(1, "failure") == "missed refreshes");
    CHECK(trials.text(1, "comes_again") == "end-of-block");
    CHECK(trials.integer(1, "missed_refreshes") == 2);
    CHECK(trials.text(1, "responded_s") != "n/a");
    CHECK(trials.text(1, "samples") == "n/a");
    CHECK(trials.text(0, "failure") == "n/a");
    CHECK(trials.text(0, "comes_again") == "never");
    CHECK(trials.text(9, "counts") == "yes");
    CHECK(trials.text(9, "failure") == "missed refreshes");
    CHECK(trials.text(1, "block") == "asked");
    CHECK(trials.text(11, "block") == "free");
}

TEST_CASE("a new protocol passes the check at once, and is not written over another", "[session]") {
    const SmallExperiment experiment(small_protocol, lasting_cache());
    const std::string file = (experiment.folder().path() / "a study.toml").string();
    CHECK(experiment.overt({"new", file}).exit_code == 0);
    const std::string text = text_of(file);
    CHECK_THAT(text, Contains("name = \"a_study\""));
    const ProgramRun check = experiment.overt({"check", file, "--all-observers"});
    CHECK(check.err == "");
    CHECK(check.exit_code == 0);
    const ProgramRun again = experiment.overt({"new", file});
    CHECK(again.exit_code == 2);
    CHECK_THAT(again.err, Contains("exists already"));
    CHECK(text_of(file) == text);
    CHECK(experiment.overt({"new", experiment.folder().path().string() + "/none/x.toml"}).exit_code == 2);
    const ProgramRun schema = experiment.overt({"schema"});
    CHECK(schema.exit_code == 0);
    CHECK(nlohmann::json::parse(schema.out)["title"] == "overt protocol");
}

TEST_CASE(
    "lights, a series and columns go from the protocol through order, record and tables to the analysis",
    "[session]") {
    std::string text(small_protocol);
    const std::size_t view = text.find("[view]");
    text.insert(view, "[[light]]\nid = \"sky\"\n[[light]]\nid = \"hall\"\nprobe = \"gallery\"\n");
    text += "\n[[block]]\nid = \"all\"\ntasks = \"face\"\norder = \"blocked\"\nby = \"light\"\n"
            "max_run = { look = 2 }\n";
    const std::size_t matt = text.find("[[material]]");
    text.insert(text.find('\n', matt) + 1, "columns = { look = \"one\" }\n");
    const SmallExperiment experiment(text);
    const ProgramRun run = experiment.run();
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const SessionRecord record(experiment.session());
    CHECK(record.damages() == std::vector<std::string>{});
    REQUIRE(record.trials().size() == 8);
    for (std::size_t i = 0; i < record.trials().size(); ++i)
        CHECK(record.trials()[i].trial == record.header().schedule.trials[i]);
    CHECK(record.trials()[0].trial.stimulus.light == record.trials()[3].trial.stimulus.light);
    CHECK(record.trials()[0].trial.stimulus.light != record.trials()[4].trial.stimulus.light);

    const ProgramRun exported =
        experiment.overt({"export", experiment.session().string(), "--format", "tsv"});
    INFO(exported.err);
    REQUIRE(exported.exit_code == 0);
    const ProgramRun shown = experiment.overt({"show", experiment.session().string(), "--order"});
    CHECK(shown.exit_code == 0);
    CHECK_THAT(shown.out, Contains("hall") && Contains("the same"));
    const auto out = experiment.folder().path() / "analysis";
    const ProgramRun analyzed = experiment.overt({"analyze", experiment.session().string(), "--by",
                                                  "light,look", "--compare", "light", "--out", out.string()});
    INFO(analyzed.err);
    CHECK(analyzed.exit_code == 0);
    const ProgramRun refused = experiment.overt(
        {"analyze", experiment.session().string(), "--by", "motion", "--out", (out / "x").string()});
    CHECK(refused.exit_code == 2);
}
