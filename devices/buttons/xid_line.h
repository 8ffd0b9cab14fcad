/// The line to a device of Cedrus that speaks XID: found at its speed, asked who it is. Bytes go out as
/// its firmware takes them.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "devices/link/byte_transport.h"
#include "experiment/ports/clock.h"

namespace overt {

/// Which device it is.
struct XidIdentity {
    char product = '?'; ///< 0 Lumina, 2 RB, 4 c-pod, 5 Riponda, S StimTracker …
    char model = '?';   ///< of RB: 1 530/540, 2 730/740, 3 830/840, 4 834/844
    char firmware = '?';
};

class XidLine {
  public:
    /// Opens a port at a speed. Throws DeviceError.
    using Opener = std::function<std::unique_ptr<ByteTransport>(const std::string& port, int baud)>;

    /// Tries the speeds that such devices can be switched to. `clock` must outlive this. Throws DeviceError
    /// if none answers that speaks XID.
    XidLine(const std::string& port, const Opener& open, Clock& clock);

    const XidIdentity& identity() const noexcept { return identity_; }
    int baud() const noexcept { return baud_; }
    std::string name() const { return line_->name(); }
    bool lost() const noexcept { return line_->lost(); }
    std::string loss() const { return line_->loss(); }

    /// False: it does not take them.
    bool try_send(std::string_view bytes) noexcept;
    /// The same; throws DeviceError.
    void send(std::string_view bytes);
    /// What comes within `patience`, so many bytes at most; less if it does not answer.
    std::string ask(std::string_view command, std::size_t bytes, SessionDuration patience);
    std::size_t read(std::span<char> into, SessionTime deadline) noexcept {
        return line_->read(into, deadline);
    }
    /// Reads away what is waiting.
    void flush() noexcept;

  private:
    bool find(const std::string& port, const Opener& open);

    Clock* clock_;
    std::unique_ptr<ByteTransport> line_;
    int baud_ = 0;
    XidIdentity identity_;
};

/// The address, or without one the first port behind a chip that Cedrus uses, or the first such chip that has
/// no port. Throws DeviceError if there is none.
std::string xid_port(const std::string& address);

} // namespace overt
