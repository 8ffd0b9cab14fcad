/// A lock on a folder that ends with the process, however that ends.
#pragma once

#include <cstdint>
#include <filesystem>

namespace overt {

/// Held as long as this lives. It keeps out who asks for it, and nobody else. Where a file system knows no
/// locks, everybody has it.
class FolderLock {
  public:
    enum class Patience : std::uint8_t { none, as_long_as_it_takes };

    /// Nothing is locked.
    FolderLock() = default;
    /// A folder that is not there is not locked.
    FolderLock(const std::filesystem::path& folder, Patience patience);
    ~FolderLock();
    FolderLock(FolderLock&& other) noexcept;
    FolderLock& operator=(FolderLock&& other) noexcept;

    /// Another program, or another object of this, has it.
    bool is_refused() const { return is_refused_; }
    /// There was a folder to lock.
    bool has_folder() const { return descriptor_ >= 0; }

  private:
    int descriptor_ = -1;
    bool is_refused_ = false;
};

} // namespace overt
