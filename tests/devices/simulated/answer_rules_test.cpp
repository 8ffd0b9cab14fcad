/// What simulated observers answer where little is known, where effects hold in a part of what is shown, and
/// at the bounds of time.
#include <cmath>

#include <catch2/catch.hpp>

#include "devices/simulated/simulated_answers.h"
#include "experiment/statistics/distributions.h"
#include "tests/devices/simulated/sided_protocol.h"

using namespace overt;
using test::kind_named;
using test::sided;
using test::trial_of;

namespace {

/// Of the answer at a place of the protocol's only task.
std::vector<double> shares_of(const Protocol& protocol, std::size_t answer, const Trial& trial) {
    const SimulatedAnswers answers(protocol, 11);
    return answers.expected(offer_of(protocol, protocol.tasks[0].answers[answer], "", trial), trial).shares;
}

void check_shares(const std::vector<double>& found, const std::vector<double>& known) {
    REQUIRE(found.size() == known.size());
    for (std::size_t i = 0; i < known.size(); ++i) {
        CAPTURE(i);
        CHECK(found[i] == Approx(known[i]).margin(2e-3));
    }
}

} // namespace

TEST_CASE("what is right is chosen by its share, the others alike, and all alike where nothing is right",
          "[unit]") {
    Protocol protocol = sided();
    TaskAnswer& right = protocol.tasks[0].answers[3];
    const Trial trial = trial_of(0, 1, 2);
    for (const auto& [correct, known] : {std::pair("metal", std::vector{0.6, 0.2, 0.2}),
                                         {"stone", {0.2, 0.6, 0.2}},
                                         {"glass", {0.2, 0.2, 0.6}},
                                         {"none", {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}}}) {
        CAPTURE(correct);
        right.correct = correct;
        check_shares(shares_of(protocol, 3, trial), known);
    }
    right.truth.lapses = 0.3;
    right.correct = "metal";
    check_shares(shares_of(protocol, 3, trial), {0.1 + 0.7 * 0.6, 0.1 + 0.7 * 0.2, 0.1 + 0.7 * 0.2});
    // Of one choice nothing else can be meant.
    right.truth.lapses = 0.0;
    right.choices = {"metal"};
    right.keys = {"a"};
    check_shares(shares_of(protocol, 3, trial), {1.0});
    const SimulatedAnswers answers(protocol, 11);
    AnswerOffer offer = offer_of(protocol, right, "", trial);
    for (int i = 0; i < 20; ++i)
        CHECK(answers.answer(offer, trial_of(i, 1, 2)).choice == 0);
    // An answer that the task does not know.
    offer.id = "unknown";
    offer.values = {"one", "two", "three", "four"};
    check_shares(answers.expected(offer, trial).shares, {0.25, 0.25, 0.25, 0.25});
}

TEST_CASE("odds and slopes of an effect hold where all that is shown has it, in its task", "[unit]") {
    Protocol protocol = sided();
    TaskAnswer& which = protocol.tasks[0].answers[0];
    which.truth = AnswerTruth();
    which.truth.by = "gloss";
    which.truth.slope = 0.5;
    SimulatedEffect effect;
    effect.entries[0] = "cow";
    effect.answer = "which";
    effect.answer_slope = 2.0;
    protocol.simulated_effects = {effect};
    const auto share_right = [&](int left_object, int right_object) {
        Trial trial = trial_of(0, 1, 3, left_object);
        trial.beside[0].stimulus.object = right_object;
        return shares_of(protocol, 0, trial).at(1);
    };
    CHECK(share_right(0, 0) == Approx(normal_probability(1.0)).margin(2e-3));
    CHECK(share_right(1, 0) == Approx(normal_probability(1.0)).margin(2e-3));
    CHECK(share_right(0, 1) == Approx(normal_probability(1.0)).margin(2e-3));
    CHECK(share_right(1, 1) == Approx(normal_probability(2.0)).margin(2e-3));
    protocol.simulated_effects[0].task = "another";
    CHECK(share_right(1, 1) == Approx(normal_probability(1.0)).margin(2e-3));
    protocol.simulated_effects[0].task = "judge";
    CHECK(share_right(1, 1) == Approx(normal_probability(2.0)).margin(2e-3));
    protocol.simulated_effects[0].answer = "word";
    CHECK(share_right(1, 1) == Approx(normal_probability(1.0)).margin(2e-3));
    // Odds of 0.6 are 1.5, and four times that 6.
    protocol.simulated_effects[0].answer = "right";
    protocol.simulated_effects[0].answer_odds = 4.0;
    check_shares(shares_of(protocol, 3, trial_of(0, 1, 2, 1)), {0.5 / 7.0, 6.0 / 7.0, 0.5 / 7.0});
    check_shares(shares_of(protocol, 3, trial_of(0, 1, 2, 0)), {0.2, 0.6, 0.2});
}

