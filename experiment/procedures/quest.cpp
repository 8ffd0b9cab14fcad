#include "experiment/procedures/quest.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace overt {

double nearest_level(const std::vector<double>& levels, double level) {
    return *std::ranges::min_element(levels, {}, [level](double one) { return std::abs(one - level); });
}

double Quest::yes_at(double distance) const {
    return settings_.delta * settings_.gamma +
           (1.0 - settings_.delta) *
               (1.0 - (1.0 - settings_.gamma) * std::exp(-std::pow(10.0, settings_.beta * distance)));
}

Quest::Quest(const QuestSettings& settings)
    : settings_(settings), half_(static_cast<int>(std::ceil(settings.range / settings.grain / 2.0))) {
    for (int i = -half_; i <= half_; ++i) {
        const double z = i * settings_.grain / settings_.guess_sd;
        posterior_.push_back(std::exp(-0.5 * z * z));
    }
    const double sum = std::accumulate(posterior_.begin(), posterior_.end(), 0.0);
    for (double& one : posterior_)
        one /= sum;
    // Where the function passes the threshold's share: interpolated between points of the grid, as the
    // Toolbox does.
    for (int i = -2 * half_; i < 2 * half_; ++i) {
        const double below = yes_at(i * settings_.grain), above = yes_at((i + 1) * settings_.grain);
        if (below <= settings_.p_threshold && settings_.p_threshold < above) {
            shift_ = settings_.grain * (i + (settings_.p_threshold - below) / (above - below));
            break;
        }
    }
    // The order at which an answer is expected to say most about the threshold, after Pelli (1987).
    constexpr double least = 1e-14;
    const double low = yes_at(-2 * half_ * settings_.grain + shift_),
                 high = yes_at(2 * half_ * settings_.grain + shift_);
    const double difference = high * std::log(high + least) - low * std::log(low + least) +
                              (1.0 - high + least) * std::log(1.0 - high + least) -
                              (1.0 - low + least) * std::log(1.0 - low + least);
    const double share = 1.0 / (1.0 + std::exp(difference / (low - high)));
    order_ = (share - low) / (high - low);
}

std::optional<double> Quest::next() const {
    if (trials_ >= settings_.trials)
        return std::nullopt;
    const double best = quantile(order_);
    return settings_.levels.empty() ? best : nearest_level(settings_.levels, best);
}

void Quest::tell(double shown, TrackAnswer answer) {
    if (trials_ >= settings_.trials ||
        (answer == TrackAnswer::missed && settings_.missed == UnansweredTrial::repeat))
        return;
    ++trials_;
    if (answer == TrackAnswer::missed && settings_.missed == UnansweredTrial::ignore)
        return;
    const bool is_yes = answer == TrackAnswer::yes;
    const double from_guess = std::round((shown - settings_.guess) / settings_.grain);
    double sum = 0.0;
    for (int i = -half_; i <= half_; ++i) {
        // Beyond twice the grid the function has its last value.
        const double steps = std::clamp(from_guess - i, -2.0 * half_, 2.0 * half_);
        const double yes = yes_at(steps * settings_.grain + shift_);
        double& one = posterior_[static_cast<std::size_t>(i + half_)];
        one *= is_yes ? yes : 1.0 - yes;
        sum += one;
    }
    for (double& one : posterior_)
        one /= sum;
}

double Quest::mean() const {
    double sum = 0.0;
    for (int i = -half_; i <= half_; ++i)
        sum += posterior_[static_cast<std::size_t>(i + half_)] * i * settings_.grain;
    return settings_.guess + sum;
}

double Quest::sd() const {
    const double centre = mean() - settings_.guess;
    double sum = 0.0;
    for (int i = -half_; i <= half_; ++i) {
        const double distance = i * settings_.grain - centre;
        sum += posterior_[static_cast<std::size_t>(i + half_)] * distance * distance;
    }
    return std::sqrt(sum);
}

double Quest::mode() const {
    const auto highest = std::ranges::max_element(posterior_) - posterior_.begin();
    return settings_.guess + static_cast<double>(highest - half_) * settings_.grain;
}

double Quest::quantile(double order) const {
    double below = 0.0;
    for (std::size_t i = 0; i < posterior_.size(); ++i) {
        const double up_to = below + posterior_[i];
        if (i > 0 && up_to >= order && up_to > below) {
            const double place = static_cast<double>(i) - 1.0 + (order - below) / (up_to - below);
            return settings_.guess + (place - half_) * settings_.grain;
        }
        below = up_to;
    }
    return settings_.guess + half_ * settings_.grain;
}

TrackState Quest::state() const {
    TrackState state;
    state.trials = trials_;
    state.estimate = mean();
    state.spread = sd();
    return state;
}

} // namespace overt
