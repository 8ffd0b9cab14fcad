#include "app/bench/bench_gaze.h"

#include <algorithm>

#include "experiment/base/random.h"
#include "experiment/protocol/all_stimuli.h"

namespace overt {

namespace {

constexpr std::int64_t sample_us = 500;
constexpr double fixations_on_object = 5.0 / 6.0;
constexpr double wandering_px = 2.5; ///< 0.03 degrees at the usual distance
constexpr int saccade_samples = 80;  ///< 40 ms

std::vector<FlipRecord> presented(const PageCycle& plan, double refresh_hz, RandomStream& random) {
    std::vector<FlipRecord> flips;
    for (int refresh = 0; refresh < plan.total_refreshes; ++refresh) {
        const PageCycleEntry& entry = plan.entry_at(refresh);
        if (refresh > 0 && random.below(300) == 0)
            ++refresh;
        FlipRecord flip{0, refresh, entry.frame, entry.frame, entry.pose, {}};
        flip.report.refresh = {refresh};
        flip.report.vertical_blank = SessionTime(from_seconds(1.0 + refresh / refresh_hz));
        flips.push_back(flip);
    }
    return flips;
}

/// Gives one image point after another.
class GazePath {
  public:
    GazePath(const CoordinateMaps& maps, GazeKind kind, RandomStream& random)
        : maps_(maps), kind_(kind), random_(random) {}

    glm::dvec2 next() {
        if (kind_ == GazeKind::uniform)
            return anywhere();
        if (left_ == 0) {
            from_ = to_;
            to_ = place();
            left_ = 300 + static_cast<int>(random_.below(600)) + saccade_samples;
            saccade_left_ = saccade_samples;
        }
        --left_;
        saccade_left_ = std::max(saccade_left_ - 1, 0);
        const glm::dvec2 along = glm::mix(to_, from_, static_cast<double>(saccade_left_) / saccade_samples);
        return along + wandering_px * glm::dvec2(spread(), spread());
    }

  private:
    double spread() { return random_.uniform() + random_.uniform() + random_.uniform() - 1.5; }
    glm::dvec2 anywhere() {
        return {random_.uniform(0.0, maps_.image_px().x), random_.uniform(0.0, maps_.image_px().y)};
    }
    glm::dvec2 place() {
        const bool on_object = random_.uniform() < fixations_on_object;
        for (;;) {
            const glm::dvec2 place = anywhere();
            if (!on_object || maps_.cells({0}).cell(glm::ivec2(place)).is_covered())
                return place;
        }
    }

    const CoordinateMaps& maps_;
    GazeKind kind_;
    RandomStream& random_;
    glm::dvec2 from_{0.0}, to_{0.0};
    int left_ = 0, saccade_left_ = 0;
};

} // namespace

std::vector<BenchRecording> bench_recordings(const Protocol& protocol, const ScreenGeometry& screen,
                                             const CoordinateMaps& maps, GazeKind kind, int presentations) {
    const PageCycle plan = page_cycles(protocol).front();
    const ScanOut scan_out{from_seconds(0.0015), protocol.display.refresh_hz,
                           static_cast<double>(screen.screen_px.y)};
    // The tracker's clock reads 7 s more and goes 20 millionths faster.
    std::vector<ClockPair> pairs;
    for (int second = 0; second <= 10; ++second) {
        const SessionTime read{std::chrono::seconds(second)};
        pairs.push_back({read, TrackerTime(std::chrono::microseconds(7'000'000 + 1'000'020 * second)),
                         read + std::chrono::microseconds(80)});
    }
    std::vector<BenchRecording> recordings;
    for (int i = 0; i < presentations; ++i) {
        RandomStream random(1, "bench gaze", static_cast<std::uint64_t>(i));
        BenchRecording recording{
            {presented(plan, protocol.display.refresh_hz, random), scan_out, plan}, ClockMap(pairs), {}};
        GazePath path(maps, kind, random);
        const std::int64_t count = 1'000'000 * plan.total_refreshes /
                                   static_cast<std::int64_t>(protocol.display.refresh_hz) / sample_us;
        for (std::int64_t k = 0; k < count; ++k) {
            GazeSample sample;
            sample.sampled_at = TrackerTime(std::chrono::microseconds(8'003'000 + sample_us * k));
            sample.gaze = screen.screen_from_image(path.next());
            sample.pupil_area = 1000.0f;
            recording.samples.push_back(sample);
        }
        recordings.push_back(std::move(recording));
    }
    return recordings;
}

} // namespace overt
