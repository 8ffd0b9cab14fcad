/// A line over TCP to a device, or to the program that serves one, on this machine or another.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "devices/link/descriptor_line.h"

namespace overt {

/// Where a server listens.
struct NetworkAddress {
    std::string host; ///< a name or an address, IPv4 or IPv6
    std::uint16_t port = 0;
};

/// "host:port" as the experimenter writes it.
std::string describe(const NetworkAddress& address);

/// What an experimenter wrote: "host", "host:port", "[IPv6]:port"; empty: `usual`. What is left out is as
/// `usual` has it. Throws InputError for a port that is none.
NetworkAddress parse_network_address(std::string_view text, const NetworkAddress& usual);

/// A connection. Bytes go off at once instead of waiting for more (TCP_NODELAY). A connection whose other end
/// vanished without a word is found dead by the system within about ten seconds (keepalive).
class TcpLine final : public DescriptorLine {
  public:
    /// Connects by the deadline; the look-up of a host's name is the system's and may take as long as that
    /// takes. `device`: what answers there, as it stands in messages. Throws DeviceError that names device,
    /// address and remedy. `clock` must go by itself and outlive the line.
    TcpLine(const NetworkAddress& address, const std::string& device, const Clock& clock,
            SessionTime deadline);
};

/// Whether a program answers at a tracker's usual address on this computer, in a sentence. Elsewhere nobody
/// looks: that would need an address.
std::string served_here(const NetworkAddress& usual, const std::string& program);

} // namespace overt
