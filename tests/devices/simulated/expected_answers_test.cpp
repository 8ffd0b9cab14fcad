/// What simulated observers answer on average is what they answer often.
#include "devices/simulated/simulated_answers.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/design/rules/trial_rules.h"
#include "experiment/statistics/distributions.h"
#include "tests/devices/simulated/sided_protocol.h"

using namespace overt;
using test::kind_named;
using test::sided;
using test::trial_of;

TEST_CASE("what an observer answers on average is what the same observer answers in many trials", "[unit]") {
    Protocol protocol = sided();
    SimulatedEffect effect;
    effect.entries[0] = "cow";
    effect.answer = "word";
    effect.answer_shift = 0.7;
    protocol.simulated_effects = {effect};
    effect.answer = "steps";
    effect.answer_slope = 1.4;
    effect.answer_shift = 0.0;
    protocol.simulated_effects.push_back(effect);
    const SimulatedAnswers answers(protocol, 11);
    for (const int object : {0, 1})
        for (const TaskAnswer& asked : protocol.tasks[0].answers) {
            const Trial trial = trial_of(0, 1, 2, object);
            const AnswerOffer offer = offer_of(protocol, asked, "", trial);
            const SimulatedAnswers::Expected expected = answers.expected(offer, trial);
            CAPTURE(asked.id, object);
            constexpr int often = 6000;
            std::vector<double> counts(offer.values.size(), 0.0);
            double sum = 0.0;
            for (int i = 0; i < often; ++i) {
                const SimulatedAnswers::Intended given = answers.answer(offer, trial_of(i, 1, 2, object));
                if (given.number)
                    sum += *given.number;
                else
                    counts[static_cast<std::size_t>(given.choice)] += 1.0;
            }
            if (asked.id == "steps") {
                CHECK(expected.mean.value() == Approx(sum / often).margin(0.05));
                CHECK(expected.shares.empty());
                continue;
            }
            double all = 0.0;
            for (std::size_t i = 0; i < counts.size(); ++i) {
                CHECK(expected.shares[i] == Approx(counts[i] / often).margin(0.025));
                all += expected.shares[i];
            }
            CHECK(all == Approx(1.0).margin(1e-3));
        }
}

TEST_CASE("where a rule asks for differences, the pair that lies farther apart is chosen", "[unit]") {
    Protocol protocol = sided();
    Task& task = protocol.tasks[0];
    for (const std::string_view rule : {"triads", "quadruples"}) {
        const std::size_t count = rule == "triads" ? 3 : 4;
        std::size_t kind = 0;
        while (kinds_of<TrialRuleKind>[kind].name != rule)
            ++kind;
        task.trials.rule = static_cast<TrialRuleKind>(kind);
        protocol.slots.resize(count);
        for (std::size_t i = 0; i < count; ++i)
            protocol.slots[i].id = fmt::format("slot_{}", i);
        task.answers[0].choices = {"slot_0", count == 3 ? "slot_2" : "slot_3"};
        task.answers[0].truth.slope = -0.7; // towards less of it: a difference is one all the same
        task.answers[0].truth.bias = 0.2;
        const SimulatedAnswers answers(protocol, 5);
        const auto share_of_first = [&](std::vector<int> levels) {
            Trial trial;
            trial.stimulus.material = levels[0];
            for (std::size_t i = 1; i < levels.size(); ++i)
                trial.beside.push_back({{0, levels[i], 0, 0, 0}, static_cast<int>(i)});
            const AnswerOffer offer = offer_of(protocol, task.answers[0], "", trial);
            return answers.expected(offer, trial).shares[0];
        };
        const auto expected = [&](double first_pair, double second_pair) {
            return 0.05 + 0.9 * normal_probability(0.7 * (first_pair - second_pair) + 0.2);
        };
        CAPTURE(rule);
        if (count == 3) {
            CHECK(share_of_first({0, 1, 3}) == Approx(expected(1, 2)).margin(2e-3));
            CHECK(share_of_first({3, 1, 0}) == Approx(expected(2, 1)).margin(2e-3));
            CHECK(share_of_first({0, 2, 3}) == Approx(expected(2, 1)).margin(2e-3));
        } else {
            CHECK(share_of_first({0, 1, 1, 3}) == Approx(expected(1, 2)).margin(2e-3));
            CHECK(share_of_first({3, 0, 2, 1}) == Approx(expected(3, 1)).margin(2e-3));
        }
    }
}

