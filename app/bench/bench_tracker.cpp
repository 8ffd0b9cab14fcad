#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "app/bench/bench_clock.h"
#include "app/bench/bench_command.h"
#include "app/bench/metronome.h"
#include "app/rig/open_display.h"
#include "devices/host/clocks.h"
#include "devices/simulated/simulated_eye_tracker.h"
#include "devices/tracker/threaded_tracker.h"
#include "experiment/timing/refresh_ledger.h"
#include "render/presenter/page_presenter.h"

namespace overt {

namespace {

constexpr double display_hz = 120.0;
constexpr int shown_frames = 8;

/// Pages of one grey each.
class GreyPages final : public FrameSource {
  public:
    explicit GreyPages(int size_px) : picture_(glm::ivec2(size_px)) {
        for (glm::vec4& pixel : picture_.pixels)
            pixel = glm::vec4(glm::vec3(0.3F), 1.0F);
    }
    std::vector<int> page_of_frame(const Stimulus&) const override {
        std::vector<int> pages(shown_frames);
        std::iota(pages.begin(), pages.end(), 0);
        return pages;
    }
    LinearImage page(const Stimulus&, int) const override { return picture_; }
    const LinearImage& read_page(const Stimulus&, int, LinearImage&) const override { return picture_; }

  private:
    LinearImage picture_;
};

/// Gaze that bears its number.
ScreenPoint numbered(std::int64_t number) { return {static_cast<double>(number), 0.0}; }

/// What came, sample by sample.
struct Taken {
    std::int64_t samples = 0, lost = 0, doubled = 0;
    void take(std::span<const TrackerItem> items) {
        for (const TrackerItem& item : items)
            if (const auto* sample = std::get_if<GazeSample>(&item)) {
                const auto number = static_cast<std::int64_t>(sample->gaze->x_px);
                lost += std::max<std::int64_t>(0, number - next_);
                doubled += number < next_;
                next_ = number + 1;
                ++samples;
            }
    }

