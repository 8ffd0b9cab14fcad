/// Lines of what was answered over numbers, and what stays together where the odd one out is chosen.
#include <algorithm>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/ports/given_answer.h"
#include "experiment/study/answers/answer_differences.h"
#include "experiment/study/answers/answer_results.h"

using namespace overt;

namespace {

/// An answer of a search.
StudyAnswer found_in(const std::string& observer, double set_size, const std::string& target, double seconds,
                     bool is_correct) {
    StudyAnswer answer;
    answer.observer = observer;
    answer.task = "search";
    answer.answer = "there";
    answer.kind = "choice";
    answer.value = is_correct ? "present" : "absent";
    answer.is_missed = false;
    answer.is_correct = is_correct;
    answer.response_s = seconds;
    answer.levels = {{"set_size", fmt::format("{}", set_size)}, {"target", target}};
    return answer;
}

const AnswerTrendRow& trend_of(const std::vector<AnswerTrendRow>& rows, const std::string& observer,
                               const std::string& measure, const std::string& target) {
    const auto found = std::ranges::find_if(rows, [&](const AnswerTrendRow& row) {
        return row.of.observer == observer && row.measure == measure && row.along == "set_size" &&
               row.level == target;
    });
    REQUIRE(found != rows.end());
    return *found;
}

/// A trial with stimuli of these materials, of which the one at `odd` was chosen.
StudyAnswer odd_one(const std::string& observer, const std::vector<std::string>& materials, int odd) {
    StudyAnswer answer;
    answer.observer = observer;
    answer.task = "odd";
    answer.answer = "which";
    answer.kind = std::string(odd_one_out_kind);
    for (std::size_t i = 0; i < materials.size(); ++i)
        answer.shown.push_back({fmt::format("place-{}", i + 1), {{"material", materials[i]}}, {}});
    answer.is_missed = odd < 0;
    if (odd >= 0)
        answer.value = answer.shown[static_cast<std::size_t>(odd)].slot;
    return answer;
}

const AnswerLikenessRow& likeness_of(const std::vector<AnswerLikenessRow>& rows, const std::string& observer,
                                     const std::string& a, const std::string& b) {
    const auto found = std::ranges::find_if(rows, [&](const AnswerLikenessRow& row) {
        return row.of.observer == observer && row.a == a && row.b == b;
    });
    REQUIRE(found != rows.end());
    return *found;
}

} // namespace

TEST_CASE("response times of answers that are not wrong have a line over the set size, by target", "[unit]") {
    std::vector<StudyAnswer> answers;
    // 0.5 s and 20 ms for each stimulus where the target is there, 50 ms where it is not; the second observer
    // is slower by 0.2 s, and has one wrong answer that would spoil any line.
    for (const auto& [observer, more] : {std::pair("P01", 0.0), std::pair("P02", 0.2)})
        for (const double size : {2.0, 4.0, 8.0}) {
            answers.push_back(found_in(observer, size, "present", 0.5 + more + 0.02 * size, true));
            answers.push_back(found_in(observer, size, "absent", 0.5 + more + 0.05 * size, true));
        }
    answers.push_back(found_in("P02", 8.0, "present", 9.0, false));
    const std::vector<AnswerTrendRow> rows = answer_trends(answers_by(answers), {});
    const std::string time = "mean response time / s";
    CHECK(*trend_of(rows, "P01", time, "present").slope.value == Approx(0.02));
    CHECK(*trend_of(rows, "P02", time, "absent").slope.value == Approx(0.05));
    CHECK(*trend_of(rows, "P02", time, "present").intercept.value == Approx(0.7));
    const AnswerTrendRow& all = trend_of(rows, "", time, "");
    CHECK(*all.slope.value == Approx(0.035));
    CHECK(*all.intercept.value == Approx(0.6));
    CHECK(all.observers == 2);
    CHECK(all.answers == 12);
    REQUIRE(all.points.size() == 3);
    CHECK(all.points.back().x == 8.0);
    CHECK(*all.points.back().mean.value == Approx(0.6 + 0.035 * 8.0));
    // Sizes are in the order of their numbers, and shares of correct answers do not leave 0 to 1.
    const AnswerTrendRow& correct = trend_of(rows, "", "share correct", "present");
    CHECK(*correct.slope.value < 0.0);
    for (const AnswerTrendPoint& point : correct.points)
        if (point.mean.interval) {
            CHECK(point.mean.interval->low >= 0.0);
            CHECK(point.mean.interval->high <= 1.0);
        }
}