TEST_CASE("choices mean the same however they go round over the keys, the bias with them", "[unit]") {
    const Protocol protocol = sided();
    const SimulatedAnswers answers(protocol, 12);
    const TaskAnswer& which = protocol.tasks[0].answers[0];
    for (int i = 0; i < 50; ++i) {
        const Trial trial = trial_of(i, i % 4, (i + 1) % 4);
        AnswerOffer offer = offer_of(protocol, which, "", trial);
        const std::string meant = offer.values[static_cast<std::size_t>(answers.answer(offer, trial).choice)];
        std::ranges::reverse(offer.values);
        CHECK(offer.values[static_cast<std::size_t>(answers.answer(offer, trial).choice)] == meant);
    }
}

TEST_CASE("observers lean to what they are going to choose, where the protocol says so", "[unit]") {
    Protocol protocol = sided();
    const std::vector<std::string> areas{"head", "rim"};
    CHECK(SimulatedAnswers(protocol, 3).favour_of(trial_of(0, 0, 3), areas).slot == -1);
    protocol.tasks[0].answers[0].truth.look_share = 0.8;
    protocol.tasks[0].answers[0].truth.look_area = "rim";
    protocol.tasks[0].answers[0].truth.look_odds = 4.0;
    const SimulatedAnswers answers(protocol, 3);
    const TaskAnswer& which = protocol.tasks[0].answers[0];
    for (int i = 0; i < 40; ++i) {
        const Trial trial = trial_of(i, i % 4, (i + 1) % 4);
        const int chosen = answers.answer(offer_of(protocol, which, "", trial), trial).choice;
        const GazeFavour favour = answers.favour_of(trial, areas);
        CHECK(favour.slot == chosen);
        CHECK(favour.share == 0.8);
        CHECK(favour.area == (chosen == 0 ? 1 : -1));
    }
    // Of one of two slots nobody knows yet what will be chosen.
    Trial half = trial_of(0, 0, 3);
    half.beside.clear();
    CHECK(answers.favour_of(half, areas).slot == -1);
    GazePlan plan;
    plan.area_count = 2;
    plan.shares = {0.3, 0.2};
    favour_area(plan, {-1, 0.0, 1, 4.0});
    CHECK(plan.shares[1] / (1.0 - plan.shares[1]) == Approx(4.0 * 0.25));
    CHECK(plan.shares[0] == Approx(0.3 * (1.0 - plan.shares[1]) / 0.8));
}

TEST_CASE("the odd one out is farthest from the others on average as in many trials", "[unit]") {
    Protocol protocol = sided();
    protocol.slots.resize(3);
    protocol.slots[2].id = "third";
    Task& task = protocol.tasks[0];
    task.slots = {"left", "right", "third"};
    TaskAnswer& which = task.answers[0];
    which.kind = kind_named("odd-one-out");
    which.choices = task.slots;
    which.keys = {"1", "2", "3"};
    which.truth.bias = 0.0;
    which.truth.lapses = 0.0;
    const SimulatedAnswers answers(protocol, 5);
    const auto shown = [&](int index) {
        Trial trial = trial_of(index, 0, 1);
        trial.beside.push_back({{0, 3, 0, 0, 0}, 2});
        return trial;
    };
    const AnswerOffer offer = offer_of(protocol, which, "", shown(0));
    const SimulatedAnswers::Expected expected = answers.expected(offer, shown(0));
    std::vector<double> counts(3, 0.0);
    constexpr int often = 6000;
    for (int i = 0; i < often; ++i)
        counts[static_cast<std::size_t>(answers.answer(offer, shown(i)).choice)] += 1.0 / often;
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(expected.shares[i] == Approx(counts[i]).margin(0.025));
    // Of the levels 0, 1 and 3 it is the last, not the largest of any other three.
    CHECK(expected.shares[2] > 0.6);
    CHECK(expected.shares[0] > expected.shares[1]);
}

