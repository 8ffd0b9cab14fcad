#include "devices/link/descriptor_line.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

namespace overt {

Descriptor::~Descriptor() {
    if (value_ != -1)
        ::close(value_);
}

Descriptor::Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
}

DescriptorLine::DescriptorLine(std::string name, const Clock& clock, Descriptor descriptor,
                               const char* closed)
    : name_(std::move(name)), clock_(clock), descriptor_(std::move(descriptor)), closed_(closed) {
    struct stat kind {};
    is_socket_ = ::fstat(descriptor_.value(), &kind) == 0 && S_ISSOCK(kind.st_mode);
}

void DescriptorLine::lose(int error) noexcept {
    if (!lost_)
        loss_error_ = error;
    lost_ = true;
}

std::string DescriptorLine::loss() const {
    if (!lost_)
        return {};
    return loss_error_ ? std::strerror(loss_error_) : closed_;
}

bool DescriptorLine::wait_for(short events, SessionTime deadline) noexcept {
    while (!lost_) {
        const SessionDuration left = std::max(deadline - clock_.now(), SessionDuration::zero());
        const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
        const timespec time_left{static_cast<time_t>(seconds.count()),
                                 static_cast<long>((left - seconds).count())};
        pollfd waiting{.fd = descriptor(), .events = events, .revents = {}};
        const int ready = ppoll(&waiting, 1, &time_left, nullptr);
        if (ready == -1 && errno != EINTR)
            lose(errno);
        // What arrived before the hang-up is still there to be read, so POLLIN goes first.
        if (ready > 0 && (waiting.revents & events) != 0)
            return true;
        if (ready > 0 && (waiting.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0)
            lose(0);
        if (ready == 0)
            return false;
    }
    return false;
}

bool DescriptorLine::write(std::string_view bytes, SessionTime deadline) noexcept {
    while (!bytes.empty()) {
        if (!wait_for(POLLOUT, deadline))
            return false;
        // A socket whose other end is gone would end the program by a signal.
        const ssize_t written = is_socket_ ? ::send(descriptor(), bytes.data(), bytes.size(), MSG_NOSIGNAL)
                                           : ::write(descriptor(), bytes.data(), bytes.size());
        if (written > 0)
            bytes.remove_prefix(static_cast<std::size_t>(written));
        else if (written == -1 && errno != EAGAIN && errno != EINTR)
            lose(errno);
    }
    return !lost_;
}

std::size_t DescriptorLine::read(std::span<char> into, SessionTime deadline) noexcept {
    while (!into.empty() && wait_for(POLLIN, deadline)) {
        const ssize_t count = ::read(descriptor(), into.data(), into.size());
        if (count > 0)
            return static_cast<std::size_t>(count);
        // What has something to read and then gives nothing has been ended by the other side.
        if (count == 0)
            lose(0);
        else if (errno != EAGAIN && errno != EINTR)
            lose(errno);
    }
    return 0;
}

} // namespace overt
