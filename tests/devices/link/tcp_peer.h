/// The far end of a connection over TCP: a server on this machine, at a port that the system chooses,
/// answered by a thread.
#pragma once

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "devices/link/tcp_line.h"

namespace overt::test {

/// Takes one connection at a time. What arrives is answered by `answer`; `stream`, if given, is asked each
/// millisecond for something to say without being asked. Both run on the peer's thread.
class TcpPeer {
  public:
    using Answer = std::function<std::string(std::string_view bytes, double now_s)>;
    using Stream = std::function<std::string(double now_s)>;

    explicit TcpPeer(Answer answer, Stream stream = {})
        : answer_(std::move(answer)), stream_(std::move(stream)), listener_(socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        if (listener_ < 0 || bind(listener_, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
            listen(listener_, 4) != 0 ||
            getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
            throw std::runtime_error("no server can be made on this machine");
        port_ = ntohs(address.sin_port);
        thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
    }
    ~TcpPeer() {
        thread_ = {};
        hang_up();
        close(listener_);
    }
    TcpPeer(const TcpPeer&) = delete;
    TcpPeer& operator=(const TcpPeer&) = delete;

    NetworkAddress address() const { return {"127.0.0.1", port_}; }

    /// Ends the connection that stands, as when the program at the other end is closed.
    void drop() { drop_ = true; }

    /// Says and answers nothing any more, and takes nothing.
    void stall(bool stalled) { stalled_ = stalled; }

  private:
    void hang_up() {
        if (connection_ >= 0)
            close(connection_);
        connection_ = -1;
    }

    void say(std::string_view text, const std::stop_token& stop) const {
        while (!text.empty() && !stop.stop_requested()) {
            const ssize_t written = send(connection_, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
            if (written > 0)
                text.remove_prefix(static_cast<std::size_t>(written));
            else if (errno == EAGAIN)
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            else
                return;
        }
    }

    void serve(const std::stop_token& stop) {
        const auto begun = std::chrono::steady_clock::now();
        while (!stop.stop_requested()) {
            if (drop_.exchange(false))
                hang_up();
            pollfd waiting[] = {{listener_, POLLIN, 0}, {connection_, POLLIN, 0}};
            poll(waiting, connection_ >= 0 ? 2 : 1, 1);
            if (connection_ < 0 && (waiting[0].revents & POLLIN) != 0)
                connection_ = accept(listener_, nullptr, nullptr);
            if (connection_ < 0 || stalled_)
                continue;
            const double now_s =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
            std::string said;
            char bytes[512];
            if ((waiting[1].revents & (POLLIN | POLLHUP)) != 0) {
                const ssize_t count = recv(connection_, bytes, sizeof bytes, MSG_DONTWAIT);
                if (count > 0)
                    said = answer_({bytes, static_cast<std::size_t>(count)}, now_s);
                else if (count == 0)
                    hang_up();
            }
            if (stream_)
                said += stream_(now_s);
            if (connection_ >= 0)
                say(said, stop);
        }
    }

    Answer answer_;
    Stream stream_;
    int listener_, connection_ = -1;
    std::uint16_t port_ = 0;
    std::atomic<bool> drop_{false}, stalled_{false};
    std::jthread thread_;
};

} // namespace overt::test
