#include "experiment/base/partial_directory.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "experiment/base/error.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

/// Brings a whole file system's writes to the disk: the directory's files may have come from anywhere.
void sync_around(const fs::path& directory) {
    const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool synced = descriptor >= 0 && ::syncfs(descriptor) == 0;
    const int reason = errno;
    if (descriptor >= 0)
        ::close(descriptor);
    if (!synced)
        throw RecordError(fmt::format("{}: writing to disk failed: {}. Check its space.", directory.string(),
                                      std::strerror(reason)));
}

} // namespace

PartialDirectory::PartialDirectory(const fs::path& final_path) : final_path_(fs::absolute(final_path)) {
    if (!final_path_.has_filename())
        final_path_ = final_path_.parent_path(); // "out/" means "out"
    const fs::path parent = final_path_.parent_path();
    std::error_code error;
    fs::create_directories(parent, error);
    std::string name = (parent / fmt::format(".{}.partial-XXXXXX", final_path_.filename().string())).string();
    if (error || ::mkdtemp(name.data()) == nullptr)
        throw RecordError(fmt::format("{}: a directory cannot be made there: {}. Check the permissions.",
                                      parent.string(), error ? error.message() : std::strerror(errno)));
    path_ = name;
    // mkdtemp lets in its owner alone; the others get what the folder around it gives them.
    fs::permissions(path_, fs::status(parent).permissions() & fs::perms::all, error);
}

void PartialDirectory::publish() {
    if (!publish_if_free())
        throw RecordError(fmt::format("{}: was made meanwhile by somebody else, and is not overwritten.",
                                      final_path_.string()));
}

bool PartialDirectory::publish_if_free() {
    if (is_published())
        return true;
    sync_around(path_);
    std::error_code error;
    fs::rename(path_, final_path_, error);
    if (error == std::errc::directory_not_empty || error == std::errc::file_exists ||
        error == std::errc::not_a_directory)
        return false;
    if (error)
        throw RecordError(fmt::format("{}: cannot be renamed to {}: {}. Check the permissions.",
                                      path_.string(), final_path_.filename().string(), error.message()));
    path_ = final_path_;
    sync_around(path_.parent_path());
    return true;
}

void PartialDirectory::abandon() noexcept {
    if (path_.empty() || is_published())
        return;
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    path_.clear();
}

} // namespace overt
