/// Studies with something missing: it is said, and what can be reckoned is.
#include <algorithm>
#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sched.h>

#include "experiment/scene/files/ply_writer.h"
#include "tests/app/analyze/small_study.h"
#include "tests/support/asc_text.h"
#include "tests/support/tsv_file.h"

namespace fs = std::filesystem;
using namespace overt::test;

namespace {

/// No table has a cell that is no number where one should stand, and all are there.
void check_tables(const fs::path& analysis) {
    int tables = 0;
    for (const fs::directory_entry& file : fs::directory_iterator(analysis)) {
        if (file.path().extension() != ".tsv" && file.path().extension() != ".json")
            continue;
        std::string text = text_of(file.path());
        std::ranges::transform(text, text.begin(), [](char c) { return c == '\n' || c == ',' ? '\t' : c; });
        INFO(file.path());
        for (const char* const word : {"\tnan\t", "\t-nan\t", "\tinf\t", "\t-inf\t", ": nan", ": null"})
            CHECK(text.find(word) == std::string::npos);
        ++tables;
    }
    CHECK(tables >= 8);
    CHECK(fs::exists(analysis / "report.html"));
}

/// `overt analyze` of some sessions, which does not fail.
ProgramRun analysis_of(const SmallExperiment& experiment, const std::vector<std::string>& sessions,
                       const fs::path& out, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"analyze",        "--format", "tsv",   "--resamples", "100",
                                       "--permutations", "100",      "--out", out.string()};
    arguments.insert(arguments.end(), sessions.begin(), sessions.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    ProgramRun run = experiment.overt(arguments);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    check_tables(out);
    return run;
}

/// All processes begun while it lives run on one processor.
class OneProcessor {
  public:
    OneProcessor() {
        ::sched_getaffinity(0, sizeof before_, &before_);
        cpu_set_t one;
        CPU_ZERO(&one);
        for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
            if (CPU_ISSET(cpu, &before_)) {
                CPU_SET(cpu, &one);
                break;
            }
        }
        ::sched_setaffinity(0, sizeof one, &one);
    }
    ~OneProcessor() { ::sched_setaffinity(0, sizeof before_, &before_); }

  private:
    cpu_set_t before_{};
};

} // namespace

TEST_CASE("two imports of one recording are refused, under whatever names", "[session]") {
    const TemporaryFolder root;
    const auto imported = [&](const std::string& text, const char* observer) {
        const fs::path file = overt::testing::write_asc(root.path() / (std::string(observer) + ".asc"), text);
        const fs::path session = root.path() / observer;
        const ProgramRun run =
            run_overt({"import", file.string(), "--observer", observer, "--out", session.string()});
        INFO(run.err);
        REQUIRE(run.exit_code == 0);
        return session.string();
    };
    const std::string text = overt::testing::asc_text({});
    const std::string one = imported(text, "P01"), same = imported(text, "P02"),
                      other = imported(text + "** another\n", "P03");
    const auto analyzed = [&](const std::string& second) {
        return run_overt({"analyze", one, second, "--out", (root.path() / "analysis").string(), "--resamples",
                          "100", "--permutations", "100"});
    };
    const ProgramRun twice = analyzed(same);
    CHECK(twice.exit_code == 2);
    CHECK_THAT(twice.err, Catch::Matchers::Contains("P02 was imported from the same recording as") &&
                              Catch::Matchers::Contains("would count twice: give one of them"));
    CHECK_FALSE(fs::exists(root.path() / "analysis"));
    const ProgramRun both = analyzed(other);
    INFO(both.err);
    CHECK(both.exit_code == 0);
}