TEST_CASE("answers come later by as much as the level of their factor says", "[unit]") {
    Protocol protocol = sided();
    AnswerTruth& truth = protocol.tasks[0].answers[0].truth;
    truth.shift_s = 0.3;
    truth.median_s = 0.5;
    truth.log_sd = 0.0;
    truth.time_by = "gloss";
    truth.time_gain_s = 0.04;
    const SimulatedAnswers answers(protocol, 5);
    for (const int level : {0, 3}) {
        const Trial trial = trial_of(0, level, 1);
        const AnswerOffer offer = offer_of(protocol, protocol.tasks[0].answers[0], "", trial);
        CHECK(to_seconds(answers.answer(offer, trial).after) == Approx(0.8 + 0.04 * level).margin(1e-6));
        CHECK(answers.expected(offer, trial).after_s == Approx(0.8 + 0.04 * level));
    }
    // The mean of a log-normal number is above its median.
    protocol.tasks[0].answers[0].truth.log_sd = 0.5;
    const Trial trial = trial_of(0, 0, 1);
    CHECK(answers.expected(offer_of(protocol, protocol.tasks[0].answers[0], "", trial), trial).after_s ==
          Approx(0.3 + 0.5 * std::exp(0.125)));
}

TEST_CASE("an answer is offered with its values, its ends and the step between them", "[unit]") {
    Protocol protocol = sided();
    const Trial trial = trial_of(0, 1, 2);
    TaskAnswer answer = protocol.tasks[0].answers[0];
    answer.limit_s = 2.5;
    AnswerOffer offer = offer_of(protocol, answer, "item", trial);
    CHECK(offer.id == "which");
    CHECK(offer.item == "item");
    CHECK(offer.kind == "choice");
    CHECK(offer.limit_s == 2.5);
    CHECK(offer.values == answer.choices);
    CHECK_FALSE(offer.low);
    TaskAnswer key = answer;
    key.kind = kind_named("key");
    key.choices.clear();
    CHECK(offer_of(protocol, key, "", trial).values == answer.keys);
    TaskAnswer scale;
    scale.id = "scale";
    scale.kind = kind_named("scale");
    scale.steps = 5;
    scale.min = 10.0;
    scale.max = 20.0;
    offer = offer_of(protocol, scale, "", trial);
    CHECK(offer.low == 10.0);
    CHECK(offer.high == 20.0);
    CHECK(offer.step == 2.5);
    CHECK(offer.numbers == std::vector<double>{10.0, 12.5, 15.0, 17.5, 20.0});
    CHECK(offer.values == std::vector<std::string>{"10", "12.5", "15", "17.5", "20"});
    TaskAnswer line = scale;
    line.steps.reset();
    line.step = 0.5;
    offer = offer_of(protocol, line, "", trial);
    CHECK(offer.values.empty());
    CHECK(offer.numbers.empty());
    CHECK(offer.step == 0.5);
    CHECK(offer.low == 10.0);
    TaskAnswer number;
    number.id = "number";
    number.kind = kind_named("number");
    number.min = -3.0;
    offer = offer_of(protocol, number, "", trial);
    CHECK(offer.low == -3.0);
    CHECK_FALSE(offer.high);
    CHECK(offer.step == 0.0);
    number.max = 7.0;
    CHECK(offer_of(protocol, number, "", trial).high == 7.0);
    CHECK(offer_of(protocol, protocol.tasks[0].answers[3], "", trial).correct == "stone");
}

