#include "app/cli/file_set.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

std::filesystem::path hidden_name(const std::filesystem::path& path) {
    return path.parent_path() / fmt::format(".{}.partial-{}", path.filename().string(), ::getpid());
}

[[noreturn]] void refuse(const std::filesystem::path& path, int reason) {
    throw RecordError(fmt::format("{}: cannot be written: {}. Check space and permissions.", path.string(),
                                  std::strerror(reason)));
}

void write_to_disk(const std::filesystem::path& path, const std::string& text) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor < 0)
        refuse(path, errno);
    int reason = 0;
    for (std::size_t done = 0; done < text.size() && reason == 0;) {
        const ssize_t count = ::write(descriptor, text.data() + done, text.size() - done);
        if (count > 0)
            done += static_cast<std::size_t>(count);
        else if (errno != EINTR)
            reason = errno;
    }
    if (reason == 0 && ::fsync(descriptor) != 0)
        reason = errno;
    ::close(descriptor);
    if (reason != 0)
        refuse(path, reason);
}

} // namespace

void check_can_write(const std::vector<TextFile>& files, bool force) {
    std::error_code ignored;
    for (const TextFile& file : files) {
        const std::filesystem::path folder = std::filesystem::absolute(file.path).parent_path();
        if (!std::filesystem::is_directory(folder, ignored))
            throw InputError(fmt::format("{}: there is no folder {}", file.path.string(), folder.string()));
        if (std::filesystem::is_directory(file.path, ignored))
            throw InputError(fmt::format("{}: there is a folder of that name", file.path.string()));
        if (!force && std::filesystem::exists(file.path, ignored))
            throw InputError(fmt::format("{}: there already; --force replaces it, or give another --out",
                                         file.path.string()));
    }
}

void write_file_set(const std::vector<TextFile>& files, bool force) {
    check_can_write(files, force);
    std::size_t written = 0;
    try {
        for (; written < files.size(); ++written)
            write_to_disk(hidden_name(files[written].path), files[written].text);
        for (const TextFile& file : files)
            std::filesystem::rename(hidden_name(file.path), file.path);
    } catch (const std::exception& error) {
        std::error_code ignored;
        for (const TextFile& file : files)
            std::filesystem::remove(hidden_name(file.path), ignored);
        throw RecordError(error.what());
    }
}

} // namespace overt
