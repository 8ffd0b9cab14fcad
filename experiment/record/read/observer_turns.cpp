#include "experiment/record/read/observer_turns.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace overt {

ObserverTurns turns_of(std::span<const FlipRecord> flips, std::span<const SteeredFlip> steered,
                       const PoseTable& poses) {
    ObserverTurns turns;
    std::set<int> seen;
    std::vector<double> delays_s;
    std::optional<SessionTime> known;
    double direction = 0.0;
    const FlipRecord* before = nullptr;
    auto contains = steered.begin();
    for (const FlipRecord& flip : flips) {
        if (flip.shown == no_frame)
            continue;
        const double angle_deg = poses.object_of(flip.pose).angle.value;
        seen.insert(flip.pose.value);
        turns.end = {angle_deg};
        if (!before)
            turns.start = {angle_deg};
        else if (const double turn_deg =
                     std::remainder(angle_deg - poses.object_of(before->pose).angle.value, 360.0);
                 turn_deg != 0.0) {
            turns.net.value += turn_deg;
            turns.path.value += std::abs(turn_deg);
            turns.turning_s += to_seconds(flip.report.vertical_blank - before->report.vertical_blank);
            ++turns.changes;
            turns.reversals += direction * turn_deg < 0.0 ? 1 : 0;
            direction = turn_deg;
        }
        before = &flip;
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
    turns.poses = static_cast<int>(seen.size());
    if (!flips.empty()) {
        turns.step = flips.front().step;
        turns.seconds = to_seconds(flips.back().report.vertical_blank - flips.front().report.vertical_blank);
    }
    if (delays_s.empty())
        return turns;
    std::ranges::sort(delays_s);
    const std::size_t half = delays_s.size() / 2;
    turns.median_delay_s =
        delays_s.size() % 2 == 1 ? delays_s[half] : 0.5 * (delays_s[half - 1] + delays_s[half]);
    turns.longest_delay_s = delays_s.back();
    return turns;
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
    if (!ledger || record.header().animation_of(seen.trial.stimulus).kind != MotionKind::observer)
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
