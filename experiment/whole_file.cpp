#include "experiment/whole_file.h"

#include <atomic>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "experiment/error.h"

namespace overt {

namespace {

/// Of no other thread, process or machine that writes there now.
std::filesystem::path hidden_name(const std::filesystem::path& path) {
    static std::atomic<int> number{0};
    char host[65] = "";
    ::gethostname(host, sizeof host - 1);
    return path.parent_path() /
           fmt::format(".{}.partial-{}-{}-{}", path.filename().string(), host, ::getpid(), number++);
}

/// errno of what went wrong, or 0.
int write_all(int file, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(file, bytes.data(), bytes.size());
        if (count > 0)
            bytes = bytes.subspan(static_cast<std::size_t>(count));
        else if (count == 0 || errno != EINTR)
            return count == 0 ? ENOSPC : errno;
    }
    return ::fsync(file) == 0 ? 0 : errno;
}

} // namespace

void write_whole_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    const std::filesystem::path hidden = hidden_name(path);
    const int file = ::open(hidden.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    int reason = errno;
    if (file >= 0) {
        reason = write_all(file, bytes);
        if (::close(file) != 0 && reason == 0)
            reason = errno;
        if (reason == 0 && ::rename(hidden.c_str(), path.c_str()) != 0)
            reason = errno;
        if (reason == 0)
            return;
        ::unlink(hidden.c_str());
    }
    throw RecordError(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(reason)));
}

} // namespace overt
