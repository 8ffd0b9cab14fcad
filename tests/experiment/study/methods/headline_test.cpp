/// The sentences at the head of a study's page: what was asked and varied, and the first result.
#include "experiment/study/methods/headline.h"

#include <tuple>

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace overt;
using Catch::Contains;

namespace {

/// A trial of observer "01" that shows two of a series side by side, and its choice.
void add_pair(StudyResults& results, double left, double right) {
    const int number = static_cast<int>(results.answers.given.size()) + 1;
    StudyAnswer answer;
    answer.observer = "01";
    answer.task = "glossier";
    answer.answer = "which";
    answer.kind = "choice";
    answer.value = "left";
    answer.is_missed = false;
    for (const auto& [slot, level] : {std::pair("left", left), std::pair("right", right)}) {
        const std::string text = fmt::format("{}", level);
        answer.shown.push_back(
            {slot, {{"material", "red-" + text}, {"roughness", text}, {"light", "hall"}}, {}});
        StudyTrial& presentation = results.trials.emplace_back();
        presentation.number = number;
    }
    results.answers.given.push_back(answer);
}

StudyResults study_of_pairs() {
    StudyResults results;
    results.by = {"material"};
    results.sessions.emplace_back().observer = "01";
    for (const double left : {0.1, 0.2, 0.3})
        for (const double right : {0.1, 0.2, 0.3})
            if (left != right)
                add_pair(results, left, right);
    results.glance.observers = 1;
    results.glance.trials = static_cast<int>(results.trials.size());
    return results;
}

AnswerRatingRow rating_of_all() {
    AnswerRatingRow row;
    row.of = {"", "glossier", "which", ""};
    row.mean = Estimate::of(4.0);
    return row;
}

} // namespace

TEST_CASE("a series is one thing that differs, and trials of two stimuli are counted as trials", "[unit]") {
    StudyResults results = study_of_pairs();
    const StudyHeadline headline = study_headline(results, {});
    CHECK(headline.design == "6 trials with 2 stimuli each; what differs is roughness (3 levels).");
    CHECK_THAT(headline.sample, Contains("no presentation excluded"));
    // Numbers that not all of the entries have are another thing.
    results.answers.given.front().shown.front().levels[1].second = "n/a";
    CHECK_THAT(study_headline(results, {}).design, Contains("material (3 levels) and roughness (3 levels)"));
}

TEST_CASE("a difference between levels is told as a result only where it is beyond chance", "[unit]") {
    StudyResults results = study_of_pairs();
    results.answers.ratings = {rating_of_all()};
    AnswerDifferenceRow difference;
    difference.of = {"", "glossier", "which", ""};
    difference.measure = "mean";
    difference.column = "light";
    difference.a = "hall";
    difference.b = "sky";
    difference.difference = Estimate::of(-0.5, Interval{-0.9, -0.1});
    difference.p_holm = 0.6;
    results.answers.differences = {difference};
    CHECK(study_headline(results, {}).result == "The mean of \"which\" is 4, over 1 observer.");
    results.answers.differences.front().p_holm = 0.01;
    CHECK_THAT(study_headline(results, {}).result,
               Contains("of light hall it is by 0.5 (95 % interval 0.1 to 0.9) lower than of sky"));
}

TEST_CASE("the result of a gauge is how far settings lie from the surface", "[unit]") {
    StudyResults results = study_of_pairs();
    for (StudyAnswer& one : results.answers.given) {
        one.kind = "gauge";
        one.number = 30.0;
    }
    for (const auto& [observer, deviation] :
         {std::pair("", 9.0), std::pair("01", 8.0), std::pair("02", 10.0), std::pair("03", 12.0)}) {
        ReliefRow row;
        row.of.observer = observer;
        row.of.task = "glossier";
        row.of.answer = "which";
        row.settings = 20;
        row.deviation_deg = deviation;
        results.reliefs.reliefs.push_back(row);
    }
    CHECK_THAT(study_headline(results, {}).result,
               Contains("Settings of \"which\" lie 10 deg") && Contains("over 3 observers."));
}

