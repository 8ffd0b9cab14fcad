/// What follows from answers: shares, thresholds and scales of observers whose truth is known.
#include "experiment/study/answer_results.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/base/random.h"
#include "experiment/statistics/distributions.h"

using namespace overt;

namespace {

AnsweredStimulus gloss_in(const std::string& slot, double level) {
    return {slot, {{"gloss", fmt::format("{}", level)}}, {{"gloss", level}}};
}

StudyAnswer choice_of(const std::string& observer, std::vector<AnsweredStimulus> shown,
                      const std::string& value) {
    StudyAnswer answer;
    answer.observer = observer;
    answer.task = "glossier";
    answer.answer = "which";
    answer.kind = "choice";
    answer.value = value;
    answer.is_missed = value.empty();
    answer.shown = std::move(shown);
    return answer;
}

StudyOptions quick_options() {
    StudyOptions options;
    options.resamples = 200;
    return options;
}

} // namespace

TEST_CASE("a threshold against a standard is found, with its slots exchanged by turns", "[unit]") {
    RandomStream random(1, "answers");
    std::vector<StudyAnswer> answers;
    for (const std::string observer : {"P01", "P02", "P03"})
        for (const double level : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6})
            for (int trial = 0; trial < 60; ++trial) {
                const bool is_left = trial % 2 == 0;
                const double share = 0.5 + 0.5 / (1.0 + std::exp(-20.0 * (level - 0.3)));
                const bool sees = random.uniform() < share;
                answers.push_back(choice_of(
                    observer,
                    {gloss_in("left", is_left ? level : 0.05), gloss_in("right", is_left ? 0.05 : level)},
                    sees == is_left ? "left" : "right"));
            }
    answers.push_back(choice_of("P01", {gloss_in("left", 0.1), gloss_in("right", 0.05)}, ""));
    StudyAnswers study;
    study.given = answers;
    reckon_answers(study, quick_options());
    const auto curve =
        std::ranges::find(study.curves, "P02", [](const AnswerCurveRow& row) { return row.of.observer; });
    REQUIRE(curve != study.curves.end());
    CHECK(curve->guess == 0.5);
    CHECK(curve->factor == "gloss");
    CHECK(curve->threshold.value.value() == Approx(0.3).margin(0.06));
    CHECK(curve->threshold.interval.value().contains(0.3));
    CHECK(curve->trials == 360);
    REQUIRE(study.curves.front().of.observer.empty());
    CHECK(study.curves.front().threshold.value.value() == Approx(0.3).margin(0.04));
    const auto summary = std::ranges::find(study.summaries, "P01",
                                           [](const AnswerSummaryRow& row) { return row.of.observer; });
    CHECK(summary->missed == 1);
    CHECK(summary->trials == 361);
    CHECK_FALSE(summary->correct.value);
    CHECK(study.choices.front().answered == 1080);
}

TEST_CASE("pairs and triads give back the scale of a made-up observer", "[unit]") {
    constexpr double levels[] = {0.1, 0.2, 0.3, 0.4, 0.5}, scale[] = {0.0, 0.1, 0.3, 0.6, 1.0};
    RandomStream random(2, "answers");
    std::vector<StudyAnswer> pairs, triads;
    for (std::size_t a = 0; a < 5; ++a)
        for (std::size_t b = a + 1; b < 5; ++b) {
            for (int trial = 0; trial < 60; ++trial) {
                const bool is_first =
                    random.uniform() < normal_probability(3.0 * (scale[a] - scale[b]) + 0.5);
                pairs.push_back(choice_of("P01", {gloss_in("left", levels[a]), gloss_in("right", levels[b])},
                                          is_first ? "left" : "right"));
                const bool other = random.uniform() < normal_probability(3.0 * (scale[b] - scale[a]) + 0.5);
                pairs.push_back(choice_of("P01", {gloss_in("left", levels[b]), gloss_in("right", levels[a])},
                                          other ? "left" : "right"));
            }
            for (std::size_t c = b + 1; c < 5; ++c)
                for (int trial = 0; trial < 40; ++trial) {
                    const bool is_upper =
                        random.uniform() < normal_probability((scale[a] - 2.0 * scale[b] + scale[c]) / 0.2);
                    const bool is_turned = trial % 2 == 1; // the larger end on the left
                    triads.push_back(
                        choice_of("P01",
                                  {gloss_in("left", levels[is_turned ? c : a]), gloss_in("middle", levels[b]),
                                   gloss_in("right", levels[is_turned ? a : c])},
                                  is_upper == is_turned ? "left" : "right"));
                }
        }
    const std::vector<AnswerScaleRow> of_pairs = answer_scales(answers_by(pairs), quick_options());
    std::vector<double> checked; ///< levels, as the rows stand
    for (const AnswerScaleRow& row : of_pairs) {
        if (row.method != "Thurstone Case V" || row.of.observer.empty())
            continue;
        checked.push_back(std::stod(row.level));
        const auto place = static_cast<std::size_t>(std::lround(10.0 * std::stod(row.level))) - 1;
        CHECK(row.value.value.value() / (3.0 * std::sqrt(2.0)) == Approx(scale[place] - 0.4).margin(0.1));
        CHECK(row.first_slot.value() / std::sqrt(2.0) == Approx(0.5).margin(0.2));
        CHECK(row.trials == 1200);
    }
    REQUIRE(checked.size() >= 5);
    CHECK(std::is_sorted(checked.begin(), checked.begin() + 5));
    const std::vector<AnswerScaleRow> of_triads = answer_scales(answers_by(triads), quick_options());
    REQUIRE(of_triads.size() == 10); // of the observer and of all
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(of_triads[i].method == "MLDS");
        CHECK(of_triads[i].value.value.value() == Approx(scale[i]).margin(0.08));
    }
}

