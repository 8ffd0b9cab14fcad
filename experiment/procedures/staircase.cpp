#include "experiment/procedures/staircase.h"

#include <algorithm>
#include <cmath>

namespace overt {

namespace {

double step_after(const std::vector<double>& steps, std::size_t reversals) {
    return steps[std::min(reversals, steps.size() - 1)];
}

bool does_multiply(StepScale scale) { return scale == StepScale::db || scale == StepScale::log; }

} // namespace

Staircase::Staircase(StaircaseSettings settings) : settings_(std::move(settings)), level_(settings_.start) {
    if (settings_.scale != StepScale::places)
        return;
    const auto nearest = std::ranges::min_element(
        settings_.levels, {}, [this](double level) { return std::abs(level - settings_.start); });
    place_ = static_cast<std::size_t>(nearest - settings_.levels.begin());
    level_ = *nearest;
}

bool Staircase::is_over() const {
    const bool has_trials = settings_.trials > 0, has_reversals = settings_.reversals > 0;
    const bool trials_done = has_trials && trials_ >= settings_.trials;
    const bool reversals_done =
        has_reversals && static_cast<int>(reversal_levels_.size()) >= settings_.reversals;
    if (has_trials && has_reversals && settings_.stop == StopRule::both)
        return trials_done && reversals_done;
    return trials_done || reversals_done;
}

std::optional<double> Staircase::next() const { return is_over() ? std::nullopt : std::optional(level_); }

void Staircase::move(Direction to) {
    const bool is_up = to == Direction::up;
    const std::vector<double>& steps =
        is_up || settings_.steps_down.empty() ? settings_.steps : settings_.steps_down;
    const double step = step_after(steps, reversal_levels_.size()), sign = is_up ? 1.0 : -1.0;
    run_ = 0;
    double wanted = level_;
    switch (settings_.scale) {
    case StepScale::linear:
        wanted += sign * step;
        break;
    case StepScale::db:
        wanted *= std::pow(10.0, sign * step / 20.0);
        break;
    case StepScale::log:
        wanted *= std::pow(10.0, sign * step);
        break;
    case StepScale::places: {
        const double last = static_cast<double>(settings_.levels.size()) - 1.0;
        const double place = static_cast<double>(place_) + sign * step;
        const double kept = std::clamp(std::round(place), 0.0, last);
        was_clipped_ = place < 0.0 || place > last;
        place_ = static_cast<std::size_t>(kept);
        level_ = settings_.levels[place_];
        return;
    }
    }
    level_ = wanted;
    if (settings_.highest)
        level_ = std::min(level_, *settings_.highest);
    if (settings_.lowest)
        level_ = std::max(level_, *settings_.lowest);
    was_clipped_ = level_ != wanted;
}

void Staircase::tell(double, TrackAnswer answer) {
    if (is_over())
        return;
    has_reversed_ = was_clipped_ = false;
    if (answer == TrackAnswer::missed) {
        if (settings_.missed != UnansweredTrial::repeat)
            ++trials_;
        if (settings_.missed != UnansweredTrial::wrong)
            return;
    } else {
        ++trials_;
    }
    const bool is_yes = answer == TrackAnswer::yes;
    run_ = is_yes ? std::max(run_, 0) + 1 : std::min(run_, 0) - 1;
    const bool is_first_run = settings_.initial_rule && reversal_levels_.empty();
    const bool does_move =
        is_first_run || (is_yes ? run_ >= settings_.down_after : -run_ >= settings_.up_after);
    if (!does_move)
        return;
    const Direction to = is_yes ? Direction::down : Direction::up;
    has_reversed_ = direction_ != Direction::none && direction_ != to;
    direction_ = to;
    if (has_reversed_)
        reversal_levels_.push_back(level_);
    move(to);
}

std::optional<double> Staircase::mean_of_reversals() const {
    const auto all = static_cast<int>(reversal_levels_.size());
    const int kept = std::max(all - settings_.discard, 0) / 2 * 2;
    if (kept < 2)
        return std::nullopt;
    const bool is_geometric = does_multiply(settings_.scale);
    double sum = 0.0;
    for (auto level = reversal_levels_.end() - kept; level != reversal_levels_.end(); ++level)
        sum += is_geometric ? std::log(*level) : *level;
    return is_geometric ? std::exp(sum / kept) : sum / kept;
}

TrackState Staircase::state() const {
    TrackState state;
    state.trials = trials_;
    state.reversals = static_cast<int>(reversal_levels_.size());
    state.was_clipped = was_clipped_;
    state.has_reversed = has_reversed_;
    state.estimate = mean_of_reversals();
    return state;
}

double staircase_target(int up_after, int down_after, double step_up, double step_down) {
    const auto drift = [&](double p) {
        const double up = std::pow(p, down_after - 1), down = std::pow(1.0 - p, up_after - 1);
        const double downward = up * (1.0 - std::pow(1.0 - p, up_after)) / (up + down - up * down);
        return downward * step_down - (1.0 - downward) * step_up;
    };
    double low = 0.0, high = 1.0; // the drift rises with p
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (drift(middle) < 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace overt
