/// Sends markers from a thread of its own, so that the thread that presents never waits for a device.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <thread>

#include "devices/triggers/marker_output.h"
#include "experiment/base/bell.h"
#include "experiment/base/spsc_ring.h"
#include "experiment/ports/clock.h"

namespace overt {

/// How long an output stays raised.
struct MarkerPulse {
    /// Zero: codes are not taken back, as for outputs that make their pulses by themselves.
    SessionDuration length = std::chrono::milliseconds(5);
    /// At least so long an output rests before the next code, so that two pulses of one code are two.
    SessionDuration pause = std::chrono::milliseconds(2);
};

/// Markers go out one after the other. One that comes while a pulse lasts goes out after it and the pause;
/// how late that is stands in what poll() tells.
class ThreadedMarkerSink final : public MarkerSink {
  public:
    /// `clock` must go by itself and outlive the sink. `capacity`: markers held at a time, and their fates.
    ThreadedMarkerSink(std::unique_ptr<MarkerOutput> output, Clock& clock, MarkerPulse pulse = {},
                       std::size_t capacity = 4096);
    ~ThreadedMarkerSink() override;

    const std::string& name() const noexcept override { return output_->name(); }
    void mark(const Marker& marker) noexcept override;
    std::size_t poll(std::span<SentMarker> into) noexcept override;
    std::vector<std::string> finish() override;

  private:
    struct Held {
        SessionTime at;
        std::int64_t number;
        std::array<char, longest_marker> text;
        std::uint8_t length, code;
    };
    void serve(const std::stop_token& stop) noexcept;
    void send(const Held& held) noexcept;

    std::unique_ptr<MarkerOutput> output_;
    Clock& clock_;
    MarkerPulse pulse_;
    SpscRing<Held> held_;
    SpscRing<SentMarker> fates_;
    Bell bell_;
    std::atomic<std::int64_t> crowded_{0}, failed_{0},
        untold_{0};       ///< markers; untold: their fates had no room
    std::jthread thread_; ///< until finish()
};

} // namespace overt