TEST_CASE("a study says what it lacks and reckons what it can", "[session]") {
    const SmallStudy study;
    const fs::path folder = study.experiment.folder().path();

    SECTION("one observer: no intervals") {
        const ProgramRun run = analysis_of(study.experiment, {study.sessions[0]}, folder / "one");
        CHECK(run.out.find("only 1 observer") != std::string::npos);
        const TsvFile fractions(folder / "one/figure4_area_share.tsv");
        bool has_any = false;
        for (std::size_t row = 0; row < fractions.size(); ++row) {
            has_any |= fractions.has(row, "by_count");
            CHECK_FALSE(fractions.has(row, "by_count_low"));
            CHECK_FALSE(fractions.has(row, "corrected_low"));
        }
        CHECK(has_any);
    }
    SECTION("no fixation that counts, in any group") {
        const ProgramRun run =
            analysis_of(study.experiment, study.sessions, folder / "none", {"--shortest-fixation", "30"});
        CHECK(run.out.find("No fixation was counted") != std::string::npos);
        const TsvFile fractions(folder / "none/figure4_area_share.tsv");
        for (std::size_t row = 0; row < fractions.size(); ++row) {
            CHECK_FALSE(fractions.has(row, "by_count"));
            CHECK(fractions.has(row, "by_count_absent"));
        }
    }
    SECTION("trials that are all excluded") {
        const ProgramRun run =
            analysis_of(study.experiment, study.sessions, folder / "lost", {"--most-accuracy", "0.0001"});
        CHECK(run.out.find("excluded") != std::string::npos);
    }
    SECTION("maps that one session lacks are taken from another that showed the same") {
        fs::remove_all(fs::path(study.sessions[0]) / "maps");
        const ProgramRun run = analysis_of(study.experiment, study.sessions, folder / "rest", {"--json"});
        CHECK(nlohmann::json::parse(run.out).at("counted_fixations") > 50);
    }
    SECTION("on one processor, or in shards, everything is the same to the byte") {
        analysis_of(study.experiment, study.sessions, folder / "all");
        {
            const OneProcessor one;
            analysis_of(study.experiment, study.sessions, folder / "alone");
        }
        const std::string parts = (folder / "parts").string();
        for (const std::string which : {"2/2", "1/2"}) {
            std::vector<std::string> arguments{"analyze", "--shard", which, "--out", parts};
            arguments.insert(arguments.end(), study.sessions.begin(), study.sessions.end());
            REQUIRE(study.experiment.overt(arguments).exit_code == 0);
        }
        const std::string first = parts + "/shard_1_of_2", second = parts + "/shard_2_of_2";
        analysis_of(study.experiment, {second, first}, folder / "joined");
        const auto refused = [&](const std::vector<std::string>& arguments) {
            const ProgramRun run = study.experiment.overt(arguments);
            CHECK(run.exit_code == 2);
            return run.err;
        };
        CHECK(refused({"analyze", first, "--out", parts + "/x"}).find("missing: shard 2/2") !=
              std::string::npos);
        CHECK(refused({"analyze", first, study.sessions[1], "--out", parts + "/x"}).find("is a shard and") !=
              std::string::npos);
        CHECK(refused({"analyze", first, second, "--sigma", "2deg", "--out", parts + "/x"})
                  .find("--sigma 1deg") != std::string::npos);
        int compared = 0;
        for (const fs::directory_entry& file : fs::recursive_directory_iterator(folder / "all")) {
            if (!file.is_regular_file() || file.path().extension() == ".pdf")
                continue; // these have the time of their making
            INFO(file.path());
            for (const char* const other : {"alone", "joined"})
                CHECK(text_of(file.path()) ==
                      text_of(folder / other / fs::relative(file.path(), folder / "all")));
            ++compared;
        }
        CHECK(compared > 10);
    }
    SECTION("a folder without a session is an error; a session that is named twice is taken once") {
        const auto refused = [&](const std::vector<std::string>& sessions) {
            std::vector<std::string> arguments{"analyze", "--out", (folder / "x").string()};
            arguments.insert(arguments.end(), sessions.begin(), sessions.end());
            const ProgramRun run = study.experiment.overt(arguments);
            CHECK(run.exit_code == 2);
            return run.err;
        };
        fs::create_directory(folder / "empty");
        const std::string said = refused({(folder / "empty").string()});
        CHECK(said.find("empty: this folder holds no session") != std::string::npos);
        CHECK(said.find("session.sqlite") != std::string::npos);
        const ProgramRun once = study.experiment.overt({"analyze", study.sessions[0], study.sessions[0] + "/",
                                                        "--json", "--out", (folder / "once").string()});
        CHECK(once.exit_code == 0);
        CHECK(once.err.find("taken once") != std::string::npos);
        const auto number = [](const ProgramRun& run) {
            return nlohmann::json::parse(run.out).at("sessions").size();
        };
        CHECK(number(once) == 1);
    }
}

