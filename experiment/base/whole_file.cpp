#include "experiment/base/whole_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "experiment/base/error.h"
#include "experiment/base/hidden_name.h"

namespace overt {

namespace {

/// Of no other thread, process or machine that writes there now.
std::filesystem::path hidden_name(const std::filesystem::path& path) {
    static std::atomic<int> number{0};
    return path.parent_path() / fmt::format(".{}{}{}", path.filename().string(), hidden_infix(), number++);
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

std::optional<std::string> read_whole_file(const std::filesystem::path& path, std::size_t most_bytes,
                                           int& error) {
    constexpr std::size_t piece_bytes = 1 << 16;
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    error = file < 0 ? errno : 0;
    std::string text;
    while (error == 0 && text.size() <= most_bytes) {
        const std::size_t size = text.size();
        text.resize(size + piece_bytes);
        const ssize_t count = ::read(file, text.data() + size, piece_bytes);
        error = count < 0 && errno != EINTR ? errno : 0;
        text.resize(size + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
        if (count == 0)
            break;
    }
    if (file >= 0)
        ::close(file);
    if (error == 0 && text.size() > most_bytes)
        error = EFBIG;
    return error == 0 ? std::optional(std::move(text)) : std::nullopt;
}

std::string read_whole_file(const std::filesystem::path& path, std::size_t most_bytes) {
    int error = 0;
    std::optional<std::string> text = read_whole_file(path, most_bytes, error);
    if (!text)
        throw InputError(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(error)));
    return *std::move(text);
}

int write_through(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0)
        return errno;
    const int error = write_all(file, bytes);
    return ::close(file) != 0 && error == 0 ? errno : error;
}

int replace_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    const std::filesystem::path hidden = hidden_name(path);
    int error = write_through(hidden, bytes);
    if (error == 0 && ::rename(hidden.c_str(), path.c_str()) != 0)
        error = errno;
    if (error != 0)
        ::unlink(hidden.c_str());
    return error;
}

void write_whole_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    if (const int error = replace_file(path, bytes); error != 0)
        throw RecordError(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(error)));
}

void write_whole_file(const std::filesystem::path& path, std::string_view text, std::string_view remedy) {
    if (const int error = replace_file(path, std::as_bytes(std::span(text))); error != 0)
        throw RecordError(
            fmt::format("{}: cannot be written: {}{}", path.string(), std::strerror(error), remedy));
}

void write_to(const std::filesystem::path& path, std::string_view text) {
    std::FILE* const stream = std::fopen(path.c_str(), "wbe");
    const bool is_written = stream && std::fwrite(text.data(), 1, text.size(), stream) == text.size();
    if (!stream || std::fclose(stream) != 0 || !is_written)
        throw RecordError(fmt::format("{}: cannot be written", path.string()));
}

int remove_abandoned_files(const std::filesystem::path& folder) {
    int removed = 0;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
        if (!entry.is_directory(ignored) && is_abandoned_name(entry.path().filename().string()) &&
            std::filesystem::remove(entry.path(), ignored))
            ++removed;
    }
    return removed;
}

} // namespace overt
