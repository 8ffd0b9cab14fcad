#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "devices/simulated/simulated_answers.h"
#include "experiment/answers/answer_kinds.h"
#include "experiment/design/answer_forms.h"
#include "experiment/statistics/distributions.h"

namespace overt {

namespace {

/// As many equally probable values of a standard normal number: means over them are exact to about a
/// thousandth of its standard deviation.
constexpr int normal_steps = 401;

double normal_step(int i) { return normal_quantile((i + 0.5) / normal_steps); }

/// How probable each is to be the largest, with noise of a standard deviation of 1 / sqrt 2 on each.
std::vector<double> shares_of_largest(const std::vector<double>& means) {
    std::vector<double> shares(means.size(), 0.0);
    for (std::size_t i = 0; i < means.size(); ++i)
        for (int step = 0; step < normal_steps; ++step) {
            const double here = means[i] + normal_step(step) / std::numbers::sqrt2;
            double largest = 1.0 / normal_steps;
            for (std::size_t k = 0; k < means.size(); ++k)
                largest *= k == i ? 1.0 : normal_probability((here - means[k]) * std::numbers::sqrt2);
            shares[i] += largest;
        }
    return shares;
}

/// How often each is the odd one out, with such noise on each, of so many draws: within 0.5 % of 20,000.
template <class Chosen> std::vector<double> shares_of_draws(std::size_t count, const Chosen& chosen) {
    constexpr int draws = 20'000;
    RandomStream random(1, "expected odd ones");
    std::vector<double> shares(count, 0.0);
    for (int i = 0; i < draws; ++i)
        shares[static_cast<std::size_t>(chosen(random))] += 1.0 / draws;
    return shares;
}

/// Of words in a row: how probable each is to be the nearest to a place that has a standard deviation of 1.
std::vector<double> shares_of_words(double from_middle, std::size_t count) {
    std::vector<double> shares;
    const double middle = 0.5 * (static_cast<double>(count) - 1.0) + from_middle;
    double below = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double up_to = i + 1 == count ? 1.0 : normal_probability(static_cast<double>(i) + 0.5 - middle);
        shares.push_back(up_to - below);
        below = up_to;
    }
    return shares;
}

} // namespace

AnswerOffer offer_of(const Protocol& protocol, const TaskAnswer& answer, const std::string& item,
                     const Trial& trial) {
    AnswerOffer offer;
    offer.id = answer.id;
    offer.item = item;
    offer.kind = row_of(answer.kind).name;
    offer.limit_s = answer.limit_s;
    offer.correct = correct_value(protocol, answer, trial);
    if (answer.is_choice() || offer.kind == "key") {
        offer.values = answer.is_choice() ? answer.choices : answer.keys;
        return offer;
    }
    if (offer.kind == "scale") {
        offer.low = answer.low();
        offer.high = answer.high();
        for (int step = 0; answer.steps && step < *answer.steps; ++step) {
            offer.numbers.push_back(answer.number_of_step(step));
            offer.values.push_back(fmt::format("{:g}", offer.numbers.back()));
        }
        if (answer.steps && *answer.steps > 1)
            offer.step = (*offer.high - *offer.low) / (*answer.steps - 1);
    } else {
        offer.low = answer.min;
        offer.high = answer.max;
    }
    if (!answer.steps)
        offer.step = answer.step.value_or(0.0);
    return offer;
}

SimulatedAnswers::Expected SimulatedAnswers::expected(const AnswerOffer& offer, const Trial& trial) const {
    const Task& task = protocol_.tasks[static_cast<std::size_t>(trial.task)];
    const auto found = std::ranges::find(task.answers, offer.id, &TaskAnswer::id);
    const AnswerTruth truth = found == task.answers.end() ? AnswerTruth{} : found->truth;
    Expected expected;
    // The mean of a log-normal number.
    expected.after_s = std::max(0.0, truth.shift_s + more_time_s(trial, truth)) +
                       truth.median_s * std::exp(0.5 * truth.log_sd * truth.log_sd);
    if (offer.values.empty() || !offer.numbers.empty()) {
        if (!offer.low && !offer.high && truth.by.empty() && !truth.offset)
            return expected;
        double sum = 0.0;
        for (int step = 0; step < normal_steps; ++step)
            sum += number_judged(offer, trial, truth, normal_step(step));
        expected.mean = sum / normal_steps;
        return expected;
    }
    const std::vector<std::string> values = values_of(offer, found == task.answers.end() ? nullptr : &*found);
    const Judged means = judged(offer, values, trial, truth);
    const double count = static_cast<double>(values.size());
    std::vector<double> shares(values.size(), 1.0 / count);
    if (!means.slots.empty() && means.is_odd_one_out)
        shares =
            shares_of_draws(values.size(), [&](RandomStream& random) { return chosen_slot(means, random); });
    else if (!means.slots.empty())
        shares = shares_of_largest(means.slots);
    else if (means.words)
        shares = shares_of_words(*means.words, values.size());
    else if (means.right >= 0 && values.size() > 1)
        for (std::size_t i = 0; i < values.size(); ++i)
            shares[i] = static_cast<int>(i) == means.right ? means.share_right
                                                           : (1.0 - means.share_right) / (count - 1.0);
    for (const std::string& value : offer.values) {
        const auto at = static_cast<std::size_t>(std::ranges::find(values, value) - values.begin());
        expected.shares.push_back(truth.lapses / count + (1.0 - truth.lapses) * shares[at]);
    }
    return expected;
}

} // namespace overt
