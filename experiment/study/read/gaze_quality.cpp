#include "experiment/study/read/gaze_quality.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "experiment/statistics/bootstrap.h"
#include "experiment/study/fixations/surface_fixations.h"

namespace overt {

namespace {

std::optional<double> median_of(std::vector<double> values) {
    if (values.empty())
        return std::nullopt;
    std::sort(values.begin(), values.end());
    return quantile_of_sorted(values, 0.5);
}

constexpr int least_samples = 5;

/// Squares of what is left of gaze around the line of least squares along each axis of the screen, over
/// stretches of a fixation; `freedom` is what they are to be divided by.
class ScatterAroundMotion {
  public:
    /// In the order of their times.
    void add(double at_s, glm::dvec2 at_deg) {
        if (count_ >= least_samples && at_s - first_s_ >= stretch_s)
            end_stretch();
        if (count_++ == 0)
            first_s_ = at_s, first_deg_ = at_deg;
        const double t = at_s - first_s_;
        const glm::dvec2 d = at_deg - first_deg_;
        t_ += t;
        tt_ += t * t;
        d_ += d;
        dd_ += d * d;
        td_ += t * d;
    }

    /// The root of the sum of both axes' variances; nothing of fewer samples than five.
    std::optional<double> sd_deg() {
        end_stretch();
        return freedom_ > 0.0 ? std::optional(std::sqrt(std::max(squares_, 0.0) / freedom_)) : std::nullopt;
    }

  private:
    /// Too short for the turn of an object, or the eye's own drift, to leave the line, and long against the
    /// noise of a sample.
    static constexpr double stretch_s = 0.2;

    void end_stretch() {
        if (count_ >= least_samples) {
            const double n = count_, spread = tt_ - t_ * t_ / n;
            const glm::dvec2 with_time = td_ - t_ * d_ / n;
            const glm::dvec2 left = dd_ - d_ * d_ / n - with_time * with_time / spread;
            squares_ += left.x + left.y;
            freedom_ += n - 2.0; // a line has a place and a slope
        }
        count_ = 0;
        t_ = tt_ = 0.0;
        d_ = dd_ = td_ = glm::dvec2(0.0);
    }

    double squares_ = 0.0, freedom_ = 0.0;
    int count_ = 0;
    double first_s_ = 0.0, t_ = 0.0, tt_ = 0.0;
    glm::dvec2 first_deg_{0.0}, d_{0.0}, dd_{0.0}, td_{0.0};
};

void add_precision(std::span<const PlacedSample> samples, const ScreenGeometry& screen,
                   std::vector<double>& rms, std::vector<double>& sd) {
    if (samples.empty())
        return;
    // Within a fixation the screen is as good as flat: pixels are linear in angle to a part in a thousand.
    const double deg_per_px = 1.0 / screen.px_per_deg_at_centre();
    double squares = 0.0;
    int steps = 0, count = 0;
    ScatterAroundMotion scatter;
    const PlacedSample* before = nullptr;
    for (const PlacedSample& sample : samples) {
        if (!sample.has_gaze) {
            before = nullptr;
            continue;
        }
        const double at_s =
            std::chrono::duration<double>(sample.sampled_at - samples.front().sampled_at).count();
        scatter.add(at_s, glm::dvec2(sample.gaze.x_px, sample.gaze.y_px) * deg_per_px);
        ++count;
        if (before) {
            const double angle = screen.angle_between(before->gaze, sample.gaze).value;
            squares += angle * angle;
            ++steps;
        }
        before = &sample;
    }
    if (count < least_samples || steps == 0)
        return;
    rms.push_back(std::sqrt(squares / steps));
    if (const std::optional<double> scattered = scatter.sd_deg())
        sd.push_back(*scattered);
}

} // namespace

StudyQuality gaze_quality(std::span<const PlacedSample> samples, std::span<const GazeEvent> events,
                          const ScreenGeometry& screen) {
    StudyQuality quality;
    quality.samples = static_cast<double>(samples.size());
    const bool knows_angles = screen.viewing_distance_mm > 0.0 && screen.screen_px.x > 0;
    double lost = 0.0;
    for (const PlacedSample& sample : samples)
        lost += !sample.has_gaze;
    std::vector<double> rms, sd, intervals_us;
    for (const GazeEvent& event : events) {
        const auto [begin, end] = samples_between(samples, event.start, event.end);
        const auto own = samples.subspan(begin, end - begin);
        if (event.kind == GazeEvent::Kind::fixation && knows_angles)
            add_precision(own, screen, rms, sd);
        if (event.kind == GazeEvent::Kind::blink) {
            ++quality.blinks;
            for (const PlacedSample& sample : own)
                quality.lost_in_blinks += !sample.has_gaze;
        }
    }
    quality.lost_in_blinks = std::min(quality.lost_in_blinks, lost);
    quality.lost = lost - quality.lost_in_blinks;
    quality.rms_s2s_deg = median_of(std::move(rms));
    quality.sd_deg = median_of(std::move(sd));
    for (std::size_t i = 1; i < samples.size(); ++i)
        intervals_us.push_back(
            static_cast<double>((samples[i].sampled_at - samples[i - 1].sampled_at).count()));
    const std::optional<double> interval_us = median_of(std::move(intervals_us));
    if (interval_us && *interval_us > 0.0)
        quality.rate_hz = 1e6 / *interval_us;
    return quality;
}

StudyQuality quality_of_all(std::span<const StudyQuality* const> trials) {
    StudyQuality all;
    std::vector<double> accuracy, drift, rms, sd, rate;
    const auto take = [](std::vector<double>& into, const std::optional<double>& value) {
        if (value)
            into.push_back(*value);
    };
    for (const StudyQuality* trial : trials) {
        take(accuracy, trial->accuracy_deg);
        take(drift, trial->drift_deg);
        take(rms, trial->rms_s2s_deg);
        take(sd, trial->sd_deg);
        take(rate, trial->rate_hz);
        if (trial->worst_accuracy_deg)
            all.worst_accuracy_deg =
                std::max(all.worst_accuracy_deg.value_or(0.0), *trial->worst_accuracy_deg);
        all.samples += trial->samples;
        all.lost += trial->lost;
        all.lost_in_blinks += trial->lost_in_blinks;
        all.blinks += trial->blinks;
        all.refreshes += trial->refreshes;
        if (all.missed_refreshes && trial->missed_refreshes)
            *all.missed_refreshes += *trial->missed_refreshes;
        else
            all.missed_refreshes.reset();
        all.off_plan += trial->off_plan;
    }
    if (!accuracy.empty()) {
        double sum = 0.0;
        for (const double value : accuracy)
            sum += value;
        all.accuracy_deg = sum / static_cast<double>(accuracy.size());
    }
    all.drift_deg = median_of(std::move(drift));
    all.rms_s2s_deg = median_of(std::move(rms));
    all.sd_deg = median_of(std::move(sd));
    all.rate_hz = median_of(std::move(rate));
    return all;
}

} // namespace overt
