#include "devices/link/serial_port.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

std::string remedy_for(int error) {
    switch (error) {
    case EACCES:
    case EPERM:
        return "add this account to the group that owns the port (on Debian: sudo adduser $USER dialout) and "
               "log in anew";
    case EBUSY:
    case EWOULDBLOCK:
        return "another program has the port open (another session, or ModemManager within the first seconds "
               "after plugging in): end it and try again";
    case ENOENT:
    case ENODEV:
    case ENXIO:
        return "check that the device is switched on and its USB cable plugged in, or name another port";
    default:
        return "plug the device out and in, or name another port";
    }
}

/// Closes what was opened if the constructor does not come to its end.
class Descriptor {
  public:
    explicit Descriptor(int value) : value_(value) {}
    ~Descriptor() {
        if (value_ >= 0)
            ::close(value_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int value() const { return value_; }
    int release() { return std::exchange(value_, -1); }

  private:
    int value_;
};

void make_raw(int descriptor, const std::string& path) {
    termios settings{};
    if (tcgetattr(descriptor, &settings) != 0)
        throw DeviceError(
            fmt::format("{} is not a serial port: {}; name another port.", path, std::strerror(errno)));
    cfmakeraw(&settings);
    settings.c_cflag |= static_cast<tcflag_t>(CLOCAL | CREAD);
    // Without HUPCL the box is not told that the line was hung up each time a program ends.
    settings.c_cflag &= ~static_cast<tcflag_t>(HUPCL | CRTSCTS | CSTOPB | PARENB);
    settings.c_cc[VMIN] = 0;
    settings.c_cc[VTIME] = 0;
    cfsetspeed(&settings, B115200);
    if (tcsetattr(descriptor, TCSANOW, &settings) != 0)
        throw DeviceError(fmt::format("{} cannot be set to raw bytes: {}; {}.", path, std::strerror(errno),
                                      remedy_for(errno)));
}

} // namespace

SerialPort::SerialPort(std::string path, const Clock& clock) : path_(std::move(path)), clock_(clock) {
    // Non-blocking: the open of a tty may otherwise wait for a carrier that never comes.
    Descriptor opened(::open(path_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (opened.value() < 0)
        throw DeviceError(
            fmt::format("{} cannot be opened: {}; {}.", path_, std::strerror(errno), remedy_for(errno)));
    // Two locks: programs that know nothing of flock are kept out by TIOCEXCL, and root, whom that does not
    // stop, is at least kept from a second session of ours by flock.
    if (flock(opened.value(), LOCK_EX | LOCK_NB) != 0)
        throw DeviceError(fmt::format("{} is in use: {}.", path_, remedy_for(EBUSY)));
    make_raw(opened.value(), path_);
    ioctl(opened.value(), TIOCEXCL);
    tcflush(opened.value(), TCIOFLUSH);
    descriptor_ = opened.release();
}

SerialPort::~SerialPort() {
    ioctl(descriptor_, TIOCNXCL);
    ::close(descriptor_);
}

void SerialPort::lose(int error) noexcept {
    if (!lost_)
        loss_error_ = error;
    lost_ = true;
}

std::string SerialPort::loss() const {
    if (!lost_)
        return {};
    return loss_error_ ? std::strerror(loss_error_) : "the device hung up";
}

bool SerialPort::wait_for(short events, SessionTime deadline) noexcept {
    while (!lost_) {
        const SessionDuration left = std::max(deadline - clock_.now(), SessionDuration::zero());
        const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
        const timespec time_left{static_cast<time_t>(seconds.count()),
                                 static_cast<long>((left - seconds).count())};
        pollfd waiting{descriptor_, events, 0};
        const int ready = ppoll(&waiting, 1, &time_left, nullptr);
        if (ready < 0 && errno != EINTR)
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

bool SerialPort::write(std::string_view bytes, SessionTime deadline) noexcept {
    while (!bytes.empty()) {
        if (!wait_for(POLLOUT, deadline))
            return false;
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written > 0)
            bytes.remove_prefix(static_cast<std::size_t>(written));
        else if (written < 0 && errno != EAGAIN && errno != EINTR)
            lose(errno);
    }
    return !lost_;
}

std::size_t SerialPort::read(std::span<char> into, SessionTime deadline) noexcept {
    while (!into.empty() && wait_for(POLLIN, deadline)) {
        const ssize_t count = ::read(descriptor_, into.data(), into.size());
        if (count > 0)
            return static_cast<std::size_t>(count);
        // A raw tty that has something to read and then gives nothing has been hung up.
        if (count == 0)
            lose(0);
        else if (errno != EAGAIN && errno != EINTR)
            lose(errno);
    }
    return 0;
}

TransportOpener serial_port_opener(const Clock& clock) {
    return [&clock](const std::string& port) { return std::make_unique<SerialPort>(port, clock); };
}

} // namespace overt
