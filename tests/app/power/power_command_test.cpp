/// `overt power` as it is called: answers, tables, a figure, and what it refuses.
#include <catch2/catch.hpp>

#include <nlohmann/json.hpp>

#include "tests/app/small_experiment.h"
#include "tests/support/tsv_file.h"

namespace fs = std::filesystem;
using namespace overt::test;
using Catch::Contains;

namespace {

ProgramRun power(const SmallExperiment& experiment, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"power",     experiment.protocol().string(),
                                       "--studies", "12",
                                       "--out",     (experiment.folder().path() / "power").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return experiment.overt(arguments);
}

} // namespace

TEST_CASE("a plan is answered in words, with its curve as table and figure", "[session]") {
    const SmallExperiment experiment(with(small_protocol, "stimuli = \"once-per-object\"\n", ""));
    const fs::path out = experiment.folder().path() / "power";
    const ProgramRun run =
        power(experiment, {"--effect", "head:material=matt:task=free:odds=30", "--effect",
                           "cc:material=matt:share=0", "--observers", "6,9", "--format", "tsv"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("of 12 simulated studies (95 % interval"));
    CHECK_THAT(run.out, Contains("found the effect on the share of fixations on the head, material matt "
                                 "against smooth, task free."));
    CHECK_THAT(run.out, Contains("found a difference that was not planted"));
    CHECK_THAT(run.out, Contains("note: Observers differ by chance alone"));

    const TsvFile curve(out / "power_curve.tsv"), studies(out / "power_studies.tsv");
    REQUIRE(curve.size() == 4);
    CHECK(studies.size() == 48);
    for (std::size_t row = 0; row < curve.size(); ++row) {
        int found = 0;
        for (std::size_t i = 0; i < studies.size(); ++i)
            found += studies.text(i, "effect") == curve.text(row, "effect") &&
                     studies.text(i, "observers") == curve.text(row, "observers") &&
                     studies.number(i, "p") <= 0.05;
        CHECK(curve.number(row, "found") == found);
        CHECK(curve.number(row, "power") == Approx(found / 12.0).margin(1e-4));
    }
    // Odds of 30 turn half of the fixations into nearly all.
    CHECK(curve.number(1, "found") == 12);
    const auto json = nlohmann::json::parse(text_of(out / "power.json"));
    CHECK(json["effects"].size() == 2);
    CHECK(json["effects"][0]["curve"][1]["found"] == 12);
    const auto dictionary = nlohmann::json::parse(text_of(out / "dictionary.json"));
    CHECK(dictionary.contains("power_curve.tsv"));
    CHECK_THAT(text_of(out / "power_curve.svg"), Contains("<svg"));
    CHECK(fs::file_size(out / "power_curve.pdf") > 1000);

    // What is there is replaced only when asked for.
    const std::string before = text_of(out / "power_studies.tsv");
    CHECK(power(experiment, {"--effect", "none"}).exit_code == 2);
    CHECK(text_of(out / "power_studies.tsv") == before);
    const ProgramRun again =
        power(experiment, {"--effect", "none", "--observers", "6", "--overwrite", "--json"});
    CHECK(again.exit_code == 0);
    CHECK(nlohmann::json::parse(again.out)["effects"].size() == 4);
    CHECK_FALSE(fs::exists(out / "power_studies.tsv"));
}

TEST_CASE("plans that cannot be read leave nothing behind", "[session]") {
    const SmallExperiment experiment;
    const auto check_refused = [&](const std::vector<std::string>& arguments, const std::string& words) {
        const ProgramRun run = power(experiment, arguments);
        INFO(run.err);
        CHECK(run.exit_code == 2);
        CHECK_THAT(run.err, Contains(words));
        CHECK_FALSE(fs::exists(experiment.folder().path() / "power"));
    };
    check_refused({}, "--effect");
    check_refused({"--effect", "head:material=gold:odds=2"}, "it has smooth, matt");
    check_refused({"--effect", "none", "--observers", "9:6"}, "the range ends before it begins");
    check_refused({"--effect", "none", "--alpha", "2"}, "--alpha");
    check_refused({"--effect", "none", "--sigma", "wide"}, "--sigma");
    check_refused({"--effect", "none", "--alpha", "0.001", "--permutations", "100"}, "cannot give a p");
}