TEST_CASE("an answer that is late comes 0.15 s after its window, where that has an end", "[unit]") {
    Protocol protocol = sided();
    AnswerTruth& truth = protocol.tasks[0].answers[0].truth;
    truth.log_sd = 0.0;
    truth.shift_s = 0.1;
    truth.median_s = 0.5;
    const Trial trial = trial_of(0, 3, 2);
    const auto after_s = [&](double late, std::optional<double> limit_s) {
        truth.late = late;
        TaskAnswer& which = protocol.tasks[0].answers[0];
        which.limit_s = limit_s;
        const auto given = SimulatedAnswers(protocol, 11).answer(offer_of(protocol, which, "", trial), trial);
        CHECK(given.is_late == (late > 0.0 && limit_s));
        return to_seconds(given.after);
    };
    CHECK(after_s(0.0, std::nullopt) == Approx(0.6));
    CHECK(after_s(0.0, 2.5) == Approx(0.6));
    CHECK(after_s(1.0, std::nullopt) == Approx(0.6));
    CHECK(after_s(1.0, 2.5) == Approx(2.65));
    // A level that makes it quicker than at once takes no more than all of the shift away.
    truth.time_by = "gloss";
    truth.time_gain_s = -0.2;
    CHECK(after_s(0.0, std::nullopt) == Approx(0.5));
    const SimulatedAnswers answers(protocol, 11);
    CHECK(answers.expected(offer_of(protocol, protocol.tasks[0].answers[0], "", trial), trial).after_s ==
          Approx(0.5));
}

TEST_CASE("a number with one end is judged between that and zero, and set in steps however small", "[unit]") {
    Protocol protocol = sided();
    protocol.tasks[0].answers.resize(1);
    TaskAnswer& number = protocol.tasks[0].answers[0];
    number = TaskAnswer();
    number.id = "number";
    number.kind = kind_named("number");
    const Trial trial = trial_of(0, 3, 2);
    const auto said = [&] {
        const SimulatedAnswers answers(protocol, 11);
        const AnswerOffer offer = offer_of(protocol, number, "", trial);
        const std::optional<double> number_said = answers.answer(offer, trial).number;
        CHECK(answers.expected(offer, trial).mean.has_value() == number_said.has_value());
        return number_said;
    };
    CHECK_FALSE(said());
    number.max = 30.0;
    CHECK(said() == 15.0);
    number.max.reset();
    number.min = -10.0;
    CHECK(said() == -5.0);
    number.min.reset();
    number.truth.offset = 0.8;
    CHECK(said() == 0.8);
    number.step = 0.5;
    CHECK(said() == 1.0);
    number.min = 0.2;
    CHECK(said() == 0.7);
    number.truth.offset.reset();
    number.min.reset();
    number.step.reset();
    number.truth.by = "gloss";
    CHECK(said() == 3.0);
}

TEST_CASE("a scale of one step has no way between its steps", "[unit]") {
    Protocol protocol = sided();
    TaskAnswer scale;
    scale.id = "scale";
    scale.kind = kind_named("scale");
    for (const int steps : {1, 2}) {
        scale.steps = steps;
        scale.min = 1.0;
        scale.max = 4.0;
        const AnswerOffer offer = offer_of(protocol, scale, "", trial_of(0, 1, 2));
        CHECK(offer.numbers.size() == static_cast<std::size_t>(steps));
        CHECK(offer.step == (steps == 1 ? 0.0 : 3.0));
    }
}

