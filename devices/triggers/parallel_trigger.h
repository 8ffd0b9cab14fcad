/// A parallel port: a marker is the byte on its data lines.
#pragma once

#include <atomic>
#include <string>

#include "devices/link/descriptor_line.h"
#include "devices/triggers/marker_output.h"

namespace overt {

/// By the kernel's ppdev: /dev/parportN, data lines D0 to D7 on pins 2 to 9.
class ParallelTrigger final : public MarkerOutput {
  public:
    /// Takes the port for this program and puts its lines to 0. Throws DeviceError naming the port: not
    /// there, no permission, in use.
    explicit ParallelTrigger(const std::string& path);
    ~ParallelTrigger() override;

    const std::string& name() const noexcept override { return name_; }
    bool needs_code() const noexcept override { return true; }
    bool send(const Marker& marker) noexcept override { return write(marker.code); }
    void rest() noexcept override { write(0); }
    std::string fault() const override;

  private:
    bool write(std::uint8_t byte) noexcept;

    std::string name_;
    Descriptor port_;
    std::atomic<int> error_{0}; ///< errno of what failed last
};

} // namespace overt
