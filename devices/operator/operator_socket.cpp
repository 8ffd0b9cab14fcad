#include "devices/operator/operator_socket.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

/// What stands beside it is the folder's descriptor, whose number may have ten digits at whoever connects.
constexpr std::size_t longest_name = sizeof(sockaddr_un::sun_path) - sizeof "/proc/self/fd/2147483647/";

} // namespace

SocketAddress::SocketAddress(const std::filesystem::path& socket) {
    const std::string own_name = socket.filename().string();
    if (own_name.empty() || own_name.size() > longest_name)
        throw InputError(
            fmt::format("{}: no socket can be called so: give it a shorter name, of {} bytes at most",
                        socket.string(), longest_name));
    const std::filesystem::path folder = socket.has_parent_path() ? socket.parent_path() : ".";
    folder_ = ::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
    if (folder_ == -1)
        throw InputError(fmt::format("{}: no socket can be there: {}: name a folder that exists",
                                     socket.string(), std::strerror(errno)));
    const std::string name = fmt::format("/proc/self/fd/{}/{}", folder_, own_name);
    address_.sun_family = AF_UNIX;
    name.copy(address_.sun_path, name.size()); // what is behind it is 0
}

SocketAddress::~SocketAddress() { ::close(folder_); }

const sockaddr* SocketAddress::address() const noexcept {
    return static_cast<const sockaddr*>(static_cast<const void*>(&address_));
}

int connect_to(const SocketAddress& address) {
    const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (socket == -1)
        throw DeviceError(fmt::format("no socket can be opened: {}", std::strerror(errno)));
    if (::connect(socket, address.address(), address.size()) == 0)
        return socket;
    const int why = errno;
    ::close(socket);
    errno = why;
    return -1;
}

} // namespace overt
