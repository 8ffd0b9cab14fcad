/// Whole sessions with two eye trackers: two records of the same trials.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <chrono>

#include "experiment/record/read/session_record.h"
#include "experiment/record/session_directory.h"
#include "tests/app/small_experiment.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

/// When the attempts that count began.
std::vector<SessionTime> counted_starts(const SessionRecord& record) {
    std::vector<SessionTime> starts;
    for (const TrialRecord& attempt : record.trials())
        if (attempt.counts)
            starts.push_back(attempt.started);
    return starts;
}

SmallExperiment of_two(const std::string& keys = "rate_hz = 500\neye = \"both\"\n") {
    return SmallExperiment(fmt::format("{}\n[[further_tracker]]\nid = \"second\"\n{}", small_protocol, keys));
}

} // namespace

TEST_CASE("a session with two trackers has two records, of which each is a session", "[session]") {
    const SmallExperiment experiment = of_two();
    const ProgramRun run = experiment.run({"--trials", "2"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("further tracker second: simulated"));
    const std::filesystem::path session = experiment.session(), second = further_record(session, "second");
    CHECK(further_trackers_of(session) == std::vector<std::string>{"second"});

    const SessionRecord own(session), further(second);
    CHECK(own.header().further_tracker.empty());
    CHECK(further.header().further_tracker == "second");
    CHECK(further.header().tracker.sample_rate_hz == 500.0);
    CHECK(further.header().tracker.both_eyes);
    REQUIRE(own.trials().size() == 2);
    REQUIRE(further.trials().size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(further.trials()[i].started == own.trials()[i].started);
        CHECK(further.trials()[i].outcome.answer == own.trials()[i].outcome.answer);
        const auto flips = own.flips(own.trials()[i]), same = further.flips(further.trials()[i]);
        REQUIRE(flips.size() == same.size());
        CHECK(flips.back().report.vertical_blank == same.back().report.vertical_blank);
        // 1 s and twice the lead of 0.1 s, at 1000 Hz of one eye and 500 Hz of two.
        const auto samples = own.samples(own.trials()[i]), others = further.samples(further.trials()[i]);
        CHECK(std::abs(static_cast<double>(samples.size()) - 1200.0) < 30.0);
        CHECK(std::abs(static_cast<double>(others.size()) - 1200.0) < 30.0);
        CHECK(std::ranges::count(others, Eye::left, &GazeSample::eye) * 2 ==
              static_cast<std::ptrdiff_t>(others.size()));
    }
    // Maps are the same files, and not copies.
    REQUIRE_FALSE(own.header().maps.empty());
    CHECK(std::filesystem::equivalent(session / own.header().maps.front().file,
                                      second / further.header().maps.front().file));

    const ProgramRun verified = experiment.overt({"verify", session.string()});
    CHECK(verified.exit_code == 0);
    CHECK_THAT(verified.out, Contains("trackers/second: sound"));
    CHECK_THAT(experiment.overt({"show", session.string()}).out, Contains("further eye tracker second"));
    CHECK_THAT(experiment.overt({"show", second.string()}).out,
               Contains("the record of the further eye tracker second"));
    for (const std::string format : {"tsv", "asc", "bids"}) {
        const auto out = experiment.folder().path() / format;
        CHECK(experiment.overt({"export", second.string(), "--format", format, "--out", out.string()})
                  .exit_code == 0);
    }
    const ProgramRun analysed = experiment.overt(
        {"analyze", second.string(), "--out", (experiment.folder().path() / "study").string()});
    INFO(analysed.err);
    CHECK(analysed.exit_code == 0);
}

TEST_CASE("the record of each tracker has the readings of its own clock", "[session]") {
    const SmallExperiment experiment = of_two("simulated_clock_drift_ppm = -9000\n");
    REQUIRE(experiment.run({"--trials", "1"}).exit_code == 0);
    const SessionRecord own(experiment.session()), further(further_record(experiment.session(), "second"));
    // That of the session's own runs 40 ppm too fast.
    const auto rate_of = [](const SessionRecord& record) {
        const std::vector<ClockPair> pairs = record.clock_pairs(1);
        REQUIRE(pairs.size() >= 16);
        return std::chrono::duration<double>(pairs.back().other - pairs.front().other).count() /
               to_seconds(pairs.back().before - pairs.front().before);
    };
    CHECK(rate_of(own) - rate_of(further) == Approx(9040e-6).margin(400e-6));
}

TEST_CASE("a session with two trackers that was killed goes on, and both records have the same trials",
          "[session]") {
    const SmallExperiment experiment = of_two();
    REQUIRE(experiment.run({"--trials", "3", "--simulate-operator", "stimulus@2+0.5=abort"}).exit_code == 1);
    const ProgramRun refused = experiment.run({"--trials", "3", "--resume", "--tracker", "none"});
    CHECK(refused.exit_code == 2);
    CHECK_THAT(refused.err, Contains("was begun with the further eye trackers second"));
    const ProgramRun resumed = experiment.run({"--trials", "3", "--resume"});
    INFO(resumed.err);
    REQUIRE(resumed.exit_code == 0);
    const SessionRecord own(experiment.session()), further(further_record(experiment.session(), "second"));
    CHECK(counted_starts(own).size() == 3);
    CHECK(counted_starts(further) == counted_starts(own));
    CHECK(experiment.overt({"verify", experiment.session().string()}).exit_code == 0);

    const ProgramRun replayed = experiment.overt({"replay", experiment.session().string()});
    INFO(replayed.out << replayed.err);
    CHECK(replayed.exit_code == 0);
    CHECK_THAT(replayed.out, Contains("further eye tracker second"));
    const ProgramRun alone =
        experiment.overt({"replay", further_record(experiment.session(), "second").string()});
    CHECK(alone.exit_code == 2);
    CHECK_THAT(alone.err, Contains("it is presented again with its session"));
}

TEST_CASE("attempts that only a further tracker's record has do not count once the session goes on",
          "[session]") {
    const SmallExperiment experiment = of_two();
    const std::filesystem::path session = experiment.session(), kept = experiment.folder().path() / "kept";
    REQUIRE(experiment.run({"--trials", "3", "--simulate-operator", "stimulus@2+0.5=abort"}).exit_code == 1);
    std::filesystem::create_directories(kept);
    for (const char* const file : {"session.sqlite", "manifest.json"})
        std::filesystem::copy_file(session / file, kept / file);
    REQUIRE(experiment.run({"--trials", "3", "--resume"}).exit_code == 0);
    // As if the machine had lost its power after the further record was on the disk and before the session's
    // own.
    for (const char* const file : {"session.sqlite", "manifest.json"})
        std::filesystem::copy_file(kept / file, session / file,
                                   std::filesystem::copy_options::overwrite_existing);
    const ProgramRun resumed = experiment.run({"--trials", "3", "--resume"});
    INFO(resumed.err);
    REQUIRE(resumed.exit_code == 0);
    const SessionRecord own(session), further(further_record(session, "second"));
    CHECK(own.trials().size() == 4);
    CHECK(further.trials().size() == 6);
    CHECK(counted_starts(own).size() == 3);
    CHECK(counted_starts(further) == counted_starts(own));
    CHECK(experiment.overt({"verify", session.string()}).exit_code == 0);
}

TEST_CASE("overt tracker tests and calibrates the further tracker that is named", "[session]") {
    const SmallExperiment experiment = of_two();
    const std::string protocol = experiment.protocol().string();
    const auto rate_of = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"tracker", "test", protocol, "--seconds", "0.5", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramRun run = experiment.overt(arguments);
        INFO(run.out << run.err);
        return run.out.find("\"granted_rate_hz\": 500.0") != std::string::npos;
    };
    CHECK(rate_of({"--further", "second"}));
    CHECK_FALSE(rate_of({}));
    const ProgramRun unknown = experiment.overt({"tracker", "test", protocol, "--further", "third"});
    CHECK(unknown.exit_code == 2);
    CHECK_THAT(unknown.err, Contains("--further third: the protocol's further trackers are second"));
    CHECK(experiment
              .overt({"tracker", "calibrate", protocol, "--further", "second", "--simulate-observer", "1",
                      "--virtual-time", "--context", "osmesa"})
              .exit_code == 0);
}

TEST_CASE("with --tracker further trackers are left out, and it is said", "[session]") {
    const SmallExperiment experiment = of_two();
    const ProgramRun run = experiment.run({"--trials", "1", "--tracker", "simulated"});
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("further eye trackers are left out"));
    CHECK(further_trackers_of(experiment.session()).empty());
}
