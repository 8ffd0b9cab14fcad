/// The ioLab USB button box: eight buttons, a voice key and an optic key, with a clock of its own in
/// milliseconds.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "devices/buttons/box_times.h"
#include "devices/hid/hid_line.h"
#include "experiment/ports/button_box.h"

namespace overt {

inline constexpr std::uint16_t iolab_vendor_id = 0x19BC, iolab_product_id = 0x0001;

/// One report of the box: eight bytes, numbers with the highest byte first.
struct IolabReport {
    enum class Kind : std::uint8_t { key_down, key_up, clock, version, error, other };
    Kind kind = Kind::other;
    int button = 0;       ///< of a key, from 1; 9 and more: other inputs
    std::uint32_t ms = 0; ///< of a key and of the clock
};
std::optional<IolabReport> parse_iolab(std::span<const std::byte> report) noexcept;

/// An output report: id 0 (the box has no report ids), the command, and up to seven bytes.
std::array<std::byte, 9> iolab_command(char command, std::initializer_list<int> bytes = {}) noexcept;

/// Buttons are numbered from 1.
class IolabBox final : public ButtonBox {
  public:
    /// Sets the box up as its maker's library does: lamps free, heartbeat 30 s, debouncing 20 ms down and 5
    /// ms up, all inputs on, clock at zero. `clock` must outlive this. Throws DeviceError if the box does not
    /// answer.
    IolabBox(std::unique_ptr<HidLine> line, Clock& clock);

    ButtonBoxDescription description() const override;
    void begin() override;
    std::size_t poll(std::span<ButtonChange> into) noexcept override;
    bool lost() const noexcept override { return line_->lost(); }

  private:
    void send(std::array<std::byte, 9> report);
    std::optional<IolabReport> answer(IolabReport::Kind kind, SessionTime deadline);
    void read_clocks();

    std::unique_ptr<HidLine> line_;
    Clock* clock_;
    BoxTimes times_;
    SessionTime looked_;
};

} // namespace overt
