/// Sessions on a disk that is full, and two sessions begun at once.
#include <chrono>
#include <memory>
#include <thread>

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "tests/app/session/interrupted_run.h"
#include "tests/support/skip.h"
#include "tests/support/small_disk.h"

using namespace overt;
using namespace overt::test;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

/// The program where no file may grow beyond so many bytes, as on a disk that is full then.
int run_with_limit(const SmallExperiment& experiment, const std::vector<std::string>& arguments,
                   rlim_t largest_file) {
    RunningProgram program(arguments, {"OVERT_CACHE=" + experiment.cache().string()},
                           experiment.folder().path() / "said", [largest_file] {
                               const rlimit limit{largest_file, largest_file};
                               ::setrlimit(RLIMIT_FSIZE, &limit);
                           });
    return program.wait();
}

bool has_remnants(const SmallExperiment& experiment) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(experiment.session().parent_path(), none))
        if (entry.path().filename().string().starts_with("."))
            return true;
    return false;
}

bool is_verified(const SmallExperiment& experiment) {
    const ProgramRun run = experiment.overt({"verify", experiment.session().string()});
    UNSCOPED_INFO(run.out << run.err);
    return run.exit_code == 0;
}

} // namespace

TEST_CASE("a full disk is reported with the file and the remedy, and with room again the session goes on",
          "[session]") {
#if defined(__SANITIZE_THREAD__)
    OVERT_SKIP("the thread sanitizer's own files do not fit into such a limit");
#endif
    const SmallExperiment experiment(with(small_protocol, "duration_s = 1", "duration_s = 4"));
    // Also fills the cache.
    const auto size_with = [&](const std::string& observer, const std::string& trials) {
        REQUIRE(experiment.run({"--observer", observer, "--trials", trials}).exit_code == 0);
        return static_cast<double>(fs::file_size(experiment.session(1, observer) / "session.sqlite"));
    };
    const double two = size_with("X1", "2"), four = size_with("X2", "4");
    const double of_trial = 0.5 * (four - two), at_first = two - 2.0 * of_trial;
    const std::vector<std::string> arguments =
        run_arguments(experiment, "P01", {"--virtual-time", "--trials", "4"});
    int before_publishing = 0, in_trials = 0;
    // In the meshes or maps, in the session's header, and in one trial after the other.
    // In the log of one trial there is as much as in the file afterwards: both have this limit.
    for (const double limit : {6000.0, 0.5 * at_first, at_first + 0.3 * of_trial, at_first + 1.1 * of_trial,
                               at_first + 1.5 * of_trial}) {
        CAPTURE(limit, at_first, of_trial);
        REQUIRE(run_with_limit(experiment, arguments, static_cast<rlim_t>(limit)) == 1);
        const std::string said = text_of(experiment.folder().path() / "said");
        INFO(said);
        CHECK_FALSE(has_remnants(experiment));
        std::vector<std::string> again = arguments;
        if (fs::exists(experiment.session())) {
            ++in_trials;
            CHECK_THAT(said, Contains("session.sqlite") && Contains("go on with --resume"));
            CHECK(is_verified(experiment));
            const SessionRecord record(experiment.session());
            for (const TrialRecord& attempt : record.trials())
                CHECK((!attempt.counts || record.flips(attempt).size() == 480));
            again.resize(again.size() - 2); // the number of trials stands in the record
            again.emplace_back("--resume");
        } else {
            ++before_publishing;
            CHECK_THAT(said, Contains("/sessions/small/") && Contains("Make room") && Contains("not begun"));
        }
        const ProgramRun run = experiment.overt(again);
        INFO(run.err);
        REQUIRE(run.exit_code == 0);
        CHECK(is_the_plan(SessionRecord(experiment.session())));
        CHECK(is_verified(experiment));
        fs::remove_all(experiment.session());
    }
    CHECK(before_publishing >= 2);
    CHECK(in_trials >= 2);
}

