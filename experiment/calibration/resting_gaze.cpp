#include "experiment/calibration/resting_gaze.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace overt {

namespace {

constexpr double least_valid_share = 0.8;
constexpr double share_within_reach = 0.98;

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1)
        return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

double mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values)
        sum += value;
    return sum / static_cast<double>(values.size());
}

double squared_about(const std::vector<double>& values, double mean) {
    double sum = 0.0;
    for (const double value : values)
        sum += (value - mean) * (value - mean);
    return sum;
}

} // namespace

RestingGaze::RestingGaze(const ScreenGeometry& screen, const Settings& settings)
    : settings_(settings), px_per_deg_(screen.px_per_deg_at_centre()) {}

void RestingGaze::take(const GazeSample& sample) {
    // A clock that went back is another clock: what was before it tells nothing.
    if (!samples_.empty() && sample.sampled_at < samples_.back().sampled_at)
        samples_.clear();
    samples_.push_back(sample);
    // One sample from before the window stays, so that the window is seen to be covered.
    while (samples_.size() > 1 && sample.sampled_at - samples_[1].sampled_at >= settings_.window)
        samples_.pop_front();
}

std::optional<RestedGaze> RestingGaze::rested() const {
    if (samples_.empty() || samples_.back().sampled_at - samples_.front().sampled_at < settings_.window)
        return std::nullopt;
    std::vector<double> x, y;
    for (const GazeSample& sample : samples_) {
        if (sample.gaze) {
            x.push_back(sample.gaze->x_px);
            y.push_back(sample.gaze->y_px);
        }
    }
    const auto valid = static_cast<double>(x.size());
    if (x.size() < 2 || valid < least_valid_share * static_cast<double>(samples_.size()))
        return std::nullopt;
    RestedGaze rested;
    rested.median = {median_of(x), median_of(y)};
    const double reach_px = settings_.reach.value * px_per_deg_;
    x.clear();
    y.clear();
    const TrackerTime settled = samples_.back().sampled_at - settings_.window / 2;
    double within = 0.0, steps = 0.0;
    int step_count = 0;
    const ScreenPoint* before = nullptr;
    for (const GazeSample& sample : samples_) {
        const ScreenPoint* const gaze = sample.gaze ? &*sample.gaze : nullptr;
        const bool is_within =
            gaze && std::hypot(gaze->x_px - rested.median.x_px, gaze->y_px - rested.median.y_px) <= reach_px;
        within += is_within ? 1.0 : 0.0;
        if (is_within && sample.sampled_at >= settled) {
            x.push_back(gaze->x_px);
            y.push_back(gaze->y_px);
            if (before) {
                steps += std::pow(gaze->x_px - before->x_px, 2.0) + std::pow(gaze->y_px - before->y_px, 2.0);
                ++step_count;
            }
        }
        before = is_within ? gaze : nullptr;
    }
    if (x.size() < 2 || within < share_within_reach * valid)
        return std::nullopt;
    rested.samples = static_cast<int>(x.size());
    if (step_count > 0)
        rested.rms_s2s.value = std::sqrt(steps / step_count) / px_per_deg_;
    rested.sd.value = std::sqrt((squared_about(x, mean_of(x)) + squared_about(y, mean_of(y))) /
                                (static_cast<double>(x.size()) - 1.0)) /
                      px_per_deg_;
    return rested;
}

} // namespace overt
