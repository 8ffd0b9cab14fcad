#include "app/cli/file_set.h"

#include <cstring>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/hidden_name.h"
#include "experiment/base/whole_file.h"

namespace overt {

namespace {

std::filesystem::path hidden_name(const std::filesystem::path& path) {
    return path.parent_path() / fmt::format(".{}{}0", path.filename().string(), hidden_infix());
}

void write_hidden(const TextFile& file) {
    if (const int reason = write_through(hidden_name(file.path), std::as_bytes(std::span(file.text)));
        reason != 0)
        throw RecordError(fmt::format("{}: cannot be written: {}. Check space and permissions.",
                                      hidden_name(file.path).string(), std::strerror(reason)));
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
            throw InputError(fmt::format("{}: there already; --overwrite replaces it, or give another --out",
                                         file.path.string()));
    }
}

void write_file_set(const std::vector<TextFile>& files, bool force) {
    check_can_write(files, force);
    for (const TextFile& file : files)
        remove_abandoned_files(std::filesystem::absolute(file.path).parent_path());
    std::size_t written = 0;
    try {
        for (; written < files.size(); ++written)
            write_hidden(files[written]);
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