TEST_CASE("on a real disk that fills up a session stays readable, and goes on when there is room",
          "[session]") {
    const SmallExperiment experiment(with(small_protocol, "duration_s = 1", "duration_s = 10"));
    REQUIRE(experiment.run({"--observer", "X1"}).exit_code == 0); // also fills the cache
    const fs::path whole = experiment.session(1, "X1"), disk_folder = experiment.folder().path() / "disk",
                   session = disk_folder / "small" / "sub-P01_ses-01",
                   said = experiment.folder().path() / "said";
    std::uint64_t at_first = 0;
    for (const auto& entry : fs::recursive_directory_iterator(whole))
        if (entry.is_regular_file() && entry.path().filename() != "session.sqlite")
            at_first += entry.file_size();
    const std::uint64_t rows = fs::file_size(whole / "session.sqlite");
    const std::uint64_t less_than_all = at_first + 6 * rows / 10;
    SmallDisk disk(disk_folder, less_than_all);
    if (!disk.is_there())
        OVERT_SKIP("this system lets no ordinary user mount a file system");
    const auto begun = [&](const std::vector<std::string>& arguments) {
        return std::make_unique<RunningProgram>(arguments,
                                                std::vector{"OVERT_CACHE=" + experiment.cache().string()},
                                                said, [&] { disk.enter(); });
    };
    const auto overt = [&](const std::vector<std::string>& arguments) { return begun(arguments)->wait(); };
    const auto run_of = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"run",
                                           experiment.protocol().string(),
                                           "--simulate-observer",
                                           "5",
                                           "--sessions",
                                           disk_folder.string(),
                                           "--observer",
                                           "P01",
                                           "--context",
                                           "osmesa",
                                           "--seed",
                                           "7",
                                           "--virtual-time"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    };
    const auto run = [&](const std::vector<std::string>& more) { return overt(run_of(more)); };
    // Too little room from the beginning: nothing is begun.
    CHECK(run({}) == 1);
    CHECK_THAT(text_of(said), Contains("the session will take about") && Contains("not begun"));
    CHECK(fs::is_empty(disk.seen(disk_folder)));
    // The disk fills up meanwhile.
    REQUIRE(disk.resize(at_first + 20 * rows));
    {
        const auto program = begun(run_of({}));
        while (!fs::exists(disk.seen(session)) && program->is_running())
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        REQUIRE(disk.resize(less_than_all));
        CHECK(program->wait() == 1);
    }
    CHECK_THAT(text_of(said),
               Contains("session.sqlite") && Contains("The disk is full") && Contains("--resume"));
    CHECK(overt({"show", session.string()}) == 0);
    CHECK_THAT(text_of(said), Contains("completed") && Contains("not closed in order"));
    CHECK(overt({"verify", session.string()}) == 0);
    const fs::path table = experiment.folder().path() / "tables";
    CHECK(overt({"export", session.string(), "--format", "tsv", "--out", table.string()}) == 0);
    const std::string trials = text_of(table / "trials.tsv");
    CHECK(std::count(trials.begin(), trials.end(), '\n') >= 2);
    // Still full: nothing is lost by trying.
    CHECK(overt({"export", session.string(), "--format", "tsv"}) == 1);
    CHECK_THAT(text_of(said), Contains("No space left on device"));
    CHECK(run({"--resume"}) == 1);
    CHECK_THAT(text_of(said), Contains("not resumed") && Contains("Make room"));
    CHECK(overt({"verify", session.string()}) == 0);
    REQUIRE(disk.resize(at_first + 20 * rows));
    CHECK(run({"--resume"}) == 0);
    CHECK_THAT(text_of(said), Contains("10 of 10 trials completed"));
    CHECK(overt({"verify", session.string()}) == 0);
    CHECK(overt({"export", session.string(), "--format", "tsv"}) == 0);
}

TEST_CASE("a session takes as much of the disk as `check` said, or a little less", "[session]") {
    const SmallExperiment experiment(with(small_protocol, "duration_s = 1", "duration_s = 10"));
    REQUIRE(experiment.run().exit_code == 0);
    double taken = 0.0;
    for (const auto& entry : fs::recursive_directory_iterator(experiment.session()))
        taken += entry.is_regular_file() ? static_cast<double>(entry.file_size()) : 0.0;
    const ProgramRun check = experiment.overt({"check", experiment.protocol().string(), "--json"});
    const double said = nlohmann::json::parse(check.out)["design"]["recording"]["total_bytes"];
    CHECK(said > taken);
    CHECK(said < 1.5 * taken);
}

TEST_CASE("of two programs that begin a session at once each has a number of its own", "[session]") {
    const SmallExperiment experiment;
    REQUIRE(experiment.run({"--observer", "X1", "--trials", "1"}).exit_code == 0);
    const std::vector<std::string> environment{"OVERT_CACHE=" + experiment.cache().string()};
    const auto both = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments =
            run_arguments(experiment, "P01", {"--virtual-time", "--trials", "1"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        RunningProgram one(arguments, environment, experiment.folder().path() / "one");
        RunningProgram other(arguments, environment, experiment.folder().path() / "other");
        const int first = one.wait();
        return std::pair(first, other.wait());
    };
    CHECK(both({}) == std::pair(0, 0));
    CHECK(fs::exists(experiment.session(1)));
    CHECK(fs::exists(experiment.session(2)));
    const auto codes = both({"--session", "3"});
    CHECK(codes.first + codes.second == 2); // done, and refused
    const std::string said = text_of(experiment.folder().path() / (codes.first == 2 ? "one" : "other"));
    CHECK_THAT(said, Contains("next free session number is 4"));
    CHECK(SessionRecord(experiment.session(3)).is_complete());
}
