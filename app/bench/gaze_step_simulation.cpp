#include "app/bench/gaze_step_simulation.h"

#include <chrono>
#include <cmath>

#include "app/rig/seen_areas.h"
#include "experiment/analysis/flip_history.h"
#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/session/gaze_watch.h"

namespace overt {

namespace {

constexpr double sample_rate_hz = 2000.0;
constexpr std::int64_t step_sample_us = 500;
constexpr double piece_s = 0.2, blink_s = 0.3;
constexpr std::int64_t piece_samples = 400; ///< intervals

/// The tracker's clock: an origin of its own, and some millionths faster or slower.
struct PlantedClock {
    std::int64_t origin_us = 0;
    double rate = 1.0; ///< of the session's clock, by the tracker's

    SessionTime session_of(TrackerTime at) const {
        const double us = static_cast<double>((at - tracker_time(origin_us)).count());
        return SessionTime(SessionDuration(std::llround(1e3 * us * rate)));
    }
    TrackerTime tracker_of(SessionTime at) const {
        const double us = static_cast<double>(at.time_since_epoch().count()) / 1e3 / rate;
        return tracker_time(origin_us + std::llround(us));
    }
};

/// Places of the screen that are on the area in a pose, and that are not: of the slot, and of others.
class Places {
  public:
    Places(const AreaView& area, const ScreenGeometry& screen, int poses,
           std::span<const ScreenGeometry> other_slots) {
        constexpr int columns = 48;
        std::vector<ScreenPoint> elsewhere;
        for (const ScreenGeometry& other : other_slots)
            for (int i = 0; i < columns * columns; i += 2)
                elsewhere.push_back(
                    other.screen_from_image({(i % columns + 0.5) * other.image_px.x / columns,
                                             (i / columns + 0.5) * other.image_px.y / columns}));
        by_pose_.resize(static_cast<std::size_t>(poses));
        for (int pose = 0; pose < poses; ++pose)
            for (int i = 0; i < columns * columns; ++i) {
                const ScreenPoint place =
                    screen.screen_from_image({(i % columns + 0.5) * screen.image_px.x / columns,
                                              (i / columns + 0.5) * screen.image_px.y / columns});
                by_pose_[static_cast<std::size_t>(pose)][area.is_at({pose}, place) ? 1 : 0].push_back(place);
            }
        for (const auto& both : by_pose_)
            if (both[0].empty() || both[1].empty())
                throw InputError("the area is nowhere, or everywhere, in a pose of the object");
        for (auto& both : by_pose_)
            both[0].insert(both[0].end(), elsewhere.begin(), elsewhere.end());
    }
    const std::vector<ScreenPoint>& of(PoseIndex pose, bool on_area) const {
        return by_pose_[static_cast<std::size_t>(pose.value)][on_area ? 1 : 0];
    }

