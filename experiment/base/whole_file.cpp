#include "experiment/base/whole_file.h"

#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

/// What a hidden name has between the file's own and the process that writes it.
std::string infix() {
    char host[65] = "";
    ::gethostname(host, sizeof host - 1);
    return fmt::format(".partial-{}-", host);
}

/// Of no other thread, process or machine that writes there now.
std::filesystem::path hidden_name(const std::filesystem::path& path) {
    static std::atomic<int> number{0};
    return path.parent_path() /
           fmt::format(".{}{}{}-{}", path.filename().string(), infix(), ::getpid(), number++);
}

/// The process of this machine that hid a file under this name; nothing if none did.
std::optional<::pid_t> writer_of(std::string_view name) {
    const std::string between = infix();
    const std::size_t at = name.rfind(between);
    if (!name.starts_with('.') || at == std::string_view::npos)
        return std::nullopt;
    ::pid_t writer = 0;
    const char* const end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + at + between.size(), end, writer);
    if (error != std::errc() || writer <= 0 || rest == end || *rest != '-')
        return std::nullopt;
    return writer;
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

int remove_abandoned_files(const std::filesystem::path& folder) {
    int removed = 0;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
        const std::optional<::pid_t> writer = writer_of(entry.path().filename().string());
        const bool is_over = writer && ::kill(*writer, 0) != 0 && errno == ESRCH;
        if (is_over && std::filesystem::remove(entry.path(), ignored))
            ++removed;
    }
    return removed;
}

} // namespace overt