TEST_CASE("where samples are too few to count fixations, the share is that of their time", "[unit]") {
    StudyResults results;
    results.area = "head";
    results.sessions.emplace_back().setup.gaze.rate_hz = 60.0;
    AreaRow& row = results.area_rows.emplace_back();
    row.area = "head";
    row.by_count = Estimate::of(0.31);
    row.by_duration = Estimate::of(0.47);
    row.observers = 4;
    CHECK(rate_too_low_for_counts(results) == 60.0);
    CHECK_THAT(study_headline(results, {}).result, Contains("47 % of the time of fixation is on the head"));
    // What was measured counts, and not what the tracker was set to.
    results.session_quality.emplace_back().rate_hz = 119.6;
    CHECK_FALSE(rate_too_low_for_counts(results));
    CHECK_THAT(study_headline(results, {}).result, Contains("31 % of the fixations lie on the head"));
}

TEST_CASE("the main result of a search is how times grow, and of odd ones what stays together", "[unit]") {
    StudyResults results = study_of_pairs();
    for (const auto& [level, slope] : {std::pair("absent", 0.05), std::pair("present", 0.02)}) {
        AnswerTrendRow row;
        row.of = {"", "glossier", "which", ""};
        row.measure = "mean response time / s";
        row.along = "set_size";
        row.column = "target";
        row.level = level;
        row.slope = Estimate::of(slope);
        results.answers.trends.push_back(row);
    }
    StudyHeadline headline = study_headline(results, {});
    CHECK(headline.measure == "trends");
    CHECK_THAT(headline.result,
               Contains("grow by 50 ms with the target absent and 20 ms with the target present"));
    for (const auto& [a, b, share] : {std::tuple("chalk", "gold", 0.1), std::tuple("gold", "steel", 0.7),
                                      std::tuple("gold", "gold", 0.9)}) {
        AnswerLikenessRow row;
        row.of = {"", "glossier", "which", ""};
        row.factor = "material";
        row.a = a;
        row.b = b;
        row.share = Estimate::of(share);
        row.chance = 1.0 / 3.0;
        results.answers.likenesses.push_back(row);
    }
    headline = study_headline(results, {});
    CHECK(headline.measure == "likenesses");
    CHECK_THAT(headline.result, Contains("gold and steel stay together most often, in 70 %") &&
                                    Contains("chalk and gold least, in 10 %") && Contains("33.3 %"));
}

TEST_CASE("a share in the headline does not leave 0 to 100 per cent", "[unit]") {
    StudyResults results = study_of_pairs();
    const std::vector<StudyAnswer> first = results.answers.given;
    for (const std::string observer : {"02", "03"})
        for (StudyAnswer one : first) {
            one.observer = observer;
            one.value = observer == "02" ? "right" : "left";
            results.answers.given.push_back(one);
        }
    StudyOptions options;
    options.resamples = 200;
    const std::string result = study_headline(results, options).result;
    CHECK_THAT(result, Contains("66.7 %") && Contains("0.314 to 99.9 %)"));
}

TEST_CASE("what differs has factors of the trials' own, and places that were pointed at are a main result",
          "[unit]") {
    StudyResults results = study_of_pairs();
    for (std::size_t i = 0; i < results.answers.given.size(); ++i)
        results.answers.given[i].levels = {{"set_size", i % 2 ? "4" : "8"}, {"light", "hall"}};
    CHECK(study_headline(results, {}).design ==
          "6 trials with 2 stimuli each; what differs is roughness (3 levels) and set_size (2 levels).");
    for (StudyAnswer& one : results.answers.given)
        one.kind = "point";
    PointSpreadRow& row = results.points.spreads.emplace_back();
    row.of = {"", "glossier", "which", 0};
    row.observers = 5;
    row.between_mm = Estimate::of(42.0, Interval{30.0, 54.0});
    row.chance_mm = 140.0;
    const StudyHeadline headline = study_headline(results, {});
    CHECK(headline.measure == "points");
    CHECK_THAT(headline.result,
               Contains("42 mm (95 % interval 30 to 54 mm) apart in the mean, where chance gives "
                        "140 mm, over 5 observers"));
}

TEST_CASE("the questions are those that were asked, of many the first", "[unit]") {
    StudyResults results = study_of_pairs();
    for (const char* id : {"a", "b", "c", "d"}) {
        results.sessions.front().setup.tasks.push_back({id, fmt::format("Question {}?", id)});
        results.trials.emplace_back().keys = {{"task", id}};
    }
    CHECK(study_headline(results, {}).question == "Question a? / Question b? / Question c? / Question d?");
    for (const char* id : {"e", "f"}) {
        results.sessions.front().setup.tasks.push_back({id, fmt::format("Question {}?", id)});
        results.trials.emplace_back().keys = {{"task", id}};
    }
    CHECK(study_headline(results, {}).question == "Question a? / Question b? / Question c? / and 3 more");
}