TEST_CASE("a number without ends, or with one alone, is judged where something says around what", "[unit]") {
    Protocol protocol = sided();
    protocol.tasks[0].answers.resize(1);
    TaskAnswer& number = protocol.tasks[0].answers[0];
    number = TaskAnswer();
    number.id = "number";
    number.kind = kind_named("number");
    number.truth.noise = 0.5;
    const Trial trial = trial_of(0, 3, 2);
    const auto mean = [&] {
        const SimulatedAnswers answers(protocol, 11);
        return answers.expected(offer_of(protocol, number, "", trial), trial).mean;
    };
    CHECK_FALSE(mean()); // nobody knows
    number.min = 4.0;    // then around the middle of what is known
    CHECK(mean().value() == Approx(4.0).margin(0.01));
    number.min = -10.0;
    number.max = 30.0;
    CHECK(mean().value() == Approx(10.0).margin(0.01));
    number.truth.offset = 3.0;
    CHECK(mean().value() == Approx(3.0).margin(0.01));
    number.truth.by = "gloss";
    number.truth.gain = 2.0;
    CHECK(mean().value() == Approx(9.0).margin(0.01));
    number.truth.offset.reset();
    CHECK(mean().value() == Approx(6.0).margin(0.01));
    // Cuts part what is judged into steps: of a judgement of 6 with a noise of 0.5 all lies between 4 and 8.
    number.kind = kind_named("scale");
    number.steps = 3;
    number.min = 1.0;
    number.max = 3.0;
    number.truth.cuts = {4.0, 8.0};
    CHECK(mean().value() == Approx(2.0).margin(0.001));
    number.truth.cuts = {2.0, 4.0, 5.0};
    CHECK(mean().value() == Approx(3.0).margin(0.1)); // above them all: the last step
    number.truth.cuts = {6.0, 12.0};
    CHECK(mean().value() == Approx(1.5).margin(0.01));
}

TEST_CASE("what a simulated observer sets of a match follows the reference, and has the noise that is stated",
          "[unit]") {
    Protocol protocol = sided();
    protocol.tasks[0].answers.resize(1);
    TaskAnswer& answer = protocol.tasks[0].answers[0];
    answer = TaskAnswer();
    answer.id = "match";
    AnswerOffer offer;
    offer.id = "match";
    offer.kind = "match";
    OfferedAxis axis;
    for (int k = 0; k <= 1000; ++k)
        axis.values.push_back(0.01 * k);
    axis.start = 900;
    axis.reference = 4.0;
    offer.axes = {axis};
    struct Set {
        double mean = 0.0, sd = 0.0;
    };
    const auto set_values = [&] {
        const SimulatedAnswers answers(protocol, 5);
        constexpr int often = 4000;
        Set set;
        std::vector<double> values;
        for (int i = 0; i < often; ++i) {
            const std::vector<int> at = answers.answer(offer, trial_of(i, 1, 2)).at;
            REQUIRE(at.size() == 1);
            values.push_back(offer.axes[0].values.at(static_cast<std::size_t>(at[0])));
            set.mean += values.back() / often;
        }
        for (const double value : values)
            set.sd += (value - set.mean) * (value - set.mean) / often;
        set.sd = std::sqrt(set.sd);
        return set;
    };
    answer.truth.noise = 0.0;
    answer.truth.gain = 1.0;
    CHECK(set_values().mean == Approx(4.0));
    CHECK(set_values().sd == Approx(0.0).margin(1e-9));
    answer.truth.gain = 0.5;
    CHECK(set_values().mean == Approx(2.0));
    answer.truth.offset = 1.5;
    CHECK(set_values().mean == Approx(3.5));
    answer.truth.start_bias = 0.1; // a tenth of the way to 9
    CHECK(set_values().mean == Approx(4.05));
    answer.truth.start_bias = 0.0;
    answer.truth.noise = 0.4;
    CHECK(set_values().mean == Approx(3.5).margin(4.0 * 0.4 / std::sqrt(4000.0)));
    CHECK(set_values().sd == Approx(0.4).epsilon(0.05));
    // An effect of the object shifts it, and multiplies its slope.
    answer.truth.noise = 0.0;
    SimulatedEffect effect;
    effect.entries[0] = "bust";
    effect.answer = "match";
    effect.answer_shift = 0.25;
    effect.answer_slope = 2.0;
    protocol.simulated_effects = {effect};
    CHECK(set_values().mean == Approx(1.5 + 2.0 * 0.5 * 4.0 + 0.25));
    effect.entries[0] = "cow";
    protocol.simulated_effects = {effect};
    CHECK(set_values().mean == Approx(3.5));
    // Without a reference around the middle, where nothing says around what.
    answer.truth.offset.reset();
    offer.axes[0].reference.reset();
    CHECK(set_values().mean == Approx(5.0));
}

