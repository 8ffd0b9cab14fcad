#include "devices/operator/operator_client.h"

#include <array>
#include <cerrno>
#include <thread>

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "devices/operator/operator_socket.h"
#include "experiment/base/error.h"

namespace overt {

namespace {

constexpr std::chrono::seconds longest_greeting{5};
constexpr std::size_t most_events = 1000, most_gaze = 4096;

bool send_all(int socket, std::string_view text) {
    while (!text.empty()) {
        const ssize_t sent = ::send(socket, text.data(), text.size(), MSG_NOSIGNAL);
        if (sent == -1 && (errno == EAGAIN || errno == EINTR)) {
            pollfd wait{.fd = socket, .events = POLLOUT, .revents = {}};
            if (::poll(&wait, 1, 1000) == 0)
                return false;
            continue;
        }
        if (sent == -1)
            return false;
        text.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
}

} // namespace

OperatorClient::OperatorClient(const std::filesystem::path& socket) {
    const SocketAddress address(socket);
    socket_ = connect_to(address);
    if (socket_ == -1)
        throw InputError(fmt::format("{}: no session serves this socket: begin it with overt run … "
                                     "--operator-socket, and name its folder here",
                                     socket.string()));
    heard_ = std::chrono::steady_clock::now();
    try {
        const auto latest = heard_ + longest_greeting;
        send_all(socket_, line_of_greeting());
        while (!has_facts_ && !is_gone_ && std::chrono::steady_clock::now() < latest)
            read(std::chrono::milliseconds(50));
        if (!has_facts_)
            throw DeviceError(fmt::format("{}: the session does not answer", socket.string()));
    } catch (...) {
        ::close(socket_);
        throw;
    }
}

OperatorClient::~OperatorClient() { ::close(socket_); }

bool OperatorClient::read(std::chrono::milliseconds wait) {
    // A socket whose other end is gone is always ready: whoever reads again and again would never rest.
    if (is_gone_) {
        std::this_thread::sleep_for(wait);
        return false;
    }
    pollfd waits{.fd = socket_, .events = POLLIN, .revents = {}};
    ::poll(&waits, 1, static_cast<int>(wait.count()));
    std::array<char, 16384> bytes{};
    for (;;) {
        const ssize_t count = ::recv(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT);
        if (count == 0 || (count == -1 && errno != EAGAIN && errno != EINTR))
            is_gone_ = true;
        if (count <= 0)
            break;
        heard_ = std::chrono::steady_clock::now();
        received_.append(bytes.data(), static_cast<std::size_t>(count));
        std::size_t begin = 0;
        for (std::size_t end = 0; (end = received_.find('\n', begin)) != std::string::npos; begin = end + 1)
            understand(std::string_view(received_).substr(begin, end - begin));
        received_.erase(0, begin);
        if (received_.size() > longest_camera_line)
            throw DeviceError(
                "the session sent a line without an end: this is no operator's socket of overt");
    }
    return !is_gone_ && !view_.is_over;
}

void OperatorClient::understand(std::string_view line) {
    ViewLine read = read_view_line(line);
    if (read.version != 0 && read.version != view_version)
        throw InputError(fmt::format("the session speaks version {} of the operator's language, this program "
                                     "version {}: use the overt that the session was begun with",
                                     read.version, view_version));
    if (read.facts) {
        facts_ = std::move(*read.facts);
        has_facts_ = true;
    }
    if (read.event) {
        events_.push_back(std::move(*read.event));
        if (events_.size() > most_events)
            events_.pop_front();
    }
    if (read.view)
        view_ = std::move(*read.view);
    if (read.camera)
        camera_ = std::move(read.camera);
    gaze_.insert(gaze_.end(), read.gaze.begin(), read.gaze.end());
    while (gaze_.size() > most_gaze)
        gaze_.pop_front();
}

std::chrono::milliseconds OperatorClient::silence() const {
    return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - heard_);
}

bool OperatorClient::send(const OperatorCommand& command) {
    is_gone_ = is_gone_ || !send_all(socket_, line_of(command));
    return !is_gone_;
}

bool is_served(const std::filesystem::path& socket) {
    const int connected = connect_to(SocketAddress(socket));
    if (connected != -1)
        ::close(connected);
    // A queue that is full is somebody's.
    return connected != -1 || errno == EAGAIN;
}

} // namespace overt