TEST_CASE("ratings have means by level, and over observers of their means", "[unit]") {
    std::vector<StudyAnswer> answers;
    for (const auto& [observer, level, rating] : {std::tuple("P01", 0.1, 1.0), std::tuple("P01", 0.1, 3.0),
                                                  std::tuple("P01", 0.2, 4.0), std::tuple("P02", 0.1, 5.0)}) {
        StudyAnswer answer = choice_of(observer, {gloss_in("", level)}, fmt::format("{}", rating));
        answer.kind = "scale";
        answer.number = rating;
        answers.push_back(std::move(answer));
    }
    const std::vector<AnswerRatingRow> rows = answer_ratings(answers_by(answers), quick_options());
    const auto row = [&](const std::string& observer, const std::string& level) {
        return *std::ranges::find_if(rows, [&](const AnswerRatingRow& one) {
            return one.of.observer == observer && one.level == level;
        });
    };
    CHECK(row("P01", "0.1").mean.value == 2.0);
    CHECK(row("", "0.1").mean.value == 3.5); // of 2 and 5
    CHECK(row("P01", "").ratings == 3);
    CHECK(answer_choices(answers_by(answers), quick_options()).empty());
}

TEST_CASE("steps of a scale give back the places of levels, and pairs in two factors what each adds",
          "[unit]") {
    RandomStream random(6, "answers");
    std::vector<StudyAnswer> ratings, pairs;
    for (const auto& [level, place] : {std::pair(0.1, 0.0), std::pair(0.2, 1.0), std::pair(0.3, 1.5)})
        for (int trial = 0; trial < 400; ++trial) {
            const double seen = place + random.normal();
            StudyAnswer answer = choice_of("P01", {gloss_in("", level)}, "step");
            answer.kind = "scale";
            answer.number = 1.0 + (seen > -0.5) + (seen > 0.5) + (seen > 1.5);
            ratings.push_back(std::move(answer));
        }
    for (const AnswerRatingRow& row : answer_ratings(answers_by(ratings), quick_options()))
        if (row.level == "0.3")
            CHECK(row.place.value() == Approx(1.5).margin(0.25));
    const auto stimulus = [](const std::string& slot, int gloss, int bump) {
        return AnsweredStimulus{slot, {}, {{"bump", 1.0 * bump}, {"gloss", 1.0 * gloss}}};
    };
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            for (int trial = 0; trial < 200; ++trial) {
                const double delta = 0.8 * (i / 2 - j / 2) + 0.4 * (i % 2 - j % 2);
                pairs.push_back(choice_of("P01",
                                          {stimulus("left", i / 2, i % 2), stimulus("right", j / 2, j % 2)},
                                          random.uniform() < normal_probability(delta) ? "left" : "right"));
            }
    int found = 0;
    for (const AnswerScaleRow& row : answer_scales(answers_by(pairs), quick_options())) {
        if (row.method != "MLCM" || row.level != "1")
            continue;
        CHECK(row.value.value.value() == Approx(row.factor == "gloss" ? 0.8 : 0.4).margin(0.15));
        ++found;
    }
    CHECK(found == 4); // of the observer and of all
}