TEST_CASE("an effect on one of the stimuli shifts how it is seen against the other", "[unit]") {
    Protocol protocol = sided();
    TaskAnswer& which = protocol.tasks[0].answers[0];
    which.truth = AnswerTruth();
    which.truth.by = "gloss";
    which.truth.slope = 0.5;
    SimulatedEffect effect;
    effect.entries[1] = "gold_2"; // of materials
    effect.answer = "which";
    effect.answer_shift = 0.6;
    protocol.simulated_effects = {effect};
    const auto share_right = [&](int left, int right) {
        const SimulatedAnswers answers(protocol, 11);
        const Trial trial = trial_of(0, left, right);
        return answers.expected(offer_of(protocol, which, "", trial), trial).shares.at(1);
    };
    // Noise of 1 between the two: the share is normal in the difference of what is seen.
    CHECK(share_right(1, 3) == Approx(normal_probability(1.0)).margin(2e-3));
    CHECK(share_right(3, 1) == Approx(normal_probability(-1.0)).margin(2e-3));
    CHECK(share_right(1, 2) == Approx(normal_probability(0.5 + 0.6)).margin(2e-3));
    CHECK(share_right(2, 1) == Approx(normal_probability(-0.5 - 0.6)).margin(2e-3));
    which.truth.bias = 0.3; // to the first
    CHECK(share_right(1, 3) == Approx(normal_probability(0.7)).margin(2e-3));
    which.truth.lapses = 0.2;
    CHECK(share_right(1, 3) == Approx(0.1 + 0.8 * normal_probability(0.7)).margin(2e-3));
}

TEST_CASE("a number without a lower end is set in steps from zero, and one with it from there", "[unit]") {
    Protocol protocol = sided();
    TaskAnswer& steps = protocol.tasks[0].answers[2];
    steps.truth = AnswerTruth();
    steps.truth.noise = 0.0;
    steps.truth.offset = 3.2;
    const SimulatedAnswers answers(protocol, 3);
    AnswerOffer offer;
    offer.id = "steps";
    offer.kind = "number";
    offer.step = 2.0;
    CHECK(answers.answer(offer, trial_of(0, 1, 2)).number == 4.0);
    offer.low = 1.0;
    CHECK(answers.answer(offer, trial_of(0, 1, 2)).number == 3.0);
    offer.high = 2.5;
    CHECK(answers.answer(offer, trial_of(0, 1, 2)).number == 2.5);
    offer.low = 3.9;
    offer.high.reset();
    CHECK(answers.answer(offer, trial_of(0, 1, 2)).number == 3.9);
}