TEST_CASE("sessions of different protocols are pooled, and another turn makes another object", "[session]") {
    const SmallExperiment first;
    const SmallExperiment second(with(with(small_protocol, "A small experiment", "Another experiment"),
                                      "amplitude_deg = 25", "amplitude_deg = 10"));
    REQUIRE(first.run({"--observer", "P01"}).exit_code == 0);
    REQUIRE(second.run({"--observer", "P02"}).exit_code == 0);
    const fs::path out = first.folder().path() / "both";
    const ProgramRun run = analysis_of(
        first, {first.session(1, "P01").string(), second.session(1, "P02").string()}, out, {"--json"});
    CHECK(run.out.find("2 protocols") != std::string::npos);
    const auto json = nlohmann::json::parse(run.out);
    CHECK(json.at("objects").size() == 4);
    // Each finds what it finds alone.
    const auto alone = nlohmann::json::parse(
        analysis_of(second, {second.session(1, "P02").string()}, second.folder().path() / "alone", {"--json"})
            .out);
    const TsvFile of_both(out / "fixations.tsv"), of_one(second.folder().path() / "alone/fixations.tsv");
    std::size_t own = 0;
    for (std::size_t row = 0; row < of_both.size(); ++row) {
        if (of_both.text(row, "observer") != "P02")
            continue;
        REQUIRE(own < of_one.size());
        for (const char* const column : {"onset_s", "part", "x_mm", "y_mm", "z_mm"})
            CHECK(of_both.text(row, column) == of_one.text(own, column));
        ++own;
    }
    CHECK(own == of_one.size());
}

TEST_CASE("objects without areas have no shares of any, no text speaks of heads, and there is all else",
          "[session]") {
    const SmallExperiment experiment;
    overt::Mesh block;
    add_part(block, box({-45.0, -40.0, 0.0}, {45.0, 40.0, 260.0}), "body");
    for (const char* const name : {"bust", "tall"})
        overt::write_ply(experiment.folder().path() / "meshes" / (std::string(name) + ".ply"), block);
    REQUIRE(experiment.run().exit_code == 0);
    const fs::path out = experiment.folder().path() / "headless";
    const ProgramRun run = analysis_of(experiment, {experiment.session().string()}, out);
    CHECK(run.out.find("has no named areas") != std::string::npos);
    for (const char* const table :
         {"figure4_area_share", "areas", "area_transitions", "area_pairs", "time_course"})
        CHECK_FALSE(fs::exists(out / (std::string(table) + ".tsv")));
    for (const char* const file : {"dictionary.json", "study.json", "trials.tsv", "fixations.tsv"})
        CHECK(text_of(out / file).find("on the head") == std::string::npos);
    CHECK(text_of(out / "trials.tsv").find("head") == std::string::npos);
    CHECK(TsvFile(out / "maps.tsv").size() > 0);
}

TEST_CASE("a session given twice is refused, as a copy too, and every pair is named", "[session]") {
    const SmallStudy study;
    const fs::path folder = study.experiment.folder().path();
    const fs::path copy = folder / "backup/of_the_first", other = folder / "backup/sub-P09_ses-01";
    fs::create_directories(folder / "backup");
    fs::copy(study.sessions[0], copy, fs::copy_options::recursive);
    fs::copy(study.sessions[1], other, fs::copy_options::recursive);
    std::vector<std::string> arguments{"analyze", "--out", (folder / "twice").string(), copy.string(),
                                       other.string()};
    arguments.insert(arguments.end(), study.sessions.begin(), study.sessions.end());
    const ProgramRun run = study.experiment.overt(arguments);
    CHECK(run.exit_code == 2);
    for (const std::string& named : {copy.string(), other.string(), study.sessions[0], study.sessions[1]}) {
        INFO(named);
        CHECK(run.err.find(named) != std::string::npos);
    }
    CHECK(run.err.find("the same session as") != std::string::npos);
    CHECK(run.err.find(study.sessions[2]) == std::string::npos);
    CHECK_FALSE(fs::exists(folder / "twice"));
}

