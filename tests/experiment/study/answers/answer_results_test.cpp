/// What follows from answers: shares, thresholds and scales of observers whose truth is known.
#include "experiment/study/answers/answer_results.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/base/random.h"
#include "experiment/statistics/distributions.h"
#include "experiment/study/answers/answer_designs.h"
#include "experiment/study/answers/answer_differences.h"

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

TEST_CASE("choices between two marked places give a scale of the places of a list", "[unit]") {
    RandomStream random(5, "places");
    const std::vector<double> worth{-1.0, 0.0, 0.4, 1.2};
    std::vector<StudyAnswer> answers;
    for (int trial = 0; trial < 1200; ++trial) {
        const std::size_t first = random.below(4), second = (first + 1 + random.below(3)) % 4;
        const double share = 1.0 / (1.0 + std::exp(worth[second] - worth[first]));
        StudyAnswer& one = answers.emplace_back(
            choice_of(trial % 2 ? "P01" : "P02", {{}}, random.uniform() < share ? "red" : "green"));
        // Places 9 to 12: in the order of their numbers, not of the alphabet. The list's name has a dot.
        one.levels = {{"red", fmt::format("se.en.{}", 9 + first)},
                      {"green", fmt::format("se.en.{}", 9 + second)},
                      {"light", "a.1"}};
    }
    answers.push_back(choice_of("P01", {{}}, ""));
    answers.push_back(choice_of("P01", {{}}, "neither"));
    StudyAnswers study;
    study.given = answers;
    reckon_answers(study, quick_options());
    std::vector<AnswerScaleRow> scale;
    std::ranges::copy_if(study.scales, std::back_inserter(scale), [](const AnswerScaleRow& row) {
        return row.method == "Bradley-Terry" && row.of.observer.empty();
    });
    REQUIRE(scale.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(scale[i].factor == "se.en");
        CHECK(scale[i].level == fmt::format("se.en.{}", 9 + i));
        CHECK(scale[i].trials == 1200);
        CHECK(scale[i].value.value.value() == Approx(worth[i] - 0.15).margin(0.25));
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

TEST_CASE("what is set or pointed at is neither rated nor chosen, and n/a is no level", "[unit]") {
    std::vector<StudyAnswer> answers;
    for (const std::string kind : {"match", "gauge", "point", "scale"}) {
        for (const double level : {0.1, 0.2, 0.3}) {
            StudyAnswer answer = choice_of("P01", {gloss_in("", level)}, fmt::format("{} 4", level));
            answer.answer = answer.kind = kind;
            if (kind != "point")
                answer.number = level;
            answers.push_back(std::move(answer));
        }
    }
    answers.back().shown.front().levels.emplace_back("haze", "n/a");
    const AnswersBy by = answers_by(answers);
    for (const AnswerRatingRow& row : answer_ratings(by, quick_options())) {
        CHECK(row.of.answer == "scale");
        CHECK(row.factor != "haze");
    }
    CHECK(answer_ratings(by, quick_options()).size() == 8); // over all and of three levels, P01's and all
    CHECK(answer_choices(by, quick_options()).empty());
    CHECK(answer_curves(by, quick_options()).empty());
}

TEST_CASE("functions of pairs are not parted by the side, and intervals of single answers have a width",
          "[unit]") {
    // Each pair both ways round, once: rising, but for some answers.
    const auto answered = [](const std::vector<std::pair<double, double>>& against) {
        std::vector<StudyAnswer> answers;
        for (const double one : {0.05, 0.1, 0.2, 0.4})
            for (const double other : {0.05, 0.1, 0.2, 0.4}) {
                if (one == other)
                    continue;
                const bool is_against = std::ranges::find(against, std::pair(one, other)) != against.end();
                answers.push_back(choice_of("P01", {gloss_in("left", one), gloss_in("right", other)},
                                            (one > other) != is_against ? "left" : "right"));
                answers.back().levels = {{"side", one < other ? "left" : "right"},
                                         {"object", one + other < 0.4 ? "cow" : "bust"}};
            }
        return answers;
    };
    const auto curves_of = [&](const std::vector<StudyAnswer>& answers) {
        const std::vector<AnswerCurveRow> curves = answer_curves(answers_by(answers), quick_options());
        for (const AnswerCurveRow& row : curves)
            CHECK(row.column != "side");
        for (const AnswerDifferenceRow& row : answer_differences(answers_by(answers), quick_options()))
            CHECK(row.column != "side");
        return *std::ranges::find_if(
            curves, [](const AnswerCurveRow& row) { return row.of.observer == "P01" && row.column.empty(); });
    };
    const AnswerCurveRow flat = curves_of(answered({{0.1, 0.2}, {0.2, 0.1}, {0.4, 0.2}, {0.05, 0.1}}));
    REQUIRE(flat.threshold.interval);
    CHECK(flat.threshold.interval->high - flat.threshold.interval->low > 0.05);
    CHECK_THAT(flat.note, Catch::Contains("interval from the fitted function"));
    // Nearly a step: samples of it mostly are one, and there is no interval rather than one without a width.
    const AnswerCurveRow steep = curves_of(answered({{0.1, 0.2}}));
    CHECK(steep.threshold.value);
    CHECK_FALSE(steep.threshold.interval);
    CHECK_THAT(steep.note, Catch::Contains("no interval: most samples"));
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

namespace {

/// Answers "glossy" or "matt" to one stimulus, by its level and by the object it is on.
StudyAnswer word_answer(const std::string& observer, double level, const std::string& object,
                        bool is_glossy) {
    StudyAnswer answer = choice_of(observer, {gloss_in("", level)}, is_glossy ? "glossy" : "matt");
    answer.shown.front().levels.emplace_back("object", object);
    answer.levels = answer.shown.front().levels;
    answer.response_s = 0.5 + (object == "cow" ? 0.2 : 0.0);
    return answer;
}

/// Of observers whose thresholds are so much higher for the cow than for the bust.
std::vector<StudyAnswer> word_answers(int observers, double of_cow, std::uint64_t seed) {
    RandomStream random(seed, "words");
    std::vector<StudyAnswer> answers;
    for (int observer = 0; observer < observers; ++observer) {
        const double own = 0.3 + 0.03 * random.normal();
        for (const double level : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6})
            for (const std::string object : {"bust", "cow"})
                for (int trial = 0; trial < 30; ++trial) {
                    const double threshold = own + (object == "cow" ? of_cow : 0.0);
                    answers.push_back(
                        word_answer(fmt::format("P{:02}", observer), level, object,
                                    random.uniform() < 1.0 / (1.0 + std::exp(-20.0 * (level - threshold)))));
                }
    }
    return answers;
}

const AnswerDifferenceRow& difference_row(const std::vector<AnswerDifferenceRow>& rows,
                                          const std::string& measure) {
    const auto found = std::ranges::find_if(rows, [&](const AnswerDifferenceRow& row) {
        return row.measure == measure && row.column == "object";
    });
    REQUIRE(found != rows.end());
    return *found;
}

} // namespace

TEST_CASE("a threshold that differs between levels of another factor is found, a less b, and none else",
          "[unit]") {
    const std::vector<StudyAnswer> answers = word_answers(8, 0.1, 3);
    const AnswersBy by = answers_by(answers);
    const std::vector<AnswerDifferenceRow> rows = answer_differences(by, quick_options());
    const AnswerDifferenceRow& threshold = difference_row(rows, "threshold of gloss");
    CHECK(threshold.a == "bust");
    CHECK(threshold.b == "cow");
    CHECK(threshold.difference.value.value() == Approx(-0.1).margin(0.02));
    CHECK(threshold.difference.interval.value().contains(-0.1));
    CHECK(threshold.p.value() == Approx(2.0 / 256.0));
    CHECK(threshold.p_holm.value() >= threshold.p.value());
    CHECK(threshold.observers == 8);
    CHECK(difference_row(rows, "median response time / s").difference.value.value() == Approx(-0.2));
    // Glossy is the first choice by its letters, and is said less often of the cow.
    CHECK(difference_row(rows, "share of glossy").difference.value.value() > 0.1);
    // Functions of each level stand beside that of all.
    std::vector<std::string> levels;
    for (const AnswerCurveRow& row : answer_curves(by, quick_options())) {
        if (!row.of.observer.empty())
            continue;
        double counted = 0.0;
        for (const AnswerCurvePoint& point : row.points) {
            counted += point.trials;
            CHECK(point.share.low <= point.yes / point.trials);
            CHECK(point.share.high >= point.yes / point.trials);
        }
        CHECK(counted == row.trials);
        CHECK(row.points.size() == 6);
        levels.push_back(row.level);
        if (row.level == "cow")
            CHECK(row.threshold.value.value() == Approx(0.4).margin(0.04));
    }
    CHECK(levels == std::vector<std::string>{"", "bust", "cow"});
    // Without a difference there is none to be found.
    const std::vector<StudyAnswer> alike = word_answers(8, 0.0, 4);
    const auto none = answer_differences(answers_by(alike), quick_options());
    CHECK(difference_row(none, "threshold of gloss").p.value() > 0.05);
}

TEST_CASE("columns that part answers alike are compared once, numbers before words", "[unit]") {
    std::vector<StudyAnswer> answers = word_answers(1, 0.0, 5);
    for (StudyAnswer& one : answers)
        one.levels.emplace_back("animal", one.level("object") == "cow" ? "yes" : "no");
    AnswerList list;
    for (const StudyAnswer& one : answers)
        list.push_back(&one);
    std::vector<std::string> names;
    for (const ComparedColumn& column : compared_columns(list))
        names.push_back(column.name);
    CHECK(names == std::vector<std::string>{"gloss", "object"});
    CHECK(answers_in(list, "object", "cow").size() == list.size() / 2);
}

TEST_CASE("designs are told by what was shown, and have their own d'", "[unit]") {
    const auto in = [](const std::string& slot, const std::string& level) {
        return AnsweredStimulus{slot, {{"material", level}}, {}};
    };
    const auto judged = [](std::vector<AnsweredStimulus> shown, const std::string& value,
                           const std::string& correct) {
        StudyAnswer answer = choice_of("P01", std::move(shown), value);
        answer.correct = correct;
        answer.is_correct = value == correct;
        return answer;
    };
    const auto of = [](const std::vector<StudyAnswer>& answers) {
        AnswerList list;
        for (const StudyAnswer& one : answers)
            list.push_back(&one);
        return list;
    };
    std::vector<StudyAnswer> same, abx, odd, three;
    for (int i = 0; i < 200; ++i) {
        const bool is_right = i % 5 != 0, is_same = i % 2 == 0;
        const std::string right = is_same ? "same" : "different", wrong = is_same ? "different" : "same";
        same.push_back(judged({in("left", "gold"), in("right", is_same ? "gold" : "clay")},
                              is_right ? right : wrong, right));
        const std::string side = i % 2 == 0 ? "left" : "right", other = i % 2 == 0 ? "right" : "left";
        abx.push_back(
            judged({in("top", "gold"), in(side, "gold"), in(other, "clay")}, is_right ? side : other, side));
        const std::string places[] = {"left", "top", "right"};
        const std::string &place = places[i % 3], &next = places[(i + 1) % 3], &last = places[(i + 2) % 3];
        const bool is_gold = i % 2 == 0; // either kind is the odd one by turns
        odd.push_back(judged({in(place, is_gold ? "gold" : "clay"), in(next, is_gold ? "clay" : "gold"),
                              in(last, is_gold ? "clay" : "gold")},
                             is_right ? place : next, place));
        three.push_back(
            judged({in(place, "gold"), in(next, "clay"), in(last, "clay")}, is_right ? place : next, place));
    }
    const auto check = [&](const std::vector<StudyAnswer>& answers, const std::string& name, double d_prime) {
        const std::optional<AnswerDesign> design = answer_design(of(answers));
        REQUIRE(design);
        CHECK(design->name() == name);
        CHECK(d_prime_by(*design, of(answers)).value().d_prime == Approx(d_prime).margin(1e-6));
    };
    // 160 of 200 right, after the log-linear correction; of same-different 80 of 100 hits and 20 false
    // alarms.
    constexpr double share = 160.5 / 201.0;
    check(same, "same-different, differencing", d_prime_same_different(80.5 / 101.0, 20.5 / 101.0).value());
    check(abx, "ABX, differencing", d_prime_of_share(DetectionDesign::abx_differencing, share).value());
    check(odd, "oddity of three", d_prime_of_share(DetectionDesign::oddity, share).value());
    check(three, "3 alternatives", d_prime_of_share(DetectionDesign::alternatives, share, 3).value());
    // Two slots of which one is right are two alternatives, and no other design.
    std::vector<StudyAnswer> two;
    for (int i = 0; i < 20; ++i)
        two.push_back(judged({in("left", i % 2 ? "gold" : "clay"), in("right", i % 2 ? "clay" : "gold")},
                             "left", i % 2 ? "left" : "right"));
    CHECK_FALSE(answer_design(of(two)));
}

TEST_CASE("times have their distribution, and slow answers their share of correct ones", "[unit]") {
    RandomStream random(7, "times");
    std::vector<StudyAnswer> answers;
    for (const std::string observer : {"P01", "P02", "P03"})
        for (int trial = 0; trial < 400; ++trial) {
            StudyAnswer answer = choice_of(observer, {gloss_in("", 0.1)}, "yes");
            answer.response_s = 0.3 + std::exp(-1.0 + 0.4 * random.normal());
            answer.correct = "yes";
            // The slower the better.
            answer.is_correct = random.uniform() < (*answer.response_s > 0.668 ? 0.95 : 0.6);
            answers.push_back(std::move(answer));
        }
    const AnswersBy by = answers_by(answers);
    const std::vector<AnswerTimeRow> times = answer_times(by, quick_options());
    const auto row = [&](const std::string& observer, const std::string& which) {
        return *std::ranges::find_if(times, [&](const AnswerTimeRow& one) {
            return one.of.observer == observer && one.which == which;
        });
    };
    CHECK(row("P01", "all").times == 400);
    CHECK(row("P01", "correct").times + row("P01", "wrong").times == 400);
    CHECK(row("P01", "all").median_s.value.value() == Approx(0.668).margin(0.03));
    CHECK(row("P01", "all").shift_s.value() == Approx(0.3).margin(0.08));
    CHECK(row("P01", "all").log_sd.value() == Approx(0.4).margin(0.12));
    // Shifted log-normal times fit better as what they are.
    CHECK(row("P01", "all").log_normal_log_likelihood.value() > row("P01", "all").ex_log_likelihood.value());
    CHECK_FALSE(row("", "all").ex_mu_s);
    const std::vector<AnswerSpeedRow> speeds = answer_speeds(by, quick_options());
    REQUIRE(speeds.size() == 20);
    CHECK(speeds[0].of.observer.empty());
    CHECK(speeds[0].part == 1);
    CHECK(speeds[0].trials == 240);
    CHECK(speeds[0].correct.value.value() == Approx(0.6).margin(0.1));
    CHECK(speeds[4].correct.value.value() == Approx(0.95).margin(0.05));
    CHECK(speeds[0].mean_response_s.value() < speeds[4].mean_response_s.value());
}

TEST_CASE("a track is told in its order, with its reversals, and each condition apart", "[unit]") {
    std::vector<StudyAnswer> answers;
    const auto add = [&](int trial, int track, double level, const std::string& side) {
        StudyAnswer answer = choice_of("P01",
                                       {gloss_in("left", side == "left" ? level : 0.05),
                                        gloss_in("right", side == "left" ? 0.05 : level)},
                                       "left");
        answer.trial = trial;
        answer.procedure = "stairs";
        answer.procedure_factor = "gloss";
        answer.track = track;
        answer.levels = {{"side", side}};
        answers.push_back(std::move(answer));
    };
    int trial = 0;
    for (const double level : {0.5, 0.4, 0.3, 0.3, 0.4, 0.3, 0.2}) {
        add(trial + 1, 1, level, trial % 4 == 0 ? "left" : "right");
        add(trial + 2, 2, 0.6, "right");
        trial += 2;
    }
    const std::vector<AnswerTrackRow> rows = answer_tracks(answers);
    REQUIRE(rows.size() == 14);
    std::vector<double> levels;
    std::vector<int> reversals;
    for (const AnswerTrackRow& row : rows) {
        if (row.track == 2) {
            CHECK_FALSE(row.is_reversal);
            continue;
        }
        levels.push_back(row.level);
        CHECK(row.place == static_cast<int>(levels.size()));
        if (row.is_reversal)
            reversals.push_back(row.place);
    }
    CHECK(levels == std::vector<double>{0.5, 0.4, 0.3, 0.3, 0.4, 0.3, 0.2});
    CHECK(reversals == std::vector<int>{4, 5});
}
