#include <algorithm>
#include <cmath>

#include "experiment/base/random.h"
#include "experiment/fits/psychometric_fit.h"
#include "experiment/statistics/bootstrap.h"
#include "experiment/statistics/distributions.h"

namespace overt {

namespace {

/// Percentiles of what was drawn; nothing where fewer than half of the draws gave a value.
std::optional<Interval> percentiles_of(std::vector<double> drawn, const PsychometricBootstrap& settings) {
    if (2 * static_cast<int>(drawn.size()) < settings.resamples || drawn.empty())
        return std::nullopt;
    std::ranges::sort(drawn);
    return Interval{quantile_of_sorted(drawn, 0.5 - 0.5 * settings.confidence),
                    quantile_of_sorted(drawn, 0.5 + 0.5 * settings.confidence)};
}

/// The log-likelihood at its largest with the threshold held at a level: over the slope alone, by golden
/// section. Asymptotes stay as fitted.
class ThresholdProfile {
  public:
    ThresholdProfile(std::span<const LevelCount> counts, const PsychometricFit& fit, double psi)
        : counts_(counts), fit_(fit) {
        const double span = 1.0 - fit.guess.value - fit.lapse.value;
        u_ = curve_inverse(fit.model.shape, (psi - fit.guess.value) / span);
    }

    double at(double abscissa) const {
        constexpr double golden = 0.6180339887498949;
        // Slopes of the fitted one's sign, from a fiftieth of it to fifty times.
        double low = -std::log(50.0), high = std::log(50.0);
        double left = high - golden * (high - low), right = low + golden * (high - low);
        double at_left = value(abscissa, left), at_right = value(abscissa, right);
        for (int i = 0; i < 40; ++i) {
            if (at_left < at_right) {
                low = left;
                left = right;
                at_left = at_right;
                right = low + golden * (high - low);
                at_right = value(abscissa, right);
            } else {
                high = right;
                right = left;
                at_right = at_left;
                left = high - golden * (high - low);
                at_left = value(abscissa, left);
            }
        }
        return std::max(at_left, at_right);
    }

  private:
    double value(double abscissa, double log_factor) const {
        const double slope = fit_.line_slope * std::exp(log_factor),
                     span = 1.0 - fit_.guess.value - fit_.lapse.value;
        double sum = 0.0;
        for (const LevelCount& one : counts_) {
            const double t = curve_abscissa(fit_.model.shape, one.level);
            const CurveValue curve =
                std::isinf(t) ? CurveValue{} : curve_at(fit_.model.shape, u_ + slope * (t - abscissa));
            const double share = fit_.guess.value + span * curve.value,
                         rest = fit_.lapse.value + span * curve.rest;
            if (one.yes > 0.0)
                sum += one.yes * std::log(std::max(share, 1e-300));
            if (one.yes < one.trials)
                sum += (one.trials - one.yes) * std::log(std::max(rest, 1e-300));
        }
        return sum;
    }

    std::span<const LevelCount> counts_;
    const PsychometricFit& fit_;
    double u_ = 0.0;
};

} // namespace

PsychometricIntervals bootstrap_psychometric(std::span<const LevelCount> given, const PsychometricFit& fit,
                                             const PsychometricBootstrap& settings) {
    PsychometricIntervals found;
    found.settings = settings;
    const std::vector<LevelCount> counts = counts_by_level(given);
    std::vector<LevelCount> sample = counts;
    std::vector<double> alphas, betas, thresholds, deviances;
    for (int draw = 0; draw < settings.resamples; ++draw) {
        RandomStream random(settings.seed, "psychometric bootstrap", static_cast<std::uint64_t>(draw));
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const double share =
                settings.is_parametric ? fit.share_at(counts[i].level) : counts[i].yes / counts[i].trials;
            sample[i].yes = 0.0;
            for (int trial = 0; trial < static_cast<int>(counts[i].trials); ++trial)
                sample[i].yes += random.uniform() < share ? 1.0 : 0.0;
        }
        const std::optional<PsychometricFit> again = fit_psychometric(sample, fit.model);
        if (!again || !again->has_slope) {
            ++found.failures;
            continue;
        }
        alphas.push_back(again->alpha.value);
        betas.push_back(again->beta.value);
        deviances.push_back(again->deviance);
        if (const auto threshold = again->threshold(settings.psi))
            thresholds.push_back(threshold->level);
    }
    found.alpha = percentiles_of(std::move(alphas), settings);
    found.beta = percentiles_of(std::move(betas), settings);
    found.threshold = percentiles_of(std::move(thresholds), settings);
    if (!deviances.empty()) {
        std::ranges::sort(deviances);
        found.deviance_limit = quantile_of_sorted(deviances, settings.confidence);
    }
    return found;
}

std::optional<Interval> profile_interval(std::span<const LevelCount> counts, const PsychometricFit& fit,
                                         double psi, double confidence) {
    const auto threshold = fit.threshold(psi);
    if (!threshold)
        return std::nullopt;
    const ThresholdProfile profile(counts, fit, psi);
    const double centre = curve_abscissa(fit.model.shape, threshold->level);
    const double z = normal_quantile(0.5 + 0.5 * confidence);
    const double least = std::max(profile.at(centre), fit.log_likelihood) - 0.5 * z * z;
    // A first stride in the direction of the level, as far as F changes much.
    const double stride = 0.25 / std::abs(fit.line_slope);
    const auto end_towards = [&](double sign) -> std::optional<double> {
        double inside = centre, reach = stride;
        for (int i = 0; i < 12; ++i, reach *= 2.0) {
            const double outside = centre + sign * reach;
            if (profile.at(outside) >= least) {
                inside = outside;
                continue;
            }
            double near = inside, far = outside;
            for (int halving = 0; halving < 40; ++halving) {
                const double middle = 0.5 * (near + far);
                (profile.at(middle) >= least ? near : far) = middle;
            }
            return 0.5 * (near + far);
        }
        return std::nullopt;
    };
    const std::optional<double> low = end_towards(-1.0), high = end_towards(1.0);
    if (!low || !high)
        return std::nullopt;
    return Interval{curve_level(fit.model.shape, *low), curve_level(fit.model.shape, *high)};
}

} // namespace overt
