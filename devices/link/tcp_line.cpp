#include "devices/link/tcp_line.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include "devices/host/clocks.h"
#include "experiment/base/error.h"
#include "experiment/base/text_number.h"

namespace overt {
namespace {

/// Waits for a connection that is under way. Gives an errno, 0: it stands.
int wait_for_connection(int descriptor, const Clock& clock, SessionTime deadline) {
    for (;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(std::clamp(
            deadline - clock.now(), SessionDuration::zero(), SessionDuration(std::chrono::hours(1))));
        pollfd waiting{.fd = descriptor, .events = POLLOUT, .revents = {}};
        const int ready = ::poll(&waiting, 1, static_cast<int>(left.count()));
        if (ready == 0)
            return ETIMEDOUT;
        if (ready == -1 && errno == EINTR)
            continue;
        if (ready == -1)
            return errno;
        int error = 0;
        socklen_t size = sizeof error;
        return ::getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
    }
}

void set_option(int descriptor, int level, int option, int value) {
    // An option that the system refuses costs speed or the finding of a dead peer, and not the connection.
    static_cast<void>(::setsockopt(descriptor, level, option, &value, sizeof value));
}

void set_options(int descriptor) {
    set_option(descriptor, IPPROTO_TCP, TCP_NODELAY, 1);
    set_option(descriptor, SOL_SOCKET, SO_KEEPALIVE, 1);
    set_option(descriptor, IPPROTO_TCP, TCP_KEEPIDLE, 4);
    set_option(descriptor, IPPROTO_TCP, TCP_KEEPINTVL, 2);
    set_option(descriptor, IPPROTO_TCP, TCP_KEEPCNT, 3);
    set_option(descriptor, IPPROTO_TCP, TCP_USER_TIMEOUT, 10'000);
}

std::string remedy_for_connection(int error) {
    switch (error) {
    case ECONNREFUSED:
        return "nothing listens there: start its program on that machine and switch its server on, or name "
               "another address";
    case ETIMEDOUT:
    case EHOSTUNREACH:
    case ENETUNREACH:
        return "no answer: check the address, the network cable and the firewall of that machine";
    default:
        return "check the address and the network";
    }
}

Descriptor connect_to(const NetworkAddress& address, const std::string& device, const Clock& clock,
                      SessionTime deadline) {
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    wanted.ai_family = AF_UNSPEC;
    addrinfo* first = nullptr;
    const int fault =
        ::getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &wanted, &first);
    if (fault != 0)
        throw DeviceError(
            fmt::format("The {} cannot be reached: \"{}\" is no known host: {}; name its address.", device,
                        address.host, ::gai_strerror(fault)));
    const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> all(first, &::freeaddrinfo);
    int error = EHOSTUNREACH;
    for (const addrinfo* each = first; each; each = each->ai_next) {
        Descriptor opened(
            ::socket(each->ai_family, each->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, each->ai_protocol));
        if (opened.value() == -1 || ::connect(opened.value(), each->ai_addr, each->ai_addrlen) != 0)
            error = errno;
        else
            error = 0;
        if (error == EINPROGRESS)
            error = wait_for_connection(opened.value(), clock, deadline);
        if (error == 0) {
            set_options(opened.value());
            return opened;
        }
    }
    throw DeviceError(fmt::format("The {} at {} cannot be reached: {}; {}.", device, describe(address),
                                  std::strerror(error), remedy_for_connection(error)));
}

} // namespace

std::string describe(const NetworkAddress& address) {
    const bool is_ipv6 = address.host.find(':') != std::string::npos;
    return is_ipv6 ? fmt::format("[{}]:{}", address.host, address.port)
                   : fmt::format("{}:{}", address.host, address.port);
}

NetworkAddress parse_network_address(std::string_view text, const NetworkAddress& usual) {
    NetworkAddress address = usual;
    if (text.empty())
        return address;
    // More than one colon without brackets is an address of IPv6 alone.
    const bool is_bracketed = text.front() == '[';
    const std::size_t bracket = is_bracketed ? text.find(']') : 0;
    const std::size_t colon = bracket == std::string_view::npos ? bracket : text.find(':', bracket);
    const bool has_port = colon != std::string_view::npos &&
                          (is_bracketed || text.find(':', colon + 1) == std::string_view::npos);
    std::string_view host = has_port ? text.substr(0, colon) : text;
    if (is_bracketed && host.ends_with(']'))
        host = host.substr(1, host.size() - 2);
    if (!host.empty())
        address.host = host;
    if (has_port) {
        const std::string_view port = text.substr(colon + 1);
        address.port = number_in<std::uint16_t>(port).value_or(0);
        if (address.port == 0)
            throw InputError(fmt::format("\"{}\" is no address: \"{}\" is no port; write host or host:port, "
                                         "such as {}.",
                                         text, port, describe(usual)));
    }
    return address;
}

TcpLine::TcpLine(const NetworkAddress& address, const std::string& device, const Clock& clock,
                 SessionTime deadline)
    : DescriptorLine(describe(address), clock, connect_to(address, device, clock, deadline),
                     "the other end closed the connection") {}

std::string served_here(const NetworkAddress& usual, const std::string& program) {
    constexpr SessionDuration patience = std::chrono::milliseconds(200);
    SteadyClock clock;
    try {
        const TcpLine line(usual, program, clock, clock.now() + patience);
        return fmt::format("{} answers at {}", program, describe(usual));
    } catch (const Error&) {
        return fmt::format("{} does not answer at {}; on another computer it is found by [tracker] address",
                           program, describe(usual));
    }
}

} // namespace overt
