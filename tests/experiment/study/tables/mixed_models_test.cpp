/// The script of mixed models, run by R where it is.
#include "experiment/study/tables/mixed_models.h"

#include <cmath>
#include <cstdlib>

#include <catch2/catch.hpp>

#include "experiment/base/whole_file.h"
#include "experiment/study/tables/study_tables.h"
#include "tests/experiment/study/counted_trials.h"
#include "tests/support/skip.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;

namespace {

/// The script writes commas and quotes.
TsvFile table_of(const std::filesystem::path& csv, const TemporaryFolder& folder) {
    std::string text = read_whole_file(csv);
    std::erase(text, '"');
    std::ranges::replace(text, ',', '\t');
    return TsvFile(folder.file("read.tsv", text));
}

std::size_t row_of(const TsvFile& table, const std::string& model, const std::string& term) {
    for (std::size_t row = 0; row < table.size(); ++row) {
        if (table.text(row, "model") == model && table.text(row, "term") == term)
            return row;
    }
    FAIL("there is no row of " << model << ", " << term);
    return 0;
}

} // namespace

TEST_CASE("the script of mixed models names its table and its factors", "[unit]") {
    const TemporaryFolder folder;
    StudyResults results;
    results.by = {"task", "object", "observer", "the \"light\""};
    write_mixed_models(results, folder.path(), TableFormat::tsv);
    const std::string script = read_whole_file(folder.path() / "mixed_models.R");
    CHECK(script.find("strsplit(\"task,the \\\"light\\\"\", \",\"") != script.npos);
    CHECK(script.find("table_file <- \"trials.tsv\"") != script.npos);
    CHECK(script.find("{{") == script.npos);
}

TEST_CASE("mixed models find what was planted in the tables that are written", "[session]") {
    if (std::system("Rscript -e 'library(lme4)' >/dev/null 2>&1") != 0)
        OVERT_SKIP("no R with lme4 here to run the script of mixed models");
    // Material moves the odds of the head by e from one level to the next, and the logarithm of WSS by 0.5;
    // observers have odds and spreads of their own.
    CountedTrials study(
        8,
        [](const TrialOfDesign& trial, RandomStream& random) {
            RandomStream own(3, "observer's own", static_cast<std::uint64_t>(trial.observer));
            const double odds = -0.5 + 0.7 * own.normal() + 1.0 * (trial.material - 1);
            return LooksOfTrial{
                1.0 / (1.0 + std::exp(-odds)),
                20.0 * std::exp(0.25 * trial.material + 0.1 * random.normal() + 0.1 * own.normal())};
        },
        4, 30);
    study.results.by = {"object", "material"};
    study.results.session_quality.resize(study.results.sessions.size());
    const TemporaryFolder folder;
    write_study_tables(study.results, folder.path(), TableFormat::csv);
    REQUIRE(std::system(
                fmt::format("cd / && Rscript {0}/mixed_models.R >{0}/said.txt 2>&1", folder.path().string())
                    .c_str()) == 0);
    INFO(read_whole_file(folder.path() / "said.txt"));
    const TsvFile tests = table_of(folder.path() / "mixed_models_tests.csv", folder);
    CHECK(tests.number(row_of(tests, "share on head", "material"), "p") < 1e-3);
    CHECK(tests.number(row_of(tests, "log WSS", "material"), "p") < 1e-3);
    CHECK(tests.integer(row_of(tests, "log WSS", "material"), "df") == 2);
    // With sum contrasts the first level's coefficient is its difference from the mean of all three.
    const TsvFile terms = table_of(folder.path() / "mixed_models_coefficients.csv", folder);
    const auto check = [&](const std::string& model, double planted) {
        const std::size_t row = row_of(terms, model, "material1");
        const double error = terms.number(row, "standard_error");
        CHECK(std::abs(terms.number(row, "estimate") - planted) < 3.5 * error);
        CHECK(error < 0.3);
    };
    check("share on head", -1.0);
    check("log WSS", -0.5);
}
