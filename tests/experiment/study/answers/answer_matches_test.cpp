/// Settings of matches by reference, and the line over references: the known answers of a published table.
#include "experiment/study/answers/answer_results.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace overt;

namespace {

StudyAnswer setting_of(const std::string& observer, const std::string& light, double reference,
                       double setting) {
    StudyAnswer answer;
    answer.observer = observer;
    answer.task = "match";
    answer.answer = "gloss";
    answer.kind = "match";
    answer.value = fmt::format("{}", setting);
    answer.number = setting;
    answer.is_missed = false;
    answer.shown = {{"test", {{"roughness", fmt::format("{}", reference)}}, {{"roughness", reference}}}};
    answer.levels = {{"light", light}, {"roughness", fmt::format("{}", reference)}};
    MatchSetting set;
    set.along = "roughness";
    set.start = 0.2;
    set.final = setting;
    set.reference = reference;
    set.changes = 4;
    answer.settings = {set};
    return answer;
}

constexpr double match_references[] = {.05, .10, .15, .20, .25};
constexpr double match_settings[][5] = {{.062, .115, .158, .219, .251},
                                        {.055, .108, .171, .205, .262},
                                        {.060, .121, .149, .213, .244},
                                        {.058, .104, .166, .198, .270}};

StudyOptions few_match_samples() {
    StudyOptions options;
    options.resamples = 200;
    return options;
}

} // namespace

TEST_CASE("settings have their mean, error and deviation by reference, and a line over references",
          "[unit]") {
    StudyAnswers study;
    for (const auto& session : match_settings)
        for (std::size_t i = 0; i < std::size(match_references); ++i)
            study.given.push_back(setting_of("P01", "hall", match_references[i], session[i]));
    StudyAnswer missed = setting_of("P01", "hall", .05, .9);
    missed.is_missed = true;
    study.given.push_back(missed);
    reckon_matches(study, answers_by(study.given), few_match_samples());
    constexpr double means[] = {.05875, .112, .161, .20875, .25675};
    constexpr double sds[] = {.002986, .007528, .009626, .009179, .011529};
    std::size_t found = 0;
    for (const AnswerMatchRow& row : study.matches) {
        if (row.of.observer.empty())
            continue;
        REQUIRE(found < 5);
        CHECK(row.reference == match_references[found]);
        CHECK(*row.match.value == Approx(means[found]));
        CHECK(row.match.interval->contains(means[found]));
        CHECK(*row.constant_error == Approx(means[found] - match_references[found]));
        CHECK(*row.sd == Approx(sds[found]).epsilon(1e-3));
        CHECK(row.settings == 4);
        CHECK(row.mean_changes == Approx(4.0));
        ++found;
    }
    CHECK(found == 5);
    REQUIRE(study.match_lines.size() == 2);
    CHECK(study.match_lines.front().of.observer.empty());
    for (const AnswerMatchLineRow& line : study.match_lines) {
        CHECK(*line.slope.value == Approx(0.985500).epsilon(1e-5));
        CHECK(*line.intercept.value == Approx(0.011625).epsilon(1e-4));
        CHECK(*line.deming_slope == Approx(0.991387).epsilon(1e-5));
        CHECK(line.references == 5);
        CHECK(line.settings == 20);
    }
    REQUIRE(study.match_lines.back().slope.interval);
    CHECK(study.match_lines.back().slope.interval->contains(0.9855));
}

TEST_CASE("settings that all lie on one line tell nothing of how others would scatter", "[unit]") {
    StudyAnswers study;
    for (const double reference : match_references)
        study.given.push_back(setting_of("P01", "hall", reference, 0.5 * reference));
    reckon_matches(study, answers_by(study.given), few_match_samples());
    REQUIRE_FALSE(study.match_lines.empty());
    CHECK(*study.match_lines.front().slope.value == Approx(0.5));
    CHECK_FALSE(study.match_lines.front().slope.interval);
}

TEST_CASE("a mean that is the reference but for rounding has no constant error", "[unit]") {
    StudyAnswers study;
    for (const double setting : {.05, .10, .15})
        study.given.push_back(setting_of("P01", "hall", .10, setting));
    reckon_matches(study, answers_by(study.given), few_match_samples());
    for (const AnswerMatchRow& row : study.matches)
        CHECK(row.constant_error == 0.0);
}

TEST_CASE("constancy is how far settings go from the proximal match to the reference, by either formula",
          "[unit]") {
    StudyAnswers study;
    for (const std::string observer : {"P01", "P02"}) {
        StudyAnswer answer = setting_of(observer, "sky", .42, .38);
        answer.levels.emplace_back("proximal", ".30");
        study.given.push_back(answer);
        // As much of the way from a proximal match above the reference.
        answer = setting_of(observer, "sky", .30, .34);
        answer.shown.front().numbers.emplace_back("proximal", .42);
        study.given.push_back(answer);
        // Without a proximal match, and with one that is the reference, nothing can be told.
        study.given.push_back(setting_of(observer, "hall", .20, .25));
        answer = setting_of(observer, "hall", .30, .25);
        answer.levels.emplace_back("proximal", ".30");
        study.given.push_back(answer);
    }
    reckon_matches(study, answers_by(study.given), few_match_samples());
    const auto line = std::ranges::find_if(study.match_lines, [](const AnswerMatchLineRow& row) {
        return row.of.observer == "P01" && row.column.empty();
    });
    REQUIRE(line != study.match_lines.end());
    // (.38 - .30) / (.42 - .30) = 2 / 3, and the same of the other way.
    CHECK(line->brunswik.value.value() == Approx(2.0 / 3.0).margin(1e-6));
    CHECK(line->thouless.value.value() ==
          Approx(0.5 * (0.702551 + std::log(.34 / .42) / std::log(.30 / .42))).margin(1e-6));
    CHECK(study.match_lines.front().brunswik.value.value() == Approx(2.0 / 3.0).margin(1e-6));
    const auto hall = std::ranges::find_if(study.match_lines, [](const AnswerMatchLineRow& row) {
        return row.of.observer == "P01" && row.level == "hall";
    });
    REQUIRE(hall != study.match_lines.end());
    CHECK_FALSE(hall->brunswik.value);
}

TEST_CASE("lines are told apart by the levels of other factors, and not by the reference's own", "[unit]") {
    StudyAnswers study;
    for (const std::string observer : {"P01", "P02", "P03"})
        for (const double reference : match_references) {
            study.given.push_back(setting_of(observer, "hall", reference, reference));
            study.given.push_back(setting_of(observer, "sky", reference, 0.1 + 0.5 * reference));
        }
    reckon_matches(study, answers_by(study.given), few_match_samples());
    int of_all = 0;
    for (const AnswerMatchLineRow& line : study.match_lines) {
        if (!line.of.observer.empty())
            continue;
        ++of_all;
        CHECK((line.column.empty() || line.column == "light"));
        CHECK(*line.slope.value == Approx(line.column.empty() ? 0.75 : line.level == "hall" ? 1.0 : 0.5));
    }
    CHECK(of_all == 3);
}
