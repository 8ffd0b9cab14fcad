#include <algorithm>

#include "experiment/base/error.h"
#include "experiment/clock_map.h"

namespace overt {

namespace {

/// What is no jump: clocks of computers are set right in smaller steps than this.
constexpr SessionDuration smallest_jump = std::chrono::milliseconds(1);

/// What is recorded lies no farther from the readings of its run: the clocks are read before and after each
/// recording.
constexpr SessionDuration farthest_from_readings = std::chrono::minutes(5);

SessionTime middle_of(const ClockPair& pair) { return pair.before + (pair.after - pair.before) / 2; }

/// The pairs of each run. A pair that only its neighbours contradict belongs to the run around it.
std::vector<std::vector<ClockPair>> runs_of(std::vector<ClockPair> pairs) {
    std::ranges::stable_sort(pairs, {}, &ClockPair::before);
    std::vector<std::vector<ClockPair>> runs{{pairs.front()}};
    ClockPair steady = pairs.front();
    for (std::size_t i = 1; i < pairs.size(); ++i) {
        const bool has_jumped = clock_jump(steady, pairs[i]).has_value();
        const bool is_alone = i + 1 < pairs.size() && !clock_jump(steady, pairs[i + 1]);
        if (has_jumped && !is_alone)
            runs.emplace_back();
        runs.back().push_back(pairs[i]);
        if (!has_jumped || !is_alone)
            steady = pairs[i];
    }
    return runs;
}

} // namespace

std::optional<SessionDuration> clock_jump(const ClockPair& from, const ClockPair& to) {
    const SessionDuration passed = middle_of(to) - middle_of(from);
    const SessionDuration jump = SessionDuration(to.other - from.other) - passed;
    const auto half_trips = ((from.after - from.before) + (to.after - to.before)) / 2;
    const SessionDuration drift =
        from_seconds(std::abs(to_seconds(passed)) * 1e-6 * ClockMapOf<TrackerClock>::largest_drift_ppm);
    return std::chrono::abs(jump) > half_trips + drift + smallest_jump ? std::optional(jump) : std::nullopt;
}

ClockMap::ClockMap(std::span<const ClockPair> pairs) {
    OVERT_EXPECTS(!pairs.empty());
    for (const std::vector<ClockPair>& run : runs_of({pairs.begin(), pairs.end()}))
        runs_.push_back({ClockMapOf<TrackerClock>(run), run.front().before, run.back().after});
}

/// The last that had begun; before the first one, the first.
const ClockMap::Run& ClockMap::run_at(SessionTime time) const {
    std::size_t found = 0;
    while (found + 1 < runs_.size() && runs_[found + 1].first <= time)
        ++found;
    return runs_[found];
}

MappedTime ClockMap::to_session(TrackerTime time) const {
    if (runs_.size() == 1)
        return runs_.front().line.to_session(time);
    struct Candidate {
        MappedTime mapped;
        bool is_possible; ///< near its own readings, after the run before, and before the one that follows
        SessionDuration distance; ///< from its own readings
    };
    const auto candidate_of = [&](std::size_t i) {
        const MappedTime mapped = runs_[i].line.to_session(time);
        const auto distance =
            std::max({SessionDuration{}, runs_[i].first - mapped.time, mapped.time - runs_[i].last});
        return Candidate{mapped,
                         distance <= farthest_from_readings && (i == 0 || mapped.time >= runs_[i - 1].last) &&
                             (i + 1 == runs_.size() || mapped.time <= runs_[i + 1].first),
                         distance};
    };
    Candidate best = candidate_of(0);
    for (std::size_t i = 1; i < runs_.size(); ++i) {
        const Candidate other = candidate_of(i);
        if (other.is_possible == best.is_possible ? other.distance <= best.distance : other.is_possible)
            best = other;
    }
    for (std::size_t i = 0; i < runs_.size(); ++i)
        if (const Candidate other = candidate_of(i); other.is_possible)
            best.mapped.uncertainty =
                std::max(best.mapped.uncertainty, std::chrono::abs(other.mapped.time - best.mapped.time));
    return best.mapped;
}

TrackerTime ClockMap::to_other(SessionTime time) const { return run_at(time).line.to_other(time); }

ClockMap ClockMap::at(SessionTime time) const { return ClockMap(run_at(time)); }

} // namespace overt
