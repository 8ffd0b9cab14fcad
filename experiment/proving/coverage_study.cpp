#include "experiment/proving/coverage_study.h"

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "experiment/base/random.h"
#include "experiment/fits/difference_scaling.h"
#include "experiment/fits/psychometric_fit.h"
#include "experiment/procedures/constant_stimuli.h"
#include "experiment/procedures/interleaved_tracks.h"
#include "experiment/procedures/quest_plus.h"
#include "experiment/procedures/staircase.h"
#include "experiment/statistics/distributions.h"

namespace overt {

namespace {

/// What one study gave.
struct StudyEstimate {
    double value = 0.0;
    std::optional<std::pair<double, double>> interval;
};

/// Runs the studies and counts. `study` gets the study's own random numbers and number.
template <class Study>
CoverageStudy count_studies(std::string what, int studies, std::uint64_t seed, double truth,
                            const Study& study) {
    CoverageStudy counted{std::move(what), studies};
    double sum = 0.0, squares = 0.0;
    int given = 0;
    for (int i = 0; i < studies; ++i) {
        RandomStream random(seed, counted.what, static_cast<std::uint64_t>(i));
        const std::optional<StudyEstimate> found = study(random, static_cast<std::uint64_t>(i));
        if (!found || !found->interval) {
            ++counted.without;
            continue;
        }
        counted.held += truth >= found->interval->first && truth <= found->interval->second ? 1 : 0;
        sum += found->value - truth;
        squares += (found->value - truth) * (found->value - truth);
        ++given;
    }
    if (given > 1) {
        const double mean = sum / given;
        counted.bias = mean / std::sqrt(squares / given - mean * mean);
    }
    return counted;
}

/// The simulated observer of two alternatives: logistic, 2 % lapses.
constexpr double observer_threshold = 0.4, observer_slope = 1.5, observer_lapse = 0.02;

TrackAnswer answer_at(double level, RandomStream& random) {
    const double share =
        0.5 + (0.5 - observer_lapse) / (1.0 + std::exp(-observer_slope * (level - observer_threshold)));
    return random.uniform() < share ? TrackAnswer::yes : TrackAnswer::no;
}

PsychometricModel observer_model() { return {CurveShape::logistic, {0.5}, {observer_lapse}}; }

/// The level at which F is one half, with its profile interval.
std::optional<StudyEstimate> threshold_of(const std::vector<LevelCount>& trials) {
    const std::optional<PsychometricFit> fit = fit_psychometric(trials, observer_model());
    if (!fit || !fit->has_slope)
        return std::nullopt;
    StudyEstimate found{fit->alpha.value, {}};
    if (const auto interval = profile_interval(trials, *fit, 0.5 + 0.5 * (0.5 - observer_lapse), 0.95))
        found.interval = {interval->low, interval->high};
    return found;
}

/// Two tracks from above and below, at random.
std::optional<StudyEstimate> staircase_study(RandomStream& random, std::uint64_t study) {
    std::vector<std::unique_ptr<LevelTrack>> tracks;
    for (const double start : {4.0, -2.0}) {
        StaircaseSettings settings;
        settings.start = start;
        settings.down_after = start > 0.0 ? 3 : 2; // two targets, so that the slope is seen
        settings.steps = {1.0, 0.5};
        settings.lowest = -6.0;
        settings.highest = 8.0;
        settings.trials = 100;
        tracks.push_back(std::make_unique<Staircase>(settings));
    }
    InterleavedTracks all(std::move(tracks), study);
    std::vector<LevelCount> trials;
    while (const auto choice = all.next()) {
        const TrackAnswer answer = answer_at(choice->level, random);
        trials.push_back({choice->level, 1.0, answer == TrackAnswer::yes ? 1.0 : 0.0});
        all.tell(choice->level, answer);
    }
    return threshold_of(trials);
}

std::optional<StudyEstimate> constant_study(RandomStream& random, std::uint64_t study) {
    ConstantStimuli track({{-2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.0}, 40, UnansweredTrial::repeat, study});
    std::vector<LevelCount> trials;
    while (const std::optional<double> level = track.next()) {
        const TrackAnswer answer = answer_at(*level, random);
        trials.push_back({*level, 1.0, answer == TrackAnswer::yes ? 1.0 : 0.0});
        track.tell(*level, answer);
    }
    return threshold_of(trials);
}

std::optional<StudyEstimate> quest_plus_study(RandomStream& random, std::uint64_t) {
    QuestPlusSettings settings;
    settings.function = QuestFunction::logistic;
    for (int i = -10; i <= 16; ++i)
        settings.levels.push_back(0.4 * i);
    for (int i = -20; i <= 24; ++i)
        settings.threshold.values.push_back(0.2 * i);
    settings.slope.values = {0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0};
    settings.lapse.values = {observer_lapse};
    settings.trials = 120;
    QuestPlus track(settings);
    while (const std::optional<double> level = track.next())
        track.tell(*level, answer_at(*level, random));
    return StudyEstimate{track.estimate(QuestPlus::Parameter::threshold).mean,
                         track.interval(QuestPlus::Parameter::threshold, 0.95)};
}

/// All triads of six levels, ten times each; the third level of a scale that bends.
constexpr double planted_scale[] = {0.0, 0.08, 0.2, 0.4, 0.68, 1.0};
constexpr double planted_sigma = 0.25;
constexpr std::size_t planted_level = 3;

std::optional<StudyEstimate> difference_study(RandomStream& random, std::uint64_t) {
    std::vector<DifferenceCount> counts;
    for (int a = 0; a < 6; ++a)
        for (int b = a + 1; b < 6; ++b)
            for (int c = b + 1; c < 6; ++c) {
                const double delta = planted_scale[a] - 2.0 * planted_scale[b] + planted_scale[c];
                DifferenceCount one{{a, b, c}, 10.0, 0.0};
                for (int trial = 0; trial < 10; ++trial)
                    one.upper += random.uniform() < normal_probability(delta / planted_sigma) ? 1.0 : 0.0;
                counts.push_back(std::move(one));
            }
    const std::optional<DifferenceScale> scale = fit_difference_scale(counts, 6);
    if (!scale)
        return std::nullopt;
    const std::optional<double> se = scale->normalised_se(planted_level);
    if (!se)
        return std::nullopt;
    const double value = scale->scale[planted_level], z = normal_quantile(0.975);
    return StudyEstimate{value, std::pair(value - z * *se, value + z * *se)};
}

} // namespace

std::vector<CoverageStudy> coverage_studies(int studies, std::uint64_t seed) {
    return {count_studies("two interleaved staircases, threshold, profile interval of the fit", studies, seed,
                          observer_threshold, staircase_study),
            count_studies("constant stimuli, threshold, profile interval of the fit", studies, seed,
                          observer_threshold, constant_study),
            count_studies("QUEST+, threshold, interval of the posterior", studies, seed, observer_threshold,
                          quest_plus_study),
            count_studies("MLDS triads, normalised scale value, delta method", studies, seed,
                          planted_scale[planted_level], difference_study)};
}

} // namespace overt