  private:
    std::vector<std::array<std::vector<ScreenPoint>, 2>> by_pose_;
};

std::vector<FlipRecord> planted_flips(const PageCycle& plan, double refresh_hz, RandomStream& random) {
    std::vector<FlipRecord> flips;
    for (int refresh = 0; refresh < plan.total_refreshes; ++refresh) {
        if (refresh > 0 && random.below(100) == 0)
            ++refresh; // went by with the picture before
        if (refresh >= plan.total_refreshes)
            break;
        const PageCycleEntry& entry = plan.entry_at(refresh);
        FlipRecord flip{0, refresh, entry.frame, entry.frame, entry.pose, {}};
        flip.report.refresh = {refresh};
        flip.report.vertical_blank = SessionTime(from_seconds(5.0 + refresh / refresh_hz));
        flips.push_back(flip);
    }
    return flips;
}

/// What a further slot shows with the same flips.
SlotFlip slot_flip_of(const FlipRecord& flip, const PageCycle& plan, int place) {
    const PageCycleEntry& entry = plan.entry_at(flip.refresh_in_trial);
    return {flip.trial, flip.refresh_in_trial, place, entry.frame, entry.frame, entry.pose};
}

/// The flips as the ledger of one slot has them.
std::vector<FlipRecord> flips_of_slot(std::vector<FlipRecord> flips, const PageCycle& plan, int place) {
    for (FlipRecord& flip : flips) {
        const SlotFlip own = slot_flip_of(flip, plan, place);
        flip.planned = own.planned;
        flip.shown = own.shown;
        flip.pose = own.pose;
    }
    return flips;
}

struct PlantedPath {
    std::vector<GazeSample> samples;
    TrackerTime onset, detected;
};

/// Gaze that comes to the area for good with sample `onset`, and what a condition has to say of it.
PlantedPath planted_path(const FlipHistory& history, const PlantedClock& clock, SessionTime begin,
                         SessionTime end, const Places& places, bool has_blink, RandomStream& random) {
    enum class What : std::uint8_t { off, on, lost };
    const auto onset = static_cast<std::int64_t>(500 + random.below(2500));
    const auto blink_begin = onset + 50 + static_cast<std::int64_t>(random.below(250));
    const auto blink_length = has_blink ? static_cast<std::int64_t>(20 + random.below(500)) : 0;
    // A piece that is too short, and one sample outside between it and the one that counts.
    const auto visit = static_cast<std::int64_t>(random.below(piece_samples));
    const auto what_is = [&](std::int64_t k) {
        if (has_blink && k >= blink_begin && k < blink_begin + blink_length)
            return What::lost;
        if (k >= onset)
            return What::on;
        return k < onset - 1 && k >= onset - 1 - visit ? What::on : What::off;
    };
    PlantedPath path;
    const TrackerTime first = clock.tracker_of(begin);
    for (std::int64_t k = 0;; ++k) {
        GazeSample sample;
        sample.sampled_at = first + TrackerClock::duration(step_sample_us * k);
        const SessionTime at = clock.session_of(sample.sampled_at);
        if (at >= end)
            break;
        const What what = what_is(k);
        // The frame that is lit depends on the row, and the row on the frame's places: until they agree.
        std::optional<LitFrame> lit = history.frame_shown_at(at, 0.0);
        for (int drawn = 0; what != What::lost && drawn < 1000; ++drawn) {
            if (!lit)
                break;
            const std::vector<ScreenPoint>& all = places.of(lit->pose, what == What::on);
            const ScreenPoint place = all[random.below(static_cast<std::uint32_t>(all.size()))];
            const std::optional<LitFrame> there = history.frame_shown_at(at, place.y_px);
            sample.gaze = place;
            if (there && there->pose == lit->pose)
                break;
            lit = there;
        }
        if (!lit && what == What::off)
            sample.gaze = ScreenPoint{1.0, 1.0}; // before the first light
        path.samples.push_back(sample);
    }
    path.onset = first + TrackerClock::duration(step_sample_us * onset);
    const bool blinks_within = has_blink && blink_begin <= onset + piece_samples;
    path.detected =
        path.onset +
        TrackerClock::duration(step_sample_us * (piece_samples + (blinks_within ? blink_length + 1 : 0)));
    return path;
}

} // namespace

GazeStepTrials simulate_gaze_steps(const Protocol& protocol, std::span<const Object> objects,
                                   const std::string& area, int trials, std::uint64_t seed,
                                   const GazeStepScene& scene) {
    OVERT_EXPECTS(scene.awaited < scene.shown.size());
    const double refresh_hz = protocol.display.refresh_hz;
    const PoseTable poses = poses_of(protocol);
    const std::vector<PageCycle> cycles = page_cycles(protocol);
    std::vector<PageCycle> plans;
    std::vector<ScreenGeometry> other_slots;
    for (std::size_t i = 0; i < scene.shown.size(); ++i) {
        const PlacedStimulus& shown = scene.shown[i];
        plans.push_back(cut_to(cycles[static_cast<std::size_t>(shown.stimulus.motion)],
                               static_cast<int>(std::lround(3.0 * refresh_hz)), std::nullopt));
        if (i != scene.awaited)
            other_slots.push_back(
                slot_geometry(protocol, protocol.slots[static_cast<std::size_t>(shown.slot)]));
    }
    const auto awaited = static_cast<int>(scene.awaited);
    const PlacedStimulus& looked_at = scene.shown[scene.awaited];
    SeenAreas seen(protocol, objects, poses);
    const std::shared_ptr<const AreaView> view = seen.area_of(looked_at, area);
    if (!view)
        throw InputError("the object has no area " + area);
    const ScreenGeometry screen =
        slot_geometry(protocol, protocol.slots[static_cast<std::size_t>(looked_at.slot)]);
    const Places places(*view, screen, static_cast<int>(poses.angles.size()), other_slots);
    const ScanOut scan_out{from_seconds(1e-3 * protocol.display.latency_ms), refresh_hz,
                           static_cast<double>(screen.screen_px.y)};
    GazeWait wait;
    wait.area = area;
    wait.for_s = piece_s;
    wait.blink_s = blink_s;

    std::vector<SlotFlip> further;
    const auto further_of = [&](const FlipRecord& flip) -> std::span<const SlotFlip> {
        further.clear();
        for (std::size_t i = 1; i < plans.size(); ++i)
            further.push_back(slot_flip_of(flip, plans[i], static_cast<int>(i)));
        return further;
    };
    GazeStepTrials result;
    GazeWatch watch(screen, protocol.display);
    std::chrono::steady_clock::duration looking{};
    for (int trial = 0; trial < trials; ++trial) {
        RandomStream random(seed, "planted gaze step", static_cast<std::uint64_t>(trial));
        const std::vector<FlipRecord> flips = planted_flips(plans.front(), refresh_hz, random);
        const PageCycle& plan = plans[scene.awaited];
        const FlipHistory history(flips_of_slot(flips, plan, awaited), scan_out, plan);
        const PlantedClock clock{static_cast<std::int64_t>(random.below(1'000'000'000)),
                                 1.0 + 1e-6 * random.uniform(-50.0, 50.0)};
        std::vector<ClockPair> readings;
        for (int second = 0; second <= 4; ++second) {
            const SessionTime read{std::chrono::seconds(second)};
            readings.push_back({read - std::chrono::microseconds(40), clock.tracker_of(read),
                                read + std::chrono::microseconds(40)});
        }
        const SessionTime begin =
            flips.front().report.vertical_blank + from_seconds(random.uniform(0.0, 0.01));
        const PlantedPath path = planted_path(history, clock, begin, flips.back().report.vertical_blank,
                                              places, trial % 2 == 1, random);
        const SessionDuration late = from_seconds(random.uniform(0.001, 0.006));
        // As TrialRun::present: what has come is looked at before each flip.
        watch.begin(wait, {{}, {{awaited, view}}}, 0, SessionTime(), readings,
                    {"planted", sample_rate_hz, Eye::right});
        std::size_t next = 0, ended = flips.size();
        for (std::size_t flip = 0; flip < flips.size() && ended == flips.size(); ++flip) {
            const SessionTime now =
                flip == 0 ? flips[0].report.vertical_blank
                          : flips[flip - 1].report.vertical_blank + from_seconds(0.2 / refresh_hz);
            const auto from = std::chrono::steady_clock::now();
            while (next < path.samples.size() &&
                   clock.session_of(path.samples[next].sampled_at) + late <= now)
                watch.take(path.samples[next++]);
            looking += std::chrono::steady_clock::now() - from;
            if (watch.has_come())
                ended = flip;
            else
                watch.flipped(flips[flip], further_of(flips[flip]));
        }
        ++result.trials;
        const bool is_exact =
            watch.condition().onset() == path.onset && watch.condition().detected() == path.detected;
        result.at_planted_sample += is_exact;
        const SessionTime came = clock.session_of(path.detected) + late;
        const auto looked_before = [&](std::size_t flip) {
            return flips[flip - 1].report.vertical_blank + from_seconds(0.2 / refresh_hz);
        };
        result.at_next_flip += ended > 1 && ended < flips.size() && looked_before(ended) >= came &&
                               looked_before(ended - 1) < came;
        // From the record: the same samples, with the frames that the flips say afterwards.
        GazeCondition again({std::chrono::microseconds(200'000), std::chrono::microseconds(300'000),
                             std::chrono::microseconds(step_sample_us)});
        const ClockMap map(readings);
        for (std::size_t i = 0; i < next; ++i) {
            const GazeSample& sample = path.samples[i];
            bool is_inside = false;
            if (sample.gaze)
                if (const auto lit =
                        history.frame_shown_at(map.to_session(sample.sampled_at).time, sample.gaze->y_px))
                    is_inside = view->is_at(lit->pose, *sample.gaze);
            again.take({sample.sampled_at, sample.gaze.has_value(), is_inside});
            result.on_area += is_inside;
        }
        result.samples += static_cast<std::int64_t>(next);
        result.again_from_record +=
            again.onset() == watch.condition().onset() && again.detected() == watch.condition().detected();
    }
    if (result.samples > 0)
        result.look_us =
            std::chrono::duration<double, std::micro>(looking).count() / static_cast<double>(result.samples);
    return result;
}

} // namespace overt
