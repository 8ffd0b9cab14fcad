#include "experiment/study/read/trial_reader.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/study/read/gaze_quality.h"

namespace overt {

namespace {

std::vector<StudyTurn> turns_of(const TrialLedger& ledger, SessionTime onset,
                                const std::vector<ObjectPose>& angles) {
    std::vector<StudyTurn> turns;
    for (const FlipRecord& flip : ledger.fit.flips()) {
        if (flip.shown == no_frame || (!turns.empty() && turns.back().frame == flip.shown.value))
            continue;
        turns.push_back({to_seconds(flip.report.vertical_blank - onset),
                         angles[static_cast<std::size_t>(flip.pose.value)].angle.value, flip.shown.value});
    }
    return turns;
}

/// From the onset to the last sample, or to the end of the last event: how long a trial was recorded that
/// does not say how long it showed something.
double recorded_s(std::span<const PlacedSample> samples, std::span<const GazeEvent> events,
                  const std::optional<ClockMap>& clock_map, SessionTime onset) {
    double last_s = 0.0;
    for (const PlacedSample& sample : samples)
        if (sample.has_time)
            last_s = std::max(last_s, sample.time_s);
    if (clock_map)
        for (const GazeEvent& event : events)
            last_s = std::max(last_s, to_seconds(clock_map->to_session(event.start).time - onset) +
                                          std::chrono::duration<double>(event.duration).count());
    return last_s;
}

/// Every n-th sample, but the first of each loss of the eye too, so that blinks stay visible.
StudyTrace trace_of(std::span<const PlacedSample> samples, std::span<const GazeEvent> events,
                    const std::optional<ClockMap>& clock_map, SessionTime onset, double presentation_s,
                    double rate_hz) {
    StudyTrace trace;
    const auto step = static_cast<std::size_t>(std::max(1.0, std::ceil(rate_hz / most_trace_hz - 1e-6)));
    bool had_gaze = true;
    std::size_t since = step;
    for (const PlacedSample& sample : samples) {
        if (!sample.has_time || sample.time_s < 0.0 || sample.time_s > presentation_s)
            continue;
        ++since;
        if (since >= step || sample.has_gaze != had_gaze) {
            trace.points.push_back(
                {sample.time_s, sample.has_gaze ? std::optional(sample.gaze) : std::nullopt, sample.pupil});
            since = 0;
        }
        had_gaze = sample.has_gaze;
    }
    if (clock_map) {
        for (const GazeEvent& event : events) {
            const double begin = to_seconds(clock_map->to_session(event.start).time - onset);
            const double duration = std::chrono::duration<double>(event.duration).count();
            if (begin + duration > 0.0 && begin < presentation_s)
                trace.events.push_back(
                    {event.kind, begin, duration, event.amplitude_deg, event.peak_velocity_deg_s});
        }
    }
    return trace;
}

/// The first rule that a trial breaks, as a sentence; empty: none.
std::string exclusion_of(const StudyQuality& quality, const ExclusionRules& rules) {
    const std::optional<ExclusionRule> rule = broken_rule(quality, rules);
    if (rule == ExclusionRule::lost_share)
        return fmt::format("{:.1f} % of the samples were lost outside of blinks.",
                           100.0 * quality.lost_share());
    if (rule == ExclusionRule::accuracy)
        return fmt::format("The validation before it had a mean error of {:.2f} deg.", *quality.accuracy_deg);
    if (rule == ExclusionRule::drift)
        return fmt::format("The drift check found an error of {:.2f} deg.", *quality.drift_deg);
    if (rule == ExclusionRule::missed_refreshes)
        return quality.missed_refreshes ? fmt::format("{} refreshes were missed.", *quality.missed_refreshes)
                                        : "How many refreshes were missed is unproven.";
    return {};
}

} // namespace

ReadTrial read_trial(const SessionRecord& record, const TrialRecord& trial, const TrialKeys& keys,
                     std::span<const RecordedAccuracy> validations, const TrialSurface& surface,
                     const StudyOptions& options) {
    const SessionHeader& header = record.header();
    const std::optional<TrialLedger> ledger = record.ledger(trial);
    const TrialPresentation presentation = presentation_of(header, trial, ledger.has_value(), validations);
    const ScreenGeometry screen = header.screen_of_slot(trial.trial.slot);
    const bool has_other_slots = !trial.trial.beside.empty();
    const SessionTime onset = presentation.onset;
    ReadTrial read;
    StudyTrial& of = read.trial;
    of.number = trial.trial.index + 1;
    of.label = fmt::format("observer {}, trial {}", header.schedule.observer.label, of.number);
    if (has_other_slots)
        of.label += ", slot " + header.slots[static_cast<std::size_t>(trial.trial.slot)].id;
    of.presentation_s = presentation.duration_s.value_or(0.0);

    const double accuracy_deg = presentation.validation ? presentation.validation->mean_deg : 0.0;
    const PlacedSamples placed =
        placed_samples(record, trial, ledger, surface.lookup, onset, header.tracker.eye,
                       Degrees{options.reach_deg.value_or(accuracy_deg)});
    read.samples = placed.counts.samples;
    read.had_both_eyes = placed.had_both_eyes;
    of.clock_uncertainty_s = placed.clock_uncertainty_s;
    of.keys = keys.of(trial, placed.counts);
    std::vector<GazeEvent> events;
    record.read_gaze_events(trial, [&](const GazeEvent& event) {
        if (is_eye_event(event.kind) && (!event.eye || *event.eye == placed.eye))
            events.push_back(event);
    });
    std::stable_sort(events.begin(), events.end(),
                     [](const GazeEvent& a, const GazeEvent& b) { return a.start < b.start; });

    const std::optional<ClockMap> clock_map = record.clock_map(trial);
    if (!presentation.duration_s)
        of.presentation_s = recorded_s(placed.samples, events, clock_map, onset);

    of.quality = gaze_quality(placed.samples, events, screen);
    if (presentation.validation) {
        of.quality.accuracy_deg = presentation.validation->mean_deg;
        of.quality.worst_accuracy_deg = presentation.validation->worst_deg;
    }
    if (trial.outcome.drift)
        of.quality.drift_deg = trial.outcome.drift->value;
    if (header.is_timing_unproven())
        of.quality.missed_refreshes.reset();
    else
        of.quality.missed_refreshes = trial.outcome.missed_refreshes;
    of.quality.refreshes = trial.outcome.shown_refreshes + trial.outcome.missed_refreshes;
    of.quality.off_plan = static_cast<double>(placed.counts.off_plan);
    const auto is_fixation = [](const GazeEvent& event) { return event.kind == GazeEvent::Kind::fixation; };
    of.has_gaze = std::ranges::any_of(placed.samples, &PlacedSample::has_gaze) ||
                  std::ranges::any_of(events, is_fixation);
    // Means over trials would be too low with a trial in which nobody was measured.
    of.why_excluded = of.has_gaze ? exclusion_of(of.quality, options.exclude) : "No gaze was recorded in it.";
    of.excluded = !of.why_excluded.empty();

    if (ledger)
        of.turns = turns_of(*ledger, onset, header.poses.angles);
    read.trace = trace_of(placed.samples, events, clock_map, onset, of.presentation_s,
                          of.quality.rate_hz.value_or(0.0));

    // The cone is as wide as the validation says; few directions do for a share of some per cent.
    constexpr int cone_directions = 64;
    std::optional<GazeCone> cone;
    if (surface.lookup && surface.scale)
        cone.emplace(screen, Degrees{of.quality.accuracy_deg.value_or(GazeCone::usual_accuracy.value)},
                     cone_directions);
    const Stimulus& stimulus = trial.trial.stimulus;
    const ShownPictures pictures =
        shown_pictures(header.animation_of(stimulus), header.poses.frames_of(stimulus.motion));
    const FixationContext context{options,
                                  placed.samples,
                                  clock_map,
                                  onset,
                                  of.presentation_s,
                                  header.poses.angles,
                                  surface.scale,
                                  surface.lookup != nullptr,
                                  presentation.has_stimulus,
                                  surface.has_mesh,
                                  surface.ways,
                                  surface.lookup,
                                  cone ? &*cone : nullptr,
                                  of.quality.accuracy_deg.has_value(),
                                  &screen,
                                  surface.light,
                                  &pictures,
                                  has_other_slots};
    for (const GazeEvent& event : events) {
        if (event.kind != GazeEvent::Kind::fixation)
            continue;
        std::optional<StudyFixation> fixation = surface_fixation(event, context);
        if (!fixation)
            continue;
        if (of.excluded && fixation->counted())
            fixation->why = NotCounted::trial_excluded;
        read.fixations.push_back(*fixation);
    }
    return read;
}

} // namespace overt
