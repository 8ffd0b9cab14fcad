/// Response boxes of Cedrus that speak XID over a serial line (RB-x30, RB-x40, Lumina, Riponda): the
/// language, and the box with its clock in milliseconds.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "devices/buttons/box_times.h"
#include "devices/buttons/xid_line.h"
#include "experiment/ports/button_box.h"
#include "experiment/ports/clock.h"

namespace overt {

/// A packet of a key: six bytes that begin with k, or nine that begin with o.
struct XidKey {
    int key = 0;  ///< as the box numbers it, 1 to 8
    int port = 0; ///< 0: the buttons; others: voice key, light sensor, scanner
    bool is_down = false;
    std::uint32_t ms = 0; ///< of the box's clock
};

/// Packets out of a stream of bytes that comes in any pieces. What begins no packet is passed over.
class XidParser {
  public:
    /// Keeps what fits; gives how many bytes it took, less than there are only when packets are to be taken
    /// first.
    std::size_t feed(std::span<const char> bytes) noexcept;
    std::optional<XidKey> next() noexcept;
    void clear() noexcept { size_ = 0; }

  private:
    void drop(std::size_t count) noexcept;
    std::array<unsigned char, 256> bytes_{};
    std::size_t size_ = 0;
};

/// The number of a button by its place, from 1 at the left, of a key as the box numbers it: the models
/// differ.
int xid_button(const XidIdentity& identity, int key) noexcept;

/// Buttons are numbered by their place, from 1 at the left.
class XidBox final : public ButtonBox {
  public:
    using Opener = XidLine::Opener;

    /// `clock` must outlive this. Throws as XidLine's constructor.
    XidBox(const std::string& port, const Opener& open, Clock& clock);

    ButtonBoxDescription description() const override;
    void begin() override;
    std::size_t poll(std::span<ButtonChange> into) noexcept override;
    bool lost() const noexcept override { return line_.lost(); }

  private:
    void flush() noexcept;
    void read_clocks();

    Clock* clock_;
    XidLine line_;
    XidParser parser_;
    BoxTimes times_;
    bool has_clock_ = false;
    SessionTime looked_;
};

} // namespace overt
