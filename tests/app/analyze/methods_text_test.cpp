/// The text on methods of whole studies says what study.json says, and nothing else.
#include <filesystem>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "experiment/base/json_text.h"
#include "experiment/scene/files/ply_writer.h"
#include "tests/app/analyze/small_study.h"
#include "tests/support/methods_laws.h"

namespace fs = std::filesystem;
using namespace overt::test;
using Catch::Contains;

namespace {

/// study.json of `overt analyze`, whose text was held against the laws, and which the page has, too.
nlohmann::json study_of(const SmallExperiment& experiment, const std::vector<std::string>& sessions,
                        const std::vector<std::string>& more = {}) {
    const fs::path out = experiment.folder().path() / "study";
    std::vector<std::string> arguments{"analyze", "--format",   "tsv",         "--resamples",    "200",
                                       "--out",   out.string(), "--overwrite", "--permutations", "100"};
    arguments.insert(arguments.end(), sessions.begin(), sessions.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = experiment.overt(arguments);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const nlohmann::json study = nlohmann::json::parse(text_of(out / "study.json"));
    check_methods(study);
    const std::string page = text_of(out / "report.html");
    const std::string words = study.at("methods").at(0).at("text");
    CHECK(page.find(words) != page.npos);
    CHECK(text_of(out / "reporting.tsv").find('{') == std::string::npos);
    return study;
}

} // namespace

TEST_CASE("the text on methods has each number of the study, whoever took part and whatever was excluded",
          "[session]") {
    // The questions have marks, which only a screen shows.
    const SmallStudy study(with(small_protocol, "Look at the face.", "Look at the <b>face</b>."));
    const std::string three = methods_of(study_of(study.experiment, study.sessions));
    CHECK_THAT(three,
               Contains("3 simulated observers took part in 3 sessions with 30 trials that came to an end. "
                        "Nothing here was measured of people.") &&
                   Contains("2 objects (Bust and Tall bust) were shown, in 2 materials (smooth and matt).") &&
                   Contains("one of 3 questions or instructions: \"Look at the face.\"") &&
                   Contains("Gaze of the right eye was simulated at 1000 Hz.") &&
                   Contains("was 272 x 96 mm large, was refreshed at 120 Hz and was seen from 573 mm") &&
                   Contains("planned for 1 s") && Contains("by 25 deg to each side, in 31 frames") &&
                   Contains("Intervals are of 95 %") && Contains("200 draws"));

    const std::string one = methods_of(study_of(study.experiment, {study.sessions[0]}));
    CHECK_THAT(one,
               Contains("1 simulated observer took part in 1 session with 10 trials that came to an end.") &&
                   Contains("There are no intervals over observers"));

    // The median of the drift checks leaves out about half.
    const nlohmann::json all = study_of(study.experiment, study.sessions);
    const double median = all.at("trial_measures").at("drift_deg").at("median");
    const nlohmann::json some =
        study_of(study.experiment, study.sessions, {"--most-drift", fmt::format("{:.3f}", median)});
    const int excluded = some.at("excluded_trials");
    REQUIRE(excluded > 1);
    REQUIRE(excluded < 30);
    CHECK_THAT(methods_of(some),
               Contains(fmt::format("A trial was to be excluded if the drift check before it found an error "
                                    "above {:.3g} deg. {} of 30 trials were excluded.",
                                    std::stod(fmt::format("{:.3f}", median)), excluded)));
    const nlohmann::json none = study_of(study.experiment, study.sessions, {"--most-lost", "0.99"});
    CHECK(none.at("excluded_trials") == 0);
    CHECK_THAT(methods_of(none), Contains("lost outside of blinks. This excluded no trial."));
    const nlohmann::json every = study_of(study.experiment, study.sessions, {"--most-drift", "0"});
    CHECK_THAT(methods_of(every), Contains("All 30 trials were excluded."));
}

TEST_CASE("the text on methods tells imported gaze from simulated, and what an import does not know",
          "[session]") {
    const SmallStudy study;
    const fs::path asc = study.experiment.folder().path() / "asc";
    REQUIRE(study.experiment.overt({"export", study.sessions[0], "--format", "asc", "--out", asc.string()})
                .exit_code == 0);
    fs::path recording;
    for (const auto& entry : fs::directory_iterator(asc))
        if (entry.path().extension() == ".asc")
            recording = entry.path();
    // As a tracker writes it, which knows nothing of a simulation.
    std::string text = text_of(recording);
    const std::string remark = "overt recorded this with the tracker: simulated";
    REQUIRE(text.find(remark) != text.npos);
    const auto import = [&](const std::string& name, const std::string& words) {
        std::string changed = text;
        changed.replace(changed.find(remark), remark.size(), words);
        const fs::path file = study.experiment.folder().file(name + ".asc", changed);
        const fs::path out = study.experiment.folder().path() / name;
        const ProgramRun run =
            study.experiment.overt({"import", file.string(), "--out", out.string(), "--observer", name});
        INFO(run.err);
        REQUIRE(run.exit_code == 0);
        return out.string();
    };
    const std::string own = import("own", remark), foreign = import("foreign", "CONVERTED");

    const std::string imported = methods_of(study_of(study.experiment, {foreign}));
    CHECK_THAT(imported,
               Contains("1 observer took part in 1 session with 10 trials") &&
                   Contains("Gaze of the right eye was imported from a recording, at 1000 Hz, of an eye "
                            "tracker, EyeLink") &&
                   Contains("What was shown is not on record.") && Contains("are not on record") &&
                   Contains("The recording was imported by overt") && !Contains("simulated") &&
                   !Contains("objects were shown"));
    CHECK_THAT(methods_of(study_of(study.experiment, {own})),
               Contains("1 simulated observer") && Contains("of simulated gaze") && !Contains("EyeLink"));
    // A study with two trackers.
    const std::string both =
        methods_of(study_of(study.experiment, {study.sessions[0], study.sessions[1], foreign}));
    CHECK_THAT(both, Contains("3 observers, of whom 2 were simulated, took part in 3 sessions") &&
                         Contains("In 2 of 3 sessions, gaze of the right eye was simulated at 1000 Hz.") &&
                         Contains("In 1 of 3 sessions, gaze of the right eye was imported") &&
                         Contains("What was shown in 1 of 3 sessions is not on record.") &&
                         Contains("Gaze was calibrated 2 times by the simulated eye tracker."));
}

TEST_CASE("the text on methods of one object without a head says nothing of heads", "[session]") {
    std::string protocol(small_protocol);
    const std::size_t first = protocol.find("[[object]]"), second = protocol.find("[[object]]", first + 1);
    protocol.replace(first, second - first, "");
    protocol = with(with(protocol, "meshes/tall.ply", "meshes/vase.ply"), "\"Tall bust\"", "\"Vase\"");
    for (const char* const share :
         {"simulated_head_share = 1\n", "simulated_head_share = 0\n", "simulated_head_share = 0.5\n"})
        protocol = with(protocol, share, "");
    const SmallExperiment experiment(protocol);
    overt::Mesh vase;
    add_part(vase, box({-60.0, -60.0, 0.0}, {60.0, 60.0, 250.0}), "body");
    overt::write_ply(experiment.folder().path() / "meshes/vase.ply", vase);
    const ProgramRun run = experiment.run();
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const std::string text = methods_of(study_of(experiment, {experiment.session().string()}));
    CHECK_THAT(text, Contains("1 object (Vase) was shown, in 2 materials (smooth and matt).") &&
                         !Contains("fixations on the head"));
}
