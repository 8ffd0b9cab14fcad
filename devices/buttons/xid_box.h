/// Response boxes of Cedrus that speak XID over a serial line (RB-x30, RB-x40, Lumina, Riponda): the
/// language, and the box with its clock in milliseconds.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "devices/buttons/box_times.h"
#include "devices/link/byte_transport.h"
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

/// Which box it is.
struct XidIdentity {
    char product = '?'; ///< 0 Lumina, 2 RB, 5 Riponda …
    char model = '?';   ///< of RB: 1 530/540, 2 730/740, 3 830/840, 4 834/844
    char firmware = '?';
};

/// The number of a button by its place, from 1 at the left, of a key as the box numbers it: the models
/// differ.
int xid_button(const XidIdentity& identity, int key) noexcept;

/// Buttons are numbered by their place, from 1 at the left.
class XidBox final : public ButtonBox {
  public:
    /// Opens a port at a speed. Throws DeviceError.
    using Opener = std::function<std::unique_ptr<ByteTransport>(const std::string& port, int baud)>;

    /// Tries the speeds that such boxes can be switched to. `clock` must outlive this. Throws DeviceError if
    /// no XID box answers.
    XidBox(const std::string& port, const Opener& open, Clock& clock);

    ButtonBoxDescription description() const override;
    void begin() override;
    std::size_t poll(std::span<ButtonChange> into) noexcept override;
    bool lost() const noexcept override { return line_->lost(); }

  private:
    bool find(const std::string& port, const Opener& open);
    void send(std::string_view bytes);
    std::string ask(std::string_view command, std::size_t bytes, SessionDuration patience);
    void flush() noexcept;
    void read_clocks();

    Clock* clock_;
    std::unique_ptr<ByteTransport> line_;
    int baud_ = 0;
    XidIdentity identity_;
    XidParser parser_;
    BoxTimes times_;
    bool has_clock_ = false;
    SessionTime looked_;
};

} // namespace overt
