#include "devices/triggers/parallel_trigger.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/ppdev.h>
#include <sys/ioctl.h>

#include "devices/triggers/marker_device.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

std::string port_remedy(int error) {
    switch (error) {
    case EACCES:
    case EPERM:
        return "add this account to the group that owns it (on Debian: sudo adduser $USER lp) and log in "
               "anew";
    case ENOENT:
    case ENODEV:
    case ENXIO:
        return "see that there is such a port, and load its driver (sudo modprobe ppdev)";
    case EBUSY:
    case EAGAIN:
        return "another program or the printer's driver has it: end that (sudo rmmod lp)";
    default:
        return "name another port";
    }
}

[[noreturn]] void refuse(const std::string& path, const char* what, int error) {
    throw DeviceError(fmt::format("The parallel port {} {}: {}; {}.", path, what, std::strerror(error),
                                  port_remedy(error)));
}

} // namespace

ParallelTrigger::ParallelTrigger(const std::string& path)
    : name_(fmt::format("parallel port {}", path)), port_(::open(path.c_str(), O_RDWR | O_CLOEXEC)) {
    if (port_.value() == -1)
        refuse(path, "cannot be opened", errno);
    // Not shared with drivers of printers, which would take it in between.
    if (::ioctl(port_.value(), PPEXCL) != 0 || ::ioctl(port_.value(), PPCLAIM) != 0)
        refuse(path, "cannot be had", errno);
    int direction = 0; // outward
    if (::ioctl(port_.value(), PPDATADIR, &direction) != 0 || !write(0)) {
        const int error = errno;
        ::ioctl(port_.value(), PPRELEASE);
        refuse(path, "cannot be written to", error);
    }
}

ParallelTrigger::~ParallelTrigger() {
    rest();
    ::ioctl(port_.value(), PPRELEASE);
}

bool ParallelTrigger::write(std::uint8_t byte) noexcept {
    unsigned char data = byte;
    if (::ioctl(port_.value(), PPWDATA, &data) == 0)
        return true;
    error_ = errno;
    return false;
}

std::string ParallelTrigger::fault() const { return error_ ? std::strerror(error_) : ""; }

template <> MarkerDevice marker_device_of<kind_called<MarkerOutputKind>("parallel")>() {
    return {.open = [](const MarkerParts& parts) -> std::unique_ptr<MarkerOutput> {
        return std::make_unique<ParallelTrigger>(parts.settings.address.empty() ? "/dev/parport0"
                                                                                : parts.settings.address);
    }};
}

} // namespace overt
