#include "experiment/study/fixations/placed_samples.h"

#include <algorithm>
#include <array>

namespace overt {

namespace {

/// The point seen at the centre of the covered pixel that is nearest to a place beside the object.
std::optional<SurfacePoint> surface_at_outline(const SurfaceLookup& lookup, PoseIndex pose, glm::dvec2 place,
                                               glm::dvec2 outline) {
    // The outline runs along the pixel's border: a little farther on is inside of it. A place whose own pixel
    // is covered, though not where the place is, is its own outline.
    constexpr double little_px = 1e-3;
    const glm::dvec2 way = outline - place;
    const double length = glm::length(way);
    const glm::dvec2 inside = length > 0.0 ? outline + little_px / length * way : outline;
    return lookup.surface_at(pose, glm::floor(inside) + 0.5);
}

} // namespace

PlacedSample placed_sample(const GazeSample& sample, const JoinedSample& joined, const SurfaceLookup* lookup,
                           SessionTime onset, Degrees reach) {
    PlacedSample placed;
    placed.sampled_at = sample.sampled_at;
    placed.pupil = sample.pupil_area;
    placed.has_gaze = sample.gaze.has_value();
    placed.gaze = sample.gaze.value_or(ScreenPoint{});
    if (joined.at) {
        placed.has_time = true;
        placed.time_s = to_seconds(joined.at->time - onset);
    }
    if (joined.shown) {
        placed.frame = joined.shown->frame.value;
        placed.pose = joined.shown->pose;
    }
    if (joined.sight.surface) {
        placed.is_on_surface = true;
        placed.surface = *joined.sight.surface;
    } else if (reach.value > 0.0 && joined.outline_distance &&
               joined.outline_distance->value <= reach.value) {
        if (const auto surface =
                surface_at_outline(*lookup, placed.pose, *joined.image_px, *joined.sight.outline_px)) {
            placed.is_within_reach = true;
            placed.surface = *surface;
        }
    }
    return placed;
}

PlacedSamples placed_samples(const SessionRecord& record, const TrialRecord& trial,
                             const std::optional<TrialLedger>& ledger, const SurfaceLookup* lookup,
                             SessionTime onset, Eye preferred, Degrees reach) {
    const SampleJoin join(record, trial, ledger, lookup);
    PlacedSamples placed;
    std::array<std::vector<PlacedSample>, 2> of_eye;
    std::array<std::int64_t, 2> with_gaze{0, 0};
    std::vector<JoinedSample> joined;
    record.read_samples(trial, 4096, [&](std::span<const GazeSample> samples) {
        joined.assign(samples.size(), {});
        join.join(samples, joined);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const GazeSample& sample = samples[i];
            const JoinedSample& at = joined[i];
            const auto eye = static_cast<std::size_t>(sample.eye);
            const PlacedSample& one =
                of_eye[eye].emplace_back(placed_sample(sample, at, lookup, onset, reach));
            with_gaze[eye] += one.has_gaze;
            if (at.at)
                placed.clock_uncertainty_s =
                    std::max(placed.clock_uncertainty_s, to_seconds(at.at->uncertainty));
            ++placed.counts.samples;
            placed.counts.without_gaze += !one.has_gaze;
            placed.counts.on_object += one.is_on_surface;
            placed.counts.off_plan += at.off_plan;
        }
    });
    placed.had_both_eyes = with_gaze[0] > 0 && with_gaze[1] > 0;
    auto taken = static_cast<std::size_t>(preferred);
    if (with_gaze[taken] == 0 && !of_eye[1 - taken].empty() &&
        (with_gaze[1 - taken] > 0 || of_eye[taken].empty()))
        taken = 1 - taken;
    placed.eye = static_cast<Eye>(taken);
    placed.samples = std::move(of_eye[taken]);
    return placed;
}

} // namespace overt
