#include "experiment/record/read/observer_turns.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <glm/gtc/quaternion.hpp>

namespace overt {

namespace {

/// The angle of the rotation that takes one pose to another.
Degrees angle_between(const ObjectPose& from, const ObjectPose& to) {
    if (from.is_turn() && to.is_turn())
        return {std::abs(std::remainder(to.angle.value - from.angle.value, 360.0))};
    const auto rotation = [](const ObjectPose& pose) {
        return pose.tilt * glm::angleAxis(to_radians(pose.angle).value, glm::dvec3(0.0, 0.0, 1.0));
    };
    const glm::dquat between = rotation(to) * glm::conjugate(rotation(from));
    return to_degrees(
        {2.0 * std::atan2(glm::length(glm::dvec3(between.x, between.y, between.z)), std::abs(between.w))});
}

} // namespace

ObserverTurns turns_of(std::span<const FlipRecord> flips, std::span<const SteeredFlip> steered,
                       const PoseTable& poses) {
    ObserverTurns turns;
    std::set<int> seen;
    double direction = 0.0;
    const FlipRecord* before = nullptr;
    for (const FlipRecord& flip : flips) {
        if (flip.shown == no_frame)
            continue;
        const ObjectPose& pose = poses.object_of(flip.pose);
        seen.insert(flip.pose.value);
        turns.end = pose.angle;
        turns.end_elevation = elevation_of(pose);
        if (!before) {
            turns.start = turns.end;
            turns.start_elevation = turns.end_elevation;
        } else if (flip.pose != before->pose) {
            const ObjectPose& earlier = poses.object_of(before->pose);
            const double turn_deg = std::remainder(pose.angle.value - earlier.angle.value, 360.0);
            turns.net.value += turn_deg;
            turns.path.value += angle_between(earlier, pose).value;
            turns.turning_s += to_seconds(flip.report.vertical_blank - before->report.vertical_blank);
            ++turns.changes;
            turns.reversals += direction * turn_deg < 0.0 ? 1 : 0;
            direction = turn_deg != 0.0 ? turn_deg : direction;
        }
        before = &flip;
    }
    turns.poses = static_cast<int>(seen.size());
    if (!flips.empty()) {
        turns.step = flips.front().step;
        turns.seconds = to_seconds(flips.back().report.vertical_blank - flips.front().report.vertical_blank);
    }
    if (const std::optional<InputDelays> delays = summary_of(delays_in(flips, steered))) {
        turns.median_delay_s = delays->median_s;
        turns.longest_delay_s = delays->longest_s;
    }
    return turns;
}

std::vector<double> delays_in(std::span<const FlipRecord> flips, std::span<const SteeredFlip> steered) {
    std::vector<double> delays_s;
    std::optional<SessionTime> known;
    auto contains = steered.begin();
    for (const FlipRecord& flip : flips) {
        if (flip.shown == no_frame)
            continue;
        contains =
            std::ranges::find(contains, steered.end(), flip.refresh_in_trial, &SteeredFlip::refresh_in_trial);
        if (contains == steered.end()) {
            contains = steered.begin();
            continue;
        }
        if (contains->input_at && contains->input_at != known)
            delays_s.push_back(to_seconds(flip.report.vertical_blank - *contains->input_at));
        known = contains->input_at;
    }
    return delays_s;
}

std::optional<InputDelays> input_delays(const SessionRecord& record) {
    std::vector<double> all_s;
    for (const TrialRecord& trial : record.trials()) {
        for (std::size_t i = 0; trial.counts && i < trial.trial.shown_count(); ++i) {
            const TrialRecord seen = trial.seen_in(i);
            if (record.steered_flips(seen).empty())
                continue;
            const std::optional<TrialLedger> ledger = record.ledger(seen);
            if (!ledger)
                continue;
            const std::vector<SteeredFlip> steered = steered_as_fitted(record, seen, *ledger);
            const std::span<const FlipRecord> flips = ledger->fit.flips();
            for (const RecordedShow& show : shows_of(record.header(), seen, flips)) {
                const std::vector<double> of_show =
                    delays_in(flips.subspan(show.begin, show.end - show.begin), steered);
                all_s.insert(all_s.end(), of_show.begin(), of_show.end());
            }
        }
    }
    return summary_of(std::move(all_s));
}

std::vector<SteeredFlip> steered_as_fitted(const SessionRecord& record, const TrialRecord& seen,
                                           const TrialLedger& ledger) {
    std::vector<SteeredFlip> steered = record.steered_flips(seen);
    auto recorded = ledger.recorded.begin();
    for (SteeredFlip& moved : steered) {
        recorded = std::ranges::find(recorded, ledger.recorded.end(), moved.refresh_in_trial,
                                     &FlipRecord::refresh_in_trial);
        if (recorded == ledger.recorded.end())
            break;
        moved.refresh_in_trial =
            ledger.fit.flips()[static_cast<std::size_t>(recorded - ledger.recorded.begin())].refresh_in_trial;
    }
    return steered;
}

std::vector<ObserverTurns> observer_turns(const SessionRecord& record, const TrialRecord& seen,
                                          const std::optional<TrialLedger>& ledger) {
    std::vector<ObserverTurns> turns;
    if (!ledger || record.header().animation_of(seen.trial.stimulus).has_plan())
        return turns;
    const std::vector<SteeredFlip> steered = steered_as_fitted(record, seen, *ledger);
    const std::span<const FlipRecord> flips = ledger->fit.flips();
    for (const RecordedShow& show : shows_of(record.header(), seen, flips))
        if (show.is_lit)
            turns.push_back(
                turns_of(flips.subspan(show.begin, show.end - show.begin), steered, record.header().poses));
    return turns;
}

} // namespace overt
