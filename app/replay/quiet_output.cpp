#include "app/replay/quiet_output.h"

#include <cstdio>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "experiment/base/error.h"

namespace overt {

QuietOutput::QuietOutput(const std::filesystem::path& file)
    : file_(::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600)),
      out_(::dup(STDOUT_FILENO)), err_(::dup(STDERR_FILENO)) {
    if (file_ < 0 || out_ < 0 || err_ < 0)
        throw RecordError(fmt::format("{}: cannot be written: make room, or set TMPDIR", file.string()));
    enter();
}

QuietOutput::~QuietOutput() {
    leave();
    for (const int descriptor : {file_, out_, err_})
        ::close(descriptor);
}

void QuietOutput::enter() const {
    std::fflush(nullptr);
    ::dup2(file_, STDOUT_FILENO);
    ::dup2(file_, STDERR_FILENO);
}

void QuietOutput::leave() const {
    std::fflush(nullptr);
    ::dup2(out_, STDOUT_FILENO);
    ::dup2(err_, STDERR_FILENO);
}

} // namespace overt
