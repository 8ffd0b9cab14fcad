/// Answers of a whole simulated study: planted scales and looking come back, and the text says what they are.
#include <catch2/catch.hpp>

#include <filesystem>

#include <nlohmann/json.hpp>

#include "tests/app/small_experiment.h"
#include "tests/support/methods_laws.h"

using namespace overt::test;
namespace fs = std::filesystem;

namespace {

/// Two objects in three materials side by side, each pair in both orders: observers choose by the materials'
/// gloss, and look longer at what they are going to choose.
std::string glossier_side_by_side() {
    std::string text(small_protocol);
    text.resize(text.find("[[material]]"));
    for (const char* const gloss : {"0", "1", "2"})
        text += fmt::format(
            "[[material]]\nid = \"g{0}\"\nkind = \"diffuse\"\ncolumns = {{ gloss = {0} }}\n\n", gloss);
    return text + R"([[slot]]
id = "left"
right_deg = -6

[[slot]]
id = "right"
right_deg = 6

[[task]]
id = "glossier"
question = "Which is glossier?"
slots = ["left", "right"]
trials = { rule = "pairs", of = "gloss", side = "crossed" }
repetitions = 2
steps = [
  { fixation = 0.3 },
  { show = ["left", "right"], for_s = 1.5 },
  { answer = "which", limit_s = 1 },
]

[[task.answer]]
id = "which"
kind = "choice"
choices = ["left", "right"]
keys = ["f", "j"]
simulated = { by = "gloss", slope = 0.8, bias = 0.3, look_share = 0.8, shift_s = 0.1, median_s = 0.2 }
)";
}

const nlohmann::json* row_where(const nlohmann::json& rows, const char* key, const std::string& value,
                                const char* other = "", const std::string& wanted = {}) {
    for (const nlohmann::json& row : rows)
        if (row.at(key) == value && (wanted.empty() || row.at(other) == wanted))
            return &row;
    return nullptr;
}

} // namespace

TEST_CASE("scales and looking before an answer come back from a whole study beside what was planted",
          "[session]") {
    const SmallExperiment experiment(glossier_side_by_side());
    const fs::path study = experiment.folder().path() / "study";
    const ProgramRun run = experiment.overt({"replicate", experiment.protocol().string(), "--context",
                                             "osmesa", "--out", study.string(), "--observers", "3"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out, Catch::Contains("which: scale at gloss 2") && Catch::Contains("planted"));
    const auto json = nlohmann::json::parse(text_of(study / "analysis/study.json"));
    check_methods(json);
    const auto& answers = json.at("answers");
    CHECK(answers.at("given").get<int>() + answers.at("missed").get<int>() == 72);
    const nlohmann::json* const scale =
        row_where(answers.at("scales"), "level", "2", "method", "Thurstone Case V");
    REQUIRE(scale);
    CHECK(scale->at("planted").get<double>() == Approx(0.8 * std::sqrt(2.0)));
    CHECK(scale->at("value_interval")[0] < 0.8 * std::sqrt(2.0));
    CHECK(scale->at("value_interval")[1] > 0.8 * std::sqrt(2.0));
    const nlohmann::json* const curve = row_where(answers.at("functions"), "factor", "gloss");
    REQUIRE(curve);
    // The first slot is chosen more often by its bias: where it is less glossy both are chosen alike.
    // Shares are normal, P = Phi(0.8 x + 0.3), which is even at x = -0.375; the function is logistic, and
    // that of the highest likelihood through these shares at -2, -1, -1, 1, 1, 2 is even at -0.395.
    CHECK(curve->at("planted_threshold").get<double>() == Approx(-0.395).margin(0.005));
    CHECK(curve->at("planted_slope").get<double>() == Approx(1.368).margin(0.01));
    // 24 trials give a threshold with a standard error of 0.42; observers whose answers step have none.
    CHECK(curve->at("threshold").get<double>() == Approx(-0.395).margin(0.5));
    const nlohmann::json* const dwell = row_where(answers.at("gaze_and_choice"), "measure", "dwell share");
    REQUIRE(dwell);
    CHECK(dwell->at("planted") == 0.8);
    CHECK(dwell->at("value").get<double>() == Approx(0.8).margin(0.12));
    CHECK(dwell->at("chance").get<double>() == Approx(0.5).margin(0.1));
    const auto& headline = json.at("headline");
    CHECK(headline.at("question") == "Which is glossier?");
    CHECK_THAT(headline.at("design").get<std::string>(),
               Catch::Contains("72 trials with 2 stimuli each") && Catch::Contains("gloss (3 levels)"));
    CHECK_THAT(headline.at("sample").get<std::string>(),
               Catch::Contains("N = 3 simulated observers, none left"));
    CHECK_THAT(headline.at("result").get<std::string>(),
               Catch::Contains("2 lies highest") && Catch::Contains("95 % interval"));
    const std::string page = text_of(study / "analysis/report.html");
    CHECK_THAT(page, Catch::Contains("\"answer_maps\":[{"));
    CHECK_THAT(text_of(study / "analysis/answer_models.R"), Catch::Contains("answer_trials.csv"));
    CHECK_THAT(text_of(study / "analysis/answer_trials.csv"), Catch::Contains("left.gloss"));
}
