#include "experiment/procedures/quest_plus.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "experiment/statistics/distributions.h"

namespace overt {

namespace {

double weight_of(const ParameterGrid& grid, std::size_t value) {
    return grid.prior.empty() ? 1.0 : grid.prior[value];
}

void normalise(std::vector<double>& weights) {
    double sum = 0.0;
    for (const double one : weights)
        sum += one;
    for (double& one : weights)
        one /= sum;
}

} // namespace

std::size_t QuestPlus::level_count() const {
    return settings_.levels.size() * std::max<std::size_t>(settings_.second_levels.size(), 1);
}

double QuestPlus::yes_at(const Point& point, double level, double second) const {
    const double distance = level - point.threshold - point.tilt * second;
    double share = 0.0;
    switch (settings_.function) {
    case QuestFunction::weibull_db:
        share = -std::expm1(-std::pow(10.0, point.slope * distance / 20.0));
        break;
    case QuestFunction::normal:
        share = normal_probability(distance / point.slope);
        break;
    case QuestFunction::logistic:
        share = 1.0 / (1.0 + std::exp(-point.slope * distance));
        break;
    }
    return point.guess + (1.0 - point.guess - point.lapse) * share;
}

QuestPlus::QuestPlus(QuestPlusSettings settings) : settings_(std::move(settings)) {
    const auto& [function, levels, second_levels, threshold, slope, guess, lapse, tilt, trials, bits,
                 missed] = settings_;
    for (std::size_t t = 0; t < threshold.values.size(); ++t)
        for (std::size_t s = 0; s < slope.values.size(); ++s)
            for (std::size_t g = 0; g < guess.values.size(); ++g)
                for (std::size_t l = 0; l < lapse.values.size(); ++l)
                    for (std::size_t k = 0; k < tilt.values.size(); ++k) {
                        points_.push_back({threshold.values[t], slope.values[s], guess.values[g],
                                           lapse.values[l], tilt.values[k]});
                        posterior_.push_back(weight_of(threshold, t) * weight_of(slope, s) *
                                             weight_of(guess, g) * weight_of(lapse, l) * weight_of(tilt, k));
                    }
    normalise(posterior_);
    yes_.reserve(level_count() * points_.size());
    const std::vector<double> alone{0.0};
    for (const double level : levels)
        for (const double second : second_levels.empty() ? alone : second_levels)
            for (const Point& point : points_)
                yes_.push_back(yes_at(point, level, second));
    choose();
}

bool QuestPlus::is_over() const {
    return (settings_.trials > 0 && trials_ >= settings_.trials) ||
           (settings_.entropy_bits && trials_ > 0 && entropy_bits() <= *settings_.entropy_bits);
}

std::optional<double> QuestPlus::next() const {
    const std::size_t seconds = std::max<std::size_t>(settings_.second_levels.size(), 1);
    return is_over() ? std::nullopt : std::optional(settings_.levels[chosen_ / seconds]);
}

std::optional<double> QuestPlus::second_next() const {
    if (settings_.second_levels.empty() || is_over())
        return std::nullopt;
    return settings_.second_levels[chosen_ % settings_.second_levels.size()];
}

void QuestPlus::choose() {
    // With w = prior times likelihood and P their sum, the entropy after an answer is log P - sum(w log w) /
    // P, and its expectation over answers the sum of P log P - sum(w log w).
    double best = 0.0;
    for (std::size_t level = 0; level < level_count(); ++level) {
        const double* yes = yes_.data() + level * points_.size();
        double yes_share = 0.0, no_share = 0.0, yes_sum = 0.0, no_sum = 0.0;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const double with_yes = posterior_[i] * yes[i], with_no = posterior_[i] * (1.0 - yes[i]);
            yes_share += with_yes;
            no_share += with_no;
            if (with_yes > 0.0)
                yes_sum += with_yes * std::log(with_yes);
            if (with_no > 0.0)
                no_sum += with_no * std::log(with_no);
        }
        double expected = -yes_sum - no_sum;
        if (yes_share > 0.0)
            expected += yes_share * std::log(yes_share);
        if (no_share > 0.0)
            expected += no_share * std::log(no_share);
        if (level == 0 || expected < best) {
            best = expected;
            chosen_ = level;
        }
    }
    expected_bits_ = best / std::numbers::ln2;
}

void QuestPlus::tell(double shown, TrackAnswer answer) {
    if (is_over() || (answer == TrackAnswer::missed && settings_.missed == UnansweredTrial::repeat))
        return;
    ++trials_;
    if (answer == TrackAnswer::missed && settings_.missed == UnansweredTrial::ignore)
        return;
    const bool is_yes = answer == TrackAnswer::yes;
    if (settings_.second_levels.empty()) {
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const double yes = yes_at(points_[i], shown, 0.0);
            posterior_[i] *= is_yes ? yes : 1.0 - yes;
        }
    } else {
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const double yes = yes_[chosen_ * points_.size() + i];
            posterior_[i] *= is_yes ? yes : 1.0 - yes;
        }
    }
    normalise(posterior_);
    choose();
}

double QuestPlus::entropy_bits() const {
    double sum = 0.0;
    for (const double one : posterior_)
        if (one > 0.0)
            sum -= one * std::log2(one);
    return sum;
}

double QuestPlus::value_of(const Point& point, Parameter of) const {
    switch (of) {
    case Parameter::threshold:
        return point.threshold;
    case Parameter::slope:
        return point.slope;
    case Parameter::guess:
        return point.guess;
    case Parameter::lapse:
        return point.lapse;
    case Parameter::tilt:
        return point.tilt;
    }
    return 0.0;
}

ParameterEstimate QuestPlus::estimate(Parameter of) const {
    ParameterEstimate found;
    for (std::size_t i = 0; i < points_.size(); ++i)
        found.mean += posterior_[i] * value_of(points_[i], of);
    double squares = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const double distance = value_of(points_[i], of) - found.mean;
        squares += posterior_[i] * distance * distance;
    }
    found.sd = std::sqrt(squares);
    const auto highest = std::ranges::max_element(posterior_) - posterior_.begin();
    found.mode = value_of(points_[static_cast<std::size_t>(highest)], of);
    return found;
}

std::pair<double, double> QuestPlus::interval(Parameter of, double confidence) const {
    std::vector<std::pair<double, double>> weights; // value, share
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const double value = value_of(points_[i], of);
        const auto known = std::ranges::find(weights, value, &std::pair<double, double>::first);
        if (known == weights.end()) {
            weights.emplace_back(value, posterior_[i]);
        } else {
            known->second += posterior_[i];
        }
    }
    std::ranges::sort(weights);
    // A value stands for the cell half-way to its neighbours, in which its share is spread evenly.
    const auto at = [&](double order) {
        double below = 0.0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            const auto [value, share] = weights[i];
            if (below + share >= order || i + 1 == weights.size()) {
                const double left = i > 0 ? 0.5 * (weights[i - 1].first + value) : value;
                const double right = i + 1 < weights.size() ? 0.5 * (weights[i + 1].first + value) : value;
                const double part = share > 0.0 ? std::clamp((order - below) / share, 0.0, 1.0) : 0.5;
                return left + part * (right - left);
            }
            below += share;
        }
        return weights.back().first;
    };
    return {at(0.5 - 0.5 * confidence), at(0.5 + 0.5 * confidence)};
}

TrackState QuestPlus::state() const {
    const ParameterEstimate threshold = estimate(Parameter::threshold);
    TrackState state;
    state.trials = trials_;
    state.estimate = threshold.mean;
    state.spread = threshold.sd;
    state.entropy_bits = entropy_bits();
    return state;
}

} // namespace overt
