/// The script of models of answers, run by R where it is.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/base/random.h"
#include "experiment/base/whole_file.h"
#include "experiment/study/tables/mixed_models.h"
#include "experiment/study/tables/study_tables.h"
#include "tests/support/skip.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;

namespace {

/// Eight observers choose the glossier of two, rate what they see, and answer cows more slowly.
std::vector<StudyAnswer> glossy_answers() {
    RandomStream random(5, "models of answers");
    std::vector<StudyAnswer> answers;
    const auto in = [](const std::string& slot, double level) {
        return AnsweredStimulus{slot, {{"gloss", fmt::format("{}", level)}}, {{"gloss", level}}};
    };
    for (int observer = 0; observer < 8; ++observer) {
        const double own = 0.3 * random.normal();
        for (int trial = 0; trial < 90; ++trial) {
            StudyAnswer answer;
            answer.observer = fmt::format("0{}", observer);
            answer.session = observer;
            answer.trial = trial + 1;
            answer.task = "glossier";
            answer.answer = "which";
            answer.kind = "choice";
            answer.is_missed = false;
            const double left = 0.1 * (trial % 5), right = 0.1 * (trial / 5 % 5);
            const bool is_cow = trial % 2 == 1;
            answer.levels = {{"object", is_cow ? "cow" : "bust"}};
            answer.shown = {in("left", left), in("right", right)};
            answer.value = 5.0 * (left - right) + 0.2 + own + random.normal() > 0.0 ? "left" : "right";
            answer.response_s = std::exp(-0.5 + 0.4 * is_cow + 0.2 * random.normal());
            answers.push_back(answer);
            answer.answer = "rating";
            answer.kind = "scale";
            answer.shown.resize(1);
            answer.levels = {{"object", is_cow ? "cow" : "bust"}, {"gloss", fmt::format("{}", left)}};
            answer.number =
                std::clamp(std::round(4.0 + 4.0 * (left - 0.2) + own + random.normal()), 1.0, 7.0);
            answer.value = fmt::format("{}", *answer.number);
            answer.response_s = std::nullopt;
            answers.push_back(answer);
        }
    }
    return answers;
}

} // namespace

TEST_CASE("models of answers find what was planted in the table that is written", "[session]") {
    if (std::system("Rscript -e 'q()' >/dev/null 2>&1") != 0)
        OVERT_SKIP("no R here to run the script of models of answers");
    StudyResults results;
    results.answers.given = glossy_answers();
    const TemporaryFolder folder;
    write_study_tables(results, folder.path(), TableFormat::csv);
    const std::string script = read_whole_file(folder.path() / "answer_models.R");
    CHECK(script.find("table_file <- \"answer_trials.csv\"") != script.npos);
    CHECK(is_study_table("answer_models.R"));
    CHECK(is_study_table("answer_trials.csv"));
    REQUIRE(std::system(
                fmt::format("cd / && Rscript {0}/answer_models.R >{0}/said.txt 2>&1", folder.path().string())
                    .c_str()) == 0);
    INFO(read_whole_file(folder.path() / "said.txt"));
    std::string text = read_whole_file(folder.path() / "answer_models.csv");
    // Quotes and commas as the script writes them; names with commas lose theirs.
    std::string plain;
    bool is_quoted = false;
    for (const char c : text) {
        is_quoted ^= c == '"';
        if (c != '"')
            plain += c != ',' ? c : is_quoted ? ';' : '\t';
    }
    const TsvFile models(folder.file("models.tsv", plain));
    const auto number = [&](const std::string& of, const std::string& term, const char* column) {
        for (std::size_t row = 0; row < models.size(); ++row)
            if (models.text(row, "of") == of && models.text(row, "term") == term)
                return models.number(row, column);
        FAIL("there is no row of " << of << ", " << term);
        return 0.0;
    };
    const std::string choice = "glossier; which: left chosen", slope = "difference of gloss";
    CHECK(number(choice, slope, "estimate") == Approx(5.0).margin(1.2));
    CHECK(number(choice, slope, "p") < 0.01);
    CHECK(number(choice, slope, "answers") == 720);
    CHECK(number("glossier; rating: rating", "gloss", "estimate") > 2.0);
    CHECK(number("glossier; rating: rating", "gloss", "p") < 0.01);
    CHECK(number("glossier; which: log response time", "objectcow", "estimate") == Approx(0.4).margin(0.08));
}
