/// Addresses of sockets in the file system, of any length.
#pragma once

#include <filesystem>

#include <sys/socket.h>
#include <sys/un.h>

namespace overt {

/// A socket's file as the system takes it. Its name may have some hundred bytes only, so the folder is named
/// by a descriptor that stays open as long as this lives.
class SocketAddress {
  public:
    /// Throws InputError if the folder cannot be entered or the file's own name is too long:
    /// what one program can open every other one can reach.
    explicit SocketAddress(const std::filesystem::path& socket);
    ~SocketAddress();
    SocketAddress(const SocketAddress&) = delete;
    SocketAddress& operator=(const SocketAddress&) = delete;

    const sockaddr* address() const noexcept;
    socklen_t size() const noexcept { return sizeof address_; }

  private:
    int folder_ = -1;
    sockaddr_un address_{};
};

/// A socket that is connected to it, without waiting in reads and writes; -1 with errno's word why:
/// ECONNREFUSED or ENOENT if nobody serves it, EAGAIN if whoever does has too many waiting already.
int connect_to(const SocketAddress& address);

} // namespace overt