TEST_CASE("what an observer is inclined to is the same in all its trials, and added to what it sets or says",
          "[unit]") {
    Protocol protocol = sided();
    protocol.tasks[0].answers.resize(1);
    TaskAnswer& answer = protocol.tasks[0].answers[0];
    answer = TaskAnswer();
    answer.id = "set";
    answer.truth.noise = 0.0;
    answer.truth.offset = 5.0;
    answer.truth.observer_sd = 0.7;
    double sum = 0.0, squares = 0.0;
    constexpr int observers = 400;
    for (int seed = 0; seed < observers; ++seed) {
        const SimulatedAnswers answers(protocol, static_cast<std::uint64_t>(seed));
        AnswerOffer number;
        number.id = "set";
        number.kind = "number";
        const double said = answers.answer(number, trial_of(0, 1, 2)).number.value();
        CHECK(answers.answer(number, trial_of(3, 2, 1)).number.value() == said);
        AnswerOffer match;
        match.id = "set";
        match.kind = "match";
        OfferedAxis axis;
        for (int k = 0; k <= 10000; ++k)
            axis.values.push_back(0.001 * k);
        match.axes = {axis};
        const std::vector<int> at = answers.answer(match, trial_of(0, 1, 2)).at;
        CHECK(0.001 * at.at(0) == Approx(said).margin(0.0006));
        sum += (said - 5.0) / observers;
        squares += (said - 5.0) * (said - 5.0) / observers;
    }
    CHECK(sum == Approx(0.0).margin(0.15));
    CHECK(std::sqrt(squares) == Approx(0.7).epsilon(0.15));
}

TEST_CASE("effects that hold together add their shifts and multiply their slopes", "[unit]") {
    Protocol protocol = sided();
    TaskAnswer& steps = protocol.tasks[0].answers[2];
    steps.truth.noise = 0.0;
    for (int i = 0; i < 3; ++i) {
        SimulatedEffect& effect = protocol.simulated_effects.emplace_back();
        effect.answer = i == 1 ? "which" : "steps";
        effect.answer_shift = 0.25 + i;
        effect.answer_slope = 2.0 + i;
    }
    const SimulatedAnswers answers(protocol, 5);
    const Trial trial = trial_of(0, 2, 2);
    // Around 1.5, 2 x 4 of each level, shifted by 0.25 and 2.25, as far as the scale goes.
    steps.max = 100.0;
    AnswerOffer offer = offer_of(protocol, steps, "", trial);
    offer.low = -1000.0;
    offer.high = 1000.0;
    offer.step = 0.0;
    offer.numbers.clear();
    offer.values.clear();
    CHECK(answers.expected(offer, trial).mean.value() == Approx(1.5 + 8.0 * 2.0 + 2.5));
}

TEST_CASE("words favour no slot, and an area that is favoured has the odds of the answer", "[unit]") {
    Protocol protocol = sided();
    Task& task = protocol.tasks[0];
    const TaskAnswer word = task.answers[1];
    task.answers = {word};
    task.answers[0].truth.look_share = 0.9;
    task.answers[0].truth.look_area = "rim";
    task.answers[0].truth.look_odds = 5.0;
    int matt = 0;
    for (int i = 0; i < 40; ++i) {
        const SimulatedAnswers answers(protocol, 3);
        const Trial trial = trial_of(i, i % 4, (i + 1) % 4);
        const GazeFavour favour = answers.favour_of(trial, {"rim", "head"});
        CHECK(favour.slot == -1);
        CHECK(favour.share == 0.9);
        const bool is_first =
            answers.answer(offer_of(protocol, task.answers[0], "", trial), trial).choice == 0;
        matt += is_first;
        CHECK(favour.area == (is_first ? 0 : -1));
        CHECK(favour.odds == (is_first ? 5.0 : GazeFavour{}.odds));
        CHECK(answers.favour_of(trial, {"head"}).area == -1);
    }
    CHECK(matt > 3);
    CHECK(matt < 37);
    // The first answer that says so, and no other.
    task.answers.push_back(task.answers[0]);
    task.answers[1].truth.look_share = 0.2;
    CHECK(SimulatedAnswers(protocol, 3).favour_of(trial_of(0, 1, 2), {"rim"}).share == 0.9);
}
