/// What lines over a descriptor of the system have in common: a serial port, a connection over the network.
#pragma once

#include <string>

#include "devices/link/byte_transport.h"
#include "experiment/ports/clock.h"

namespace overt {

/// A descriptor that is non-blocking and that is closed at the end; -1 is none.
class Descriptor {
  public:
    explicit Descriptor(int value = -1) noexcept : value_(value) {}
    ~Descriptor();
    Descriptor(Descriptor&& other) noexcept;
    Descriptor& operator=(Descriptor&& other) noexcept;
    int value() const noexcept { return value_; }

  private:
    int value_;
};

/// Reads and writes the bytes of a descriptor, with deadlines. See ByteTransport.
class DescriptorLine : public ByteTransport {
  public:
    const std::string& name() const noexcept override { return name_; }
    bool write(std::string_view bytes, SessionTime deadline) noexcept override;
    std::size_t read(std::span<char> into, SessionTime deadline) noexcept override;
    bool lost() const noexcept override { return lost_; }
    std::string loss() const override;

  protected:
    /// `closed`: what is said when the other end has ended the line without an error. `clock` must go by
    /// itself and outlive the line.
    DescriptorLine(std::string name, const Clock& clock, Descriptor descriptor, const char* closed);
    int descriptor() const noexcept { return descriptor_.value(); }

  private:
    bool wait_for(short events, SessionTime deadline) noexcept;
    void lose(int error) noexcept;

    std::string name_;
    const Clock& clock_;
    Descriptor descriptor_;
    const char* closed_;
    bool is_socket_;
    bool lost_ = false;
    int loss_error_ = 0; ///< errno, 0 where the other end closed it
};

} // namespace overt
