#include "devices/link/serial_port.h"

#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/serial.h>
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
               "log in anew, or install the rule that comes with overt (sudo cp assets/udev/70-overt.rules "
               "/etc/udev/rules.d/, then sudo udevadm control --reload) and plug the device in anew";
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

/// The constant of termios for a speed; nothing for speeds that it does not know.
std::optional<speed_t> speed_of(int baud) {
    constexpr std::pair<int, speed_t> speeds[] = {{1200, B1200},     {2400, B2400},     {4800, B4800},
                                                  {9600, B9600},     {19200, B19200},   {38400, B38400},
                                                  {57600, B57600},   {115200, B115200}, {230400, B230400},
                                                  {460800, B460800}, {921600, B921600}};
    for (const auto& [number, constant] : speeds)
        if (number == baud)
            return constant;
    return std::nullopt;
}

void make_raw(int descriptor, const std::string& path, int baud) {
    const std::optional<speed_t> speed = speed_of(baud);
    if (!speed)
        throw DeviceError(fmt::format(
            "{} cannot be set to {} baud; name a usual speed between 1200 and 921600.", path, baud));
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
    cfsetspeed(&settings, *speed);
    if (tcsetattr(descriptor, TCSANOW, &settings) != 0)
        throw DeviceError(fmt::format("{} cannot be set to raw bytes: {}; {}.", path, std::strerror(errno),
                                      remedy_for(errno)));
}

/// A chip behind USB gathers bytes before it hands them on, 16 ms of them by default; the kernel's driver of
/// FTDI's chips does so for 1 ms where low latency is asked for, which any owner of the port may do. What has
/// no such thing, as a terminal or a port of the CDC class, refuses it without harm.
void ask_for_low_latency(int descriptor) {
    serial_struct state{};
    if (ioctl(descriptor, TIOCGSERIAL, &state) != 0 || (state.flags & ASYNC_LOW_LATENCY) != 0)
        return;
    state.flags |= ASYNC_LOW_LATENCY;
    ioctl(descriptor, TIOCSSERIAL, &state);
}

Descriptor open_serial_port(const std::string& path, int baud) {
    // Non-blocking: the open of a tty may otherwise wait for a carrier that never comes.
    Descriptor opened(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (opened.value() == -1)
        throw DeviceError(
            fmt::format("{} cannot be opened: {}; {}.", path, std::strerror(errno), remedy_for(errno)));
    // Two locks: programs that know nothing of flock are kept out by TIOCEXCL, and root, whom that does not
    // stop, is at least kept from a second session of ours by flock.
    if (flock(opened.value(), LOCK_EX | LOCK_NB) != 0)
        throw DeviceError(fmt::format("{} is in use: {}.", path, remedy_for(EBUSY)));
    make_raw(opened.value(), path, baud);
    ask_for_low_latency(opened.value());
    ioctl(opened.value(), TIOCEXCL);
    tcflush(opened.value(), TCIOFLUSH);
    return opened;
}

} // namespace

SerialPort::SerialPort(const std::string& path, const Clock& clock, int baud)
    : DescriptorLine(path, clock, open_serial_port(path, baud), "the device hung up") {}

SerialPort::~SerialPort() { ioctl(descriptor(), TIOCNXCL); }

TransportOpener serial_port_opener(const Clock& clock) {
    return [&clock](const std::string& port) { return std::make_unique<SerialPort>(port, clock); };
}

} // namespace overt
