/// A sensor before the screen that tells when light comes and goes, and what its edges say of the display.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "devices/link/byte_transport.h"
#include "experiment/base/random.h"
#include "experiment/ports/clock.h"

namespace overt {

/// Light came, or went.
struct LightEdge {
    SessionTime at;
    bool is_light = false;
};

class LightSensor {
  public:
    virtual ~LightSensor() = default;

    /// What the display was asked for, at the start of the refresh it was lit at: of use to a simulated
    /// sensor.
    virtual void shown(const LightEdge&) {}

    /// All edges since the sensor was made, in their order. Throws DeviceError if it was lost.
    virtual std::vector<LightEdge> edges() = 0;
};

/// Sees each edge so much later, with normal jitter.
class SimulatedLightSensor final : public LightSensor {
  public:
    SimulatedLightSensor(double latency_ms, double jitter_sd_ms, std::uint64_t seed);
    void shown(const LightEdge& edge) override;
    std::vector<LightEdge> edges() override { return edges_; }

  private:
    double latency_ms_, jitter_sd_ms_;
    RandomStream random_;
    std::vector<LightEdge> edges_;
};

/// A microcontroller on a serial line that sends `1` when light comes and `0` when it goes; everything else
/// is passed over. Edges are stamped when their byte arrives: a USB line adds up to 1 ms.
class SerialLightSensor final : public LightSensor {
  public:
    /// `clock` must go by itself and outlive the sensor. A thread of its own reads the line.
    SerialLightSensor(std::unique_ptr<ByteTransport> line, const Clock& clock);
    ~SerialLightSensor() override;
    std::vector<LightEdge> edges() override;

  private:
    void listen();
    std::unique_ptr<ByteTransport> line_;
    const Clock* clock_;
    std::mutex mutex_; ///< of edges_ and loss_
    std::vector<LightEdge> edges_;
    std::string loss_;
    std::atomic<bool> ends_{false};
    std::thread listener_;
};

/// From the vertical blank that the ledger has to the light that the sensor saw.
struct LightLatency {
    int matched = 0;
    int unseen = 0;                                                       ///< changes without an edge
    int unasked = 0;                                                      ///< edges without a change
    double mean_ms = 0.0, sd_ms = 0.0, lowest_ms = 0.0, highest_ms = 0.0; ///< of those matched
    std::vector<double> delays_ms = {}; ///< of those matched, in their order
};

/// Each change is matched with the first edge of its kind from `earliest_ms` after it until as long before or
/// after the next change of its kind. Below 0, edges that come before their change are found (a sensor may be
/// stamped better than the display, and a display's times may be wrong). Both in the order of time.
LightLatency compare_light(std::span<const LightEdge> changes, std::span<const LightEdge> edges,
                           double earliest_ms = -2.0);

} // namespace overt