TEST_CASE("a line of weighed answers is that of as many answers as they weigh, and equal means have none",
          "[unit]") {
    const StudyAnswer few = found_in("P01", 2.0, "present", 0.4, true),
                      slow = found_in("P01", 2.0, "present", 0.8, true),
                      many = found_in("P01", 4.0, "present", 1.0, true);
    const AnswerList answers{&few, &slow, &many};
    const std::vector<double> weights{3.0, 1.0, 2.0};
    const std::string time = "mean response time / s";
    CHECK(*trend_slope(answers, weights, time, "set_size") == Approx((1.0 - 0.5) / 2.0));
    CHECK(*trend_slope(answers, {}, time, "set_size") == Approx((1.0 - 0.6) / 2.0));
    const StudyAnswer same = found_in("P01", 7.0, "present", 0.4, true);
    CHECK(*trend_slope({&few, &same}, {}, time, "set_size") == 0.0);
    CHECK_FALSE(trend_slope({&few, &slow}, {}, time, "set_size"));
    CHECK_FALSE(trend_slope(answers, {}, "no such measure", "set_size"));
}

TEST_CASE("two stay together where neither is the odd one out", "[unit]") {
    const std::vector<StudyAnswer> answers{
        odd_one("P01", {"gold", "steel", "chalk"}, 2), odd_one("P01", {"chalk", "gold", "steel"}, 0),
        odd_one("P01", {"gold", "steel", "chalk"}, 0), odd_one("P02", {"gold", "steel", "chalk"}, 2),
        odd_one("P02", {"gold", "gold", "chalk"}, 2),  odd_one("P02", {"gold", "steel", "chalk"}, -1),
        odd_one("P03", {"gold", "steel", "chalk"}, 2)};
    StudyOptions options;
    options.resamples = 200;
    const std::vector<AnswerLikenessRow> rows = answer_likenesses(answers_by(answers), options);
    CHECK(*likeness_of(rows, "P01", "gold", "steel").share.value == Approx(2.0 / 3.0));
    CHECK(likeness_of(rows, "P01", "gold", "steel").trials == 3);
    CHECK(likeness_of(rows, "P01", "chalk", "steel").together == 1);
    CHECK(likeness_of(rows, "P01", "chalk", "gold").together == 0);
    CHECK(*likeness_of(rows, "P02", "gold", "gold").share.value == 1.0);
    // A pair for each of the two that are alike.
    CHECK(likeness_of(rows, "P02", "chalk", "gold").trials == 3);
    // Observers count alike, however many trials they had; a missed answer is none.
    const AnswerLikenessRow& all = likeness_of(rows, "", "gold", "steel");
    CHECK(*all.share.value == Approx((2.0 / 3.0 + 1.0 + 1.0) / 3.0));
    CHECK(all.trials == 5);
    CHECK(all.chance == Approx(1.0 / 3.0));
    REQUIRE(all.share.interval);
    CHECK(all.share.interval->high <= 1.0);
    // No observer ever kept these together: how seldom that is is still not known exactly.
    const AnswerLikenessRow& never = likeness_of(rows, "", "chalk", "gold");
    CHECK(*never.share.value == 0.0);
    CHECK(never.share.interval->high > 0.3);
    // Each answer counts by its weight.
    const std::vector<double> weights{1.0, 0.0, 3.0};
    const std::vector<const StudyAnswer*> three{&answers[0], &answers[1], &answers[2]};
    CHECK(likeness_shares(three, weights).at({"material", {"gold", "steel"}}) == Approx(0.25));
    // A choice of what one likes best says nothing of that kind.
    StudyAnswer liked = answers[0];
    liked.kind = "choice";
    CHECK(answer_likenesses(answers_by(std::vector{liked}), {}).empty());
}

TEST_CASE("an interval is cut off where the quantity cannot be", "[unit]") {
    const Estimate share = Estimate::of(0.7, Interval{0.3, 1.1}).cut_to(zero_to_one);
    CHECK(*share.interval == Interval{0.3, 1.0});
    CHECK(*share.value == 0.7);
    CHECK_FALSE(Estimate::none("nobody").cut_to(zero_to_one).interval);
}