TEST_CASE("N has those whose gaze there is, and the study says who is not counted and why", "[session]") {
    const SmallStudy study;
    const fs::path folder = study.experiment.folder().path();
    REQUIRE(study.experiment.run({"--observer", "P04", "--tracker", "none"}).exit_code == 0);
    std::vector<std::string> sessions = study.sessions;
    sessions.push_back(study.experiment.session(1, "P04").string());
    const ProgramRun with_it = analysis_of(study.experiment, sessions, folder / "with");
    CHECK(with_it.out.find("3 observers, 4 sessions") != std::string::npos);
    CHECK(with_it.out.find(
              "N is 3 of 4 observers who were given. Not counted: P04 (no gaze was recorded in any "
              "trial).") != std::string::npos);
    const auto json = nlohmann::json::parse(text_of(folder / "with/study.json"));
    CHECK(json.at("observers") == 3);
    REQUIRE(json.at("observers_given").size() == 4);
    CHECK(json.at("observers_given").at(0).at("counts") == true);
    CHECK(json.at("observers_given").at(3).at("counts") == false);
    CHECK(text_of(folder / "with/report.html").find("Not counted: P04") != std::string::npos);
    // Trials without gaze do not thin the maps out: all that is reckoned of the others stays.
    analysis_of(study.experiment, study.sessions, folder / "without");
    for (const char* const table : {"maps.tsv", "figure4_area_share.tsv", "figure5_distribution.tsv"})
        CHECK(text_of(folder / "with" / table) == text_of(folder / "without" / table));
}

TEST_CASE("observers whose labels are nearly the same are doubted, and can be made one", "[session]") {
    const SmallStudy study;
    const fs::path folder = study.experiment.folder().path();
    REQUIRE(study.experiment.run({"--observer", "p1", "--another-person"}).exit_code == 0);
    std::vector<std::string> sessions = study.sessions;
    sessions.push_back(study.experiment.session(1, "p1").string());
    const ProgramRun doubted = analysis_of(study.experiment, sessions, folder / "two");
    CHECK(doubted.out.find("4 observers, 4 sessions") != std::string::npos);
    CHECK(doubted.out.find("Observers P01 and p1 count as different people") != std::string::npos);
    CHECK(doubted.out.find("--same-observer p1=P01") != std::string::npos);
    CHECK(text_of(folder / "two/report.html").find("count as different people") != std::string::npos);
    const ProgramRun one =
        analysis_of(study.experiment, sessions, folder / "one", {"--same-observer", "p1=P01"});
    CHECK(one.out.find("3 observers, 4 sessions") != std::string::npos);
    CHECK(one.out.find("different people") == std::string::npos);
    const TsvFile trials(folder / "one/trials.tsv");
    CHECK(trials.size() == 4 * small_trials);
    for (std::size_t row = 0; row < trials.size(); ++row)
        CHECK(trials.text(row, "observer") != "p1");
    for (const auto& [given, said] :
         {std::pair{"x=P01", "no session is of observer x"}, {"p1", "LABEL=LABEL"}}) {
        std::vector<std::string> arguments{"analyze", "--out", (folder / "no").string(), "--same-observer",
                                           given};
        arguments.insert(arguments.end(), sessions.begin(), sessions.end());
        const ProgramRun refused = study.experiment.overt(arguments);
        CHECK(refused.exit_code == 2);
        CHECK(refused.err.find(said) != std::string::npos);
    }
}
