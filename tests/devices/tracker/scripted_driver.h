/// A driver of a tracker that does what a test says, on the steady clock.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "devices/tracker/tracker_driver.h"
#include "experiment/ports/clock.h"

namespace overt::test {

/// What happened to a ScriptedDriver; outlives it.
struct DriverDiary {
    std::atomic<int> connects{0}, starts{0}, stops{0}, reads{0};
    std::mutex mutex;
    std::vector<std::string> marks;
    std::atomic<bool> unplugged{false};
    std::atomic<RecordingState> state{RecordingState::running};
};

/// Samples at a rate, numbered in x_px; never misses or doubles one.
class ScriptedDriver final : public TrackerDriver {
  public:
    ScriptedDriver(Clock& clock, DriverDiary& diary, double rate_hz)
        : clock_(clock), diary_(diary), interval_ns_(static_cast<std::int64_t>(1e9 / rate_hz)) {}

    TrackerDescription connect(const TrackerWish& wish) override {
        ++diary_.connects;
        return {"scripted", wish.rate_hz, wish.eye, wish.both_eyes};
    }
    void start() override {
        ++diary_.starts;
        next_ = clock_.now().time_since_epoch().count() / interval_ns_ + 1;
    }
    void stop() noexcept override { ++diary_.stops; }
    RecordingState read(TrackerItemSink& sink, SessionTime deadline) noexcept override {
        ++diary_.reads;
        if (diary_.unplugged)
            return RecordingState::lost;
        clock_.wait_until(deadline);
        const std::int64_t now = clock_.now().time_since_epoch().count();
        for (; next_ * interval_ns_ <= now; ++next_) {
            GazeSample sample;
            sample.sampled_at = tracker_time(next_ * interval_ns_ / 1000);
            sample.gaze = ScreenPoint{static_cast<double>(count_++), 540.0};
            sink.put(sample);
        }
        return diary_.state;
    }
    void send(const TrackerMark& mark) noexcept override {
        const std::lock_guard lock(diary_.mutex);
        diary_.marks.emplace_back(mark.text);
    }
    std::optional<ClockPair> read_clocks() noexcept override {
        const SessionTime now = clock_.now();
        return ClockPair{now, tracker_time(now.time_since_epoch().count() / 1000), now};
    }

  private:
    Clock& clock_;
    DriverDiary& diary_;
    std::int64_t interval_ns_, next_ = 0, count_ = 0;
};

} // namespace overt::test