  private:
    std::int64_t next_ = 0;
};

struct Presentation {
    Taken taken;
    int refreshes = 0, missed = 0;
    double seconds = 0.0, processor_s = 0.0;
    double tracker_processor_s = 0.0; ///< of the thread that reads the tracker
};

/// Pages at 120 Hz in real time, with or without the tracker beside them: the loop of a trial.
Presentation present(const BenchOptions& options, bool with_tracker) {
    ScreenGeometry geometry;
    geometry.screen_px = {640, 480};
    geometry.image_px = glm::ivec2(std::min(options.size_px, 256));
    geometry.image_origin_px = centred_origin_px(geometry.screen_px, geometry.image_px);
    const GreyPages pages(geometry.image_px.x);
    OpenDisplay display({.context = options.context,
                         .size_px = geometry.screen_px,
                         .title = "overt bench",
                         .refresh_hz = display_hz,
                         .windowed = true,
                         .headless = true});
    display.start();
    DisplaySettings settings;
    settings.output = OutputMode::native_8bit;
    PagePresenter presenter(display.context(), display.surface(), pages, geometry, settings, {});
    Animation animation;
    animation.frame_count = shown_frames;
    animation.frame_rate_hz = 30.0;
    animation.duration_s = options.seconds;
    const PageCycle cycle = make_page_cycle(animation, display_hz);
    RefreshLedger ledger(cycle, animation.when_late);
    presenter.load_frames({0, 0});

    std::atomic<double> tracker_processor_s{0.0};
    Presentation result;
    ThreadedTracker tracker(std::make_unique<Metronome>(display.clock(), tracker_processor_s, numbered),
                            display.clock(), {.rate_hz = Metronome::rate_hz, .screen = geometry});
    std::vector<TrackerItem> items(4096);
    const auto take = [&] {
        std::size_t count = 0;
        do {
            count = tracker.poll(items);
            result.taken.take(std::span(items).first(count));
        } while (count == items.size());
    };
    if (with_tracker)
        tracker.start_recording();
    const double processor_before_s = processor_seconds();
    const SessionTime begin = display.clock().now();
    ledger.begin(0);
    while (!ledger.is_complete()) {
        if (with_tracker)
            take();
        ledger.enter(presenter.flip(ledger.next().frame));
    }
    result.seconds = to_seconds(display.clock().now() - begin);
    result.processor_s = processor_seconds() - processor_before_s;
    tracker.stop_recording();
    take();
    result.refreshes = cycle.total_refreshes;
    result.missed = ledger.missed_refreshes();
    result.tracker_processor_s = tracker_processor_s;
    return result;
}

/// Ten minutes of the simulated tracker, polled at each refresh.
void measure_virtual_time(BenchFigures& figures) {
    VirtualClock clock;
    ObservedScene scene;
    const SimulatedObserver observer(scene, 1);
    SimulatedEyeTracker tracker(clock, observer, 1, {.rate_hz = Metronome::rate_hz});
    std::vector<TrackerItem> items(4096);
    std::int64_t samples = 0, lost = 0, doubled = 0;
    std::optional<TrackerTime> last;
    const auto take = [&] {
        std::size_t count = 0;
        do {
            count = tracker.poll(items);
            for (std::size_t i = 0; i < count; ++i) {
                const TrackerTime at = std::get<GazeSample>(items[i]).sampled_at;
                const auto step = last ? (at - *last).count() : 500;
                lost += step > 501 ? step / 500 - 1 : 0;
                doubled += step < 499;
                last = at;
                ++samples;
            }
        } while (count == items.size());
    };
    constexpr int refreshes = 600 * static_cast<int>(display_hz);
    tracker.start_recording();
    const double before_s = processor_seconds();
    for (int refresh = 0; refresh < refreshes; ++refresh) {
        clock.wait_until(SessionTime(from_seconds((refresh + 1) / display_hz)));
        take();
    }
    tracker.stop_recording();
    take();
    figures.push_back(at_least("10 minutes of virtual time at 2000 Hz, samples", static_cast<double>(samples),
                               "", 600.0 * Metronome::rate_hz - 1.0));
    figures.push_back(at_most("the same, lost samples", static_cast<double>(lost), "", 0.0));
    figures.push_back(at_most("the same, doubled samples", static_cast<double>(doubled), "", 0.0));
    figures.push_back({"the same, processor time", processor_seconds() - before_s, "s"});
}

} // namespace

BenchFigures bench_tracker(const BenchOptions& options) {
    BenchFigures figures;
    measure_virtual_time(figures);
    const Presentation without = present(options, false), with = present(options, true);
    const std::string what =
        fmt::format("{:g} s of real time at 2000 Hz beside a presentation", options.seconds);
    figures.push_back(at_least(what + ", samples", static_cast<double>(with.taken.samples), "",
                               std::floor(with.seconds * Metronome::rate_hz) - 2.0));
    figures.push_back(at_most("the same, lost samples", static_cast<double>(with.taken.lost), "", 0.0));
    figures.push_back(at_most("the same, doubled samples", static_cast<double>(with.taken.doubled), "", 0.0));
    figures.push_back(at_most("the same, share of a core of the tracker's thread",
                              100.0 * with.tracker_processor_s / with.seconds, "%", 5.0));
    figures.push_back(
        {"the same, share of a core of the whole program", 100.0 * with.processor_s / with.seconds, "%"});
    figures.push_back({"without the tracker, share of a core of the whole program",
                       100.0 * without.processor_s / without.seconds, "%"});
    figures.push_back({"refreshes missed beside the tracker", static_cast<double>(with.missed),
                       fmt::format("of {}", with.refreshes)});
    figures.push_back({"refreshes missed without it", static_cast<double>(without.missed),
                       fmt::format("of {}", without.refreshes)});
    return figures;
}

} // namespace overt
