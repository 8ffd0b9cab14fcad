#include "experiment/base/partial_directory.h"

#include <cerrno>
#include <cstring>
#include <random>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "experiment/base/error.h"
#include "experiment/base/hidden_name.h"

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

/// Makes a folder of a name that is free, in place of the six X at the end of `name`; else errno says why
/// not. Others may do in it what they may in the folder around it, as far as the user's umask lets them; its
/// group is inherited where the folder's is.
bool make_folder(std::string& name, const fs::path& parent) {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    constexpr int most_tries = 1000;
    std::error_code error;
    const auto of_parent = static_cast<mode_t>(fs::status(parent, error).permissions() & fs::perms::all);
    std::random_device random;
    for (int i = 0; i < most_tries; ++i) {
        for (std::size_t at = name.size() - 6; at < name.size(); ++at)
            name[at] = letters[random() % letters.size()];
        if (::mkdir(name.c_str(), (error ? 0777 : of_parent) | 0700) == 0)
            return true;
        if (errno != EEXIST)
            return false;
    }
    return false;
}

} // namespace

PartialDirectory::PartialDirectory(const fs::path& final_path) : final_path_(fs::absolute(final_path)) {
    if (!final_path_.has_filename())
        final_path_ = final_path_.parent_path(); // "out/" means "out"
    const fs::path parent = final_path_.parent_path();
    std::error_code error;
    fs::create_directories(parent, error);
    remove_abandoned_folders(final_path_);
    std::string name =
        (parent / fmt::format(".{}{}XXXXXX", final_path_.filename().string(), hidden_infix())).string();
    if (error || !make_folder(name, parent))
        throw RecordError(fmt::format("{}: a directory cannot be made there: {}. Check the permissions.",
                                      parent.string(), error ? error.message() : std::strerror(errno)));
    path_ = name;
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
