/// A tracker in place of a device, whose samples are due at 2000 Hz by the machine's clock.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>
#include <ctime>

#include "app/bench/bench_clock.h"
#include "devices/tracker/tracker_driver.h"
#include "experiment/ports/clock.h"
#include "experiment/units.h"

namespace overt {

/// The tracker's clock is the session's: a sample's time is when it was due. Says how much processor time the
/// thread that reads it took.
class Metronome final : public TrackerDriver {
  public:
    static constexpr double rate_hz = 2000.0;
    /// Gaze by number, from 0 in each recording.
    using Gaze = ScreenPoint (*)(std::int64_t number);

    Metronome(const Clock& clock, std::atomic<double>& processor_s, Gaze gaze)
        : clock_(clock), processor_s_(processor_s), gaze_(gaze) {}

    TrackerDescription connect(const TrackerWish& wish) override {
        return {"metronome", rate_hz, wish.eye, wish.both_eyes};
    }
    void start() override { first_ = next_ = due() + 1; }
    void stop() noexcept override {}
    /// As EyeLink's library is asked, again and again: returns at once with what there is, else after a
    /// millisecond.
    RecordingState read(TrackerItemSink& sink, SessionTime deadline) noexcept override {
        if (due() < next_)
            wait_a_little(deadline);
        for (const std::int64_t due_now = due(); next_ <= due_now; ++next_) {
            GazeSample sample;
            sample.sampled_at = tracker_time(std::llround(1e6 * static_cast<double>(next_) / rate_hz));
            sample.gaze = gaze_(next_ - first_);
            sink.put(sample);
        }
        processor_s_ = thread_seconds();
        return RecordingState::running;
    }

  private:
    std::int64_t due() const noexcept {
        return static_cast<std::int64_t>(std::floor(to_seconds(clock_.now() - SessionTime{}) * rate_hz));
    }
    void wait_a_little(SessionTime deadline) const noexcept {
        const SessionTime until = std::min(deadline, clock_.now() + std::chrono::milliseconds(1));
        const auto ns = std::max<std::int64_t>(0, (until - clock_.now()).count());
        const timespec time{0, static_cast<long>(ns)};
        ::nanosleep(&time, nullptr);
    }

    const Clock& clock_;
    std::atomic<double>& processor_s_;
    Gaze gaze_;
    std::int64_t first_ = 0, next_ = 0;
};

} // namespace overt
