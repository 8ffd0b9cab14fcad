#include "experiment/base/folder_lock.h"

#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace overt {

FolderLock::FolderLock(const std::filesystem::path& folder, Patience patience)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (descriptor_ < 0)
        return;
    const int how = LOCK_EX | (patience == Patience::none ? LOCK_NB : 0);
    int result = -1;
    do
        result = ::flock(descriptor_, how);
    while (result != 0 && errno == EINTR);
    is_refused_ = result != 0 && errno == EWOULDBLOCK;
}

FolderLock::~FolderLock() {
    if (descriptor_ >= 0)
        ::close(descriptor_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), is_refused_(other.is_refused_) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(is_refused_, other.is_refused_);
    return *this;
}

} // namespace overt
