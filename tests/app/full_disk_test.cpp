/// Sessions on a disk that is full, and two sessions begun at once.
#include <sys/resource.h>

#include "app/interrupted_run.h"

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
                               ::signal(SIGXFSZ, SIG_IGN);
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
            again.push_back("--resume");
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