TEST_CASE(
    "observers look at what is dear to them before the first choice of words, and of slots that are lit",
    "[unit]") {
    Protocol protocol = sided();
    const std::vector<std::string> areas{"head", "rim"};
    TaskAnswer word = protocol.tasks[0].answers[1];
    word.truth.look_area = "rim";
    word.truth.look_odds = 3.0;
    TaskAnswer unasked = protocol.tasks[0].answers[2]; // no choice
    unasked.truth.look_area = "head";
    const TaskAnswer which = protocol.tasks[0].answers[0];
    protocol.tasks[0].answers = {unasked, word};
    const SimulatedAnswers answers(protocol, 3);
    int first = 0;
    for (int i = 0; i < 60; ++i) {
        const Trial trial = trial_of(i, i % 4, (i + 1) % 4);
        const int chosen = answers.answer(offer_of(protocol, word, "", trial), trial).choice;
        const GazeFavour favour = answers.favour_of(trial, areas);
        first += chosen == 0;
        CHECK(favour.slot == -1);
        CHECK(favour.area == (chosen == 0 ? 1 : -1));
        CHECK(favour.odds == (chosen == 0 ? 3.0 : 1.0));
    }
    CHECK(first > 5);
    CHECK(first < 55);
    // A choice of slots of which the first is not lit is not made yet; another answer's may be.
    TaskAnswer slots = which;
    slots.truth.look_share = 0.7;
    protocol.tasks[0].answers = {slots};
    Trial right_alone = trial_of(0, 0, 3);
    right_alone.slot = 1;
    right_alone.beside.clear();
    REQUIRE(right_alone.shown(0).slot == 1);
    CHECK(SimulatedAnswers(protocol, 3).favour_of(right_alone, areas).slot == -1);
    protocol.tasks[0].answers = {slots, word};
    CHECK(SimulatedAnswers(protocol, 3).favour_of(right_alone, areas).slot == -1);
    CHECK(SimulatedAnswers(protocol, 3).favour_of(trial_of(0, 0, 3), areas).share == 0.7);
}

TEST_CASE("what is answered on average is known to the last figure", "[unit]") {
    Protocol protocol = sided();
    protocol.slots.resize(3);
    protocol.slots[2].id = "third";
    protocol.tasks[0].answers[0].choices = {"left", "right", "third"};
    protocol.tasks[0].answers[0].keys = {"f", "g", "h"};
    Trial trial = trial_of(0, 1, 2);
    trial.beside.push_back({{0, 3, 0, 0, 0}, 2});
    const SimulatedAnswers answers(protocol, 11);
    std::vector<double> found;
    for (const TaskAnswer& answer : protocol.tasks[0].answers) {
        const SimulatedAnswers::Expected expected =
            answers.expected(offer_of(protocol, answer, "", trial), trial);
        found.insert(found.end(), expected.shares.begin(), expected.shares.end());
        if (expected.mean)
            found.push_back(*expected.mean);
    }
    std::string all;
    for (const double number : found)
        all += fmt::format("{:.12g}, ", number);
    INFO(all);
    const std::vector<double> known{0.0913927626007,
                                    0.206242956942,
                                    0.702332728125,
                                    0.224003192058,
                                    0.363997213103,
                                    0.411999594838,
                                    2.51371571072,
                                    0.2,
                                    0.6,
                                    0.2};
    REQUIRE(found.size() == known.size());
    for (std::size_t i = 0; i < known.size(); ++i)
        CHECK(found[i] == Approx(known[i]).epsilon(1e-10));
}

TEST_CASE("of two choices of which one is right, it is chosen by its share", "[unit]") {
    Protocol protocol = sided();
    TaskAnswer& right = protocol.tasks[0].answers[3];
    right.choices = {"metal", "stone"};
    right.keys = {"a", "b"};
    const SimulatedAnswers answers(protocol, 5);
    int stones = 0;
    constexpr int often = 4000;
    for (int i = 0; i < often; ++i) {
        const Trial trial = trial_of(i, 1, 1);
        stones += answers.answer(offer_of(protocol, right, "", trial), trial).choice == 1;
    }
    CHECK(std::abs(stones - 0.6 * often) < 4.0 * std::sqrt(0.6 * 0.4 * often));
    const Trial trial = trial_of(0, 1, 1);
    CHECK(answers.expected(offer_of(protocol, right, "", trial), trial).shares[1] == Approx(0.6));
    CHECK(answers.expected(offer_of(protocol, right, "", trial), trial).shares[0] == Approx(0.4));
}

TEST_CASE("words go by a factor from zero on where nothing says from where", "[unit]") {
    Protocol protocol = sided();
    TaskAnswer& word = protocol.tasks[0].answers[1];
    word.truth.offset.reset();
    word.truth.lapses = 0.0;
    word.truth.bias = 0.0;
    word.truth.slope = 0.5;
    for (const int level : {0, 1, 3}) {
        // From the middle of three words, by half a word a level, with a standard deviation of one.
        const double middle = 1.0 + 0.5 * level;
        const double first = normal_probability(0.5 - middle), two = normal_probability(1.5 - middle);
        check_shares(shares_of(protocol, 1, trial_of(0, level, 0)), {first, two - first, 1.0 - two});
    }
}
