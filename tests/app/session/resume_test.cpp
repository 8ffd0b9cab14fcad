/// Interrupted sessions taken up again, by each policy, and those that are not.
#include "experiment/ports/event_kinds.h"
#include "tests/app/session/interrupted_run.h"

#include <fmt/format.h>

#include "experiment/record/manifest.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

/// Two blocks of two trials, and animations that last long enough for a trial to be seen while it runs, in
/// virtual time, too.
std::string two_blocks() {
    return with(small_protocol, "duration_s = 1", "duration_s = 20") + R"(
[[block]]
id = "first"
tasks = ["face"]
materials = ["smooth"]

[[block]]
id = "second"
tasks = ["clothes"]
materials = ["matt"]

[consent]
text = "Do you want to take part?"

[[observer_field]]
id = "age"
kind = "number"

[[practice]]
task = "face"
object = "bust"
material = "matt"
)";
}

ProgramRun resume(const SmallExperiment& experiment, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = run_arguments(experiment, "P01", {"--virtual-time"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return experiment.overt(arguments);
}

std::string story(const SessionRecord& record) {
    std::string story;
    for (const TrialRecord& attempt : record.trials())
        story += fmt::format("{}{}{} ", attempt.trial.index + 1,
                             std::string(name_of(attempt.status)).substr(0, 1), attempt.counts ? "+" : "-");
    return story;
}

int count_of(const SessionRecord& record, std::string_view kind) {
    int count = 0;
    for (const RecordedEvent& event : record.events())
        count += event.kind == kind;
    return count;
}

} // namespace

TEST_CASE("an interrupted trial is done again, and the session is as planned", "[session]") {
    const SmallExperiment experiment(two_blocks());
    make_interrupted_session(experiment, 1);
    const SessionTime last = SessionRecord(experiment.session()).last_time();
    const ProgramRun run = resume(experiment, {"--resume"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("resuming session 1 of observer P01"));
    CHECK_THAT(run.out, Contains("1 of 4 trials are done; trial 2 was interrupted, and is done again"));
    CHECK_THAT(run.out, Contains("4 of 4 trials completed"));
    const SessionRecord record(experiment.session());
    CHECK(story(record) == "1c+ 2i- 2c+ 3c+ 4c+ ");
    CHECK(record.is_complete());
    CHECK(is_the_plan(record));
    CHECK(record.trials()[2].attempt == 2);
    CHECK(record.trials()[2].sitting == 2);
    // The clock goes on, and what was lost at the end still fits before.
    CHECK(record.trials()[2].started > last + std::chrono::milliseconds(250));
    // What was asked and practised before is not asked and practised again.
    CHECK(count_of(record, practice_answered_event) == 1);
    CHECK(record.consents().size() == 1);
    CHECK(record.observer_fields().size() == 1);

    const ProgramRun again = resume(experiment, {"--resume"});
    CHECK(again.exit_code == 2);
    CHECK_THAT(again.err, Contains("no session was interrupted: 1 is complete"));
    const ProgramRun by_number = resume(experiment, {"--resume", "--session", "1"});
    CHECK(by_number.exit_code == 2);
    CHECK_THAT(by_number.err, Contains("this session is complete"));
    CHECK_THAT(resume(experiment, {"--resume", "--session", "7"}).err, Contains("there is no session 7"));
}

TEST_CASE("a new session names those that were interrupted", "[session]") {
    const SmallExperiment experiment(two_blocks());
    make_interrupted_session(experiment, 1);
    const ProgramRun second = resume(experiment, {"--trials", "1"});
    CHECK(second.exit_code == 0);
    CHECK_THAT(second.err, Contains("session 1 was interrupted") && Contains("--resume --session 1"));
    CHECK(resume(experiment, {"--resume", "--session", "1"}).exit_code == 0);
    const ProgramRun third = resume(experiment, {"--trials", "1"});
    CHECK(third.exit_code == 0);
    CHECK_THAT(third.err, !Contains("was interrupted"));
    CHECK_THAT(third.err,
               Contains("this is session 3 of observer P01; session 1 is complete, session 2 is complete") &&
                   Contains("--resume"));
    // It is on record, and a replay, whose session is the only one there, is the same without it.
    const SessionRecord record(experiment.session(3));
    CHECK(count_of(record, earlier_sessions_event) == 1);
    CHECK(count_of(SessionRecord(experiment.session(1)), earlier_sessions_event) == 0);
    const ProgramRun replay = experiment.overt({"replay", experiment.session(3).string()});
    INFO(replay.out << replay.err);
    CHECK(replay.exit_code == 0);
}

TEST_CASE("an observer whose label is nearly another's is asked after before a session begins", "[session]") {
    const SmallExperiment experiment;
    const auto run_as = [&](const std::string& label, std::vector<std::string> more) {
        more.insert(more.end(), {"--trials", "1", "--no-pictures", "--observer", label});
        return experiment.run(more);
    };
    REQUIRE(run_as("1", {}).exit_code == 0);
    const ProgramRun refused = run_as("01", {});
    CHECK(refused.exit_code == 2);
    CHECK_THAT(refused.err, Contains("--observer 1") && Contains("--another-person"));
    CHECK_FALSE(std::filesystem::exists(experiment.session(1, "01")));
    const ProgramRun other = run_as("01", {"--another-person"});
    INFO(other.err);
    CHECK(other.exit_code == 0);
    CHECK(std::filesystem::exists(experiment.session(1, "01")));
    // Nothing is asked of who has sessions, nor of anybody else.
    CHECK(run_as("01", {}).exit_code == 0);
    CHECK(run_as("2", {}).exit_code == 0);
}

TEST_CASE("an interrupted trial can be skipped, which is recorded", "[session]") {
    const SmallExperiment experiment(two_blocks());
    make_interrupted_session(experiment, 1);
    const ProgramRun run = resume(experiment, {"--resume", "skip"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("trial 2 was interrupted, and is skipped"));
    const SessionRecord record(experiment.session());
    CHECK(story(record) == "1c+ 2i- 3c+ 4c+ ");
    CHECK(record.skipped_trials() == std::vector<int>{1});
    CHECK(record.is_complete());
}

TEST_CASE("the block of an interrupted trial can begin again, and earlier attempts no longer count",
          "[session]") {
    const SmallExperiment experiment(two_blocks());
    make_interrupted_session(experiment, 3);
    const ProgramRun run = resume(experiment, {"--resume", "restart-block"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("a block of 2 trials begins again"));
    CHECK_THAT(run.out, Contains("4 of 4 trials completed"));
    const SessionRecord record(experiment.session());
    CHECK(story(record) == "1c+ 2c+ 3c- 4i- 3c+ 4c+ ");
    CHECK_THAT(experiment.overt({"show", experiment.session().string()}).out,
               Contains(" superseded ") && Contains(" interrupted "));
    CHECK(is_the_plan(record));
    CHECK(record.is_complete());

    // Exports say which attempt counts, and have rows of those alone.
    const fs::path tables = experiment.folder().path() / "tables";
    REQUIRE(experiment.overt({"export", experiment.session().string(), "--out", tables.string()}).exit_code ==
            0);
    const TsvFile trials(tables / "trials.tsv");
    std::string counts;
    for (std::size_t row = 0; row < trials.size(); ++row)
        counts += trials.text(row, "counts") + " ";
    CHECK(counts == "yes yes no no yes yes ");
    CHECK(TsvFile(tables / "responses.tsv").size() == 4);
}

TEST_CASE("a session does not go on with what it was not begun with", "[session]") {
    const SmallExperiment experiment(two_blocks());
    CHECK(resume(experiment, {"--resume"}).exit_code == 2);
    make_interrupted_session(experiment, 0);

    std::vector<std::string> arguments = run_arguments(experiment, "P01", {"--virtual-time", "--resume"});
    std::replace(arguments.begin(), arguments.end(), std::string("7"), std::string("8"));
    const ProgramRun seed = experiment.overt(arguments);
    CHECK(seed.exit_code == 2);
    CHECK_THAT(seed.err, Contains("this session has the seed 7"));

    const ProgramRun clock = experiment.overt(run_arguments(experiment, "P01", {"--resume"}));
    CHECK(clock.exit_code == 2);
    CHECK_THAT(clock.err, Contains("begun with --virtual-time"));

    const ProgramRun new_one = resume(experiment, {"--session", "1"});
    CHECK(new_one.exit_code == 2);
    CHECK_THAT(new_one.err, Contains("next free session number is 2") && Contains("--resume"));

    experiment.folder().file("small.toml", with(two_blocks(), "A small experiment", "Another experiment"));
    const ProgramRun text = resume(experiment, {"--resume"});
    CHECK(text.exit_code == 2);
    CHECK_THAT(text.err, Contains("the protocol has changed") && Contains("sub-P01_ses-01/protocol.toml"));
    CHECK(SessionRecord(experiment.session()).trials().size() == 1);
}

TEST_CASE("imported sessions and copies with imported gaze are not gone on with, and it is said why",
          "[session]") {
    const SmallExperiment experiment(with(small_protocol, "duration_s = 1", "duration_s = 20"));
    make_interrupted_session(experiment, 1);
    const fs::path asc = experiment.folder().path() / "asc";
    REQUIRE(
        experiment.overt({"export", experiment.session().string(), "--format", "asc", "--out", asc.string()})
            .exit_code == 0);
    fs::path recording;
    for (const auto& entry : fs::directory_iterator(asc))
        if (entry.path().extension() == ".asc")
            recording = entry.path();
    const ProgramRun into =
        experiment.overt({"import", recording.string(), "--into", experiment.session().string(), "--out",
                          experiment.session(2).string()});
    INFO(into.err);
    REQUIRE(into.exit_code == 0);
    const ProgramRun copy = resume(experiment, {"--resume", "--session", "2"});
    CHECK(copy.exit_code == 2);
    CHECK_THAT(copy.err, Contains("a copy of a session, with the gaze of " + recording.filename().string()) &&
                             Contains("Go on with the session itself"));
    REQUIRE(experiment
                .overt({"import", recording.string(), "--observer", "P01", "--task", "small", "--sessions",
                        experiment.sessions().string()})
                .exit_code == 0);
    const ProgramRun imported = resume(experiment, {"--resume", "--session", "3"});
    CHECK(imported.exit_code == 2);
    CHECK_THAT(imported.err, Contains("imported from " + recording.filename().string()) &&
                                 Contains("nothing to go on with"));
    for (const int number : {2, 3})
        CHECK(experiment.overt({"verify", experiment.session(number).string()}).exit_code == 0);
    const ProgramRun original = resume(experiment, {"--resume", "--session", "1"});
    INFO(original.err);
    CHECK(original.exit_code == 0);
}

TEST_CASE("a session that is being read when it ends is finished afterwards, and it is said how",
          "[session][waits]") {
    const SmallExperiment experiment(two_blocks());
    const fs::path said = experiment.folder().path() / "said";
    RunningProgram program(run_arguments(experiment, "P01", {"--virtual-time"}),
                           {"OVERT_CACHE=" + experiment.cache().string()}, said);
    while (program.is_running() && attempts_so_far(experiment.session()).empty())
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    {
        const SessionRecord reader(experiment.session());
        CHECK(program.wait() == 0);
        CHECK_THAT(text_of(said), Contains("its manifest is not finished"));
        CHECK(is_the_plan(SessionRecord(experiment.session())));
        const ProgramRun too_early = resume(experiment, {"--resume"});
        CHECK(too_early.exit_code == 2);
        CHECK_THAT(too_early.err, Contains("another program has the session open"));
    }
    const ProgramRun verified = experiment.overt({"verify", experiment.session().string()});
    CHECK(verified.exit_code == 0);
    CHECK_THAT(verified.out, Contains("--resume finishes it"));
    const ProgramRun finished = resume(experiment, {"--resume"});
    INFO(finished.err);
    CHECK(finished.exit_code == 0);
    CHECK_THAT(finished.out, Contains("the manifest is finished now"));
    CHECK(read_manifest(experiment.session()).is_closed);
}
