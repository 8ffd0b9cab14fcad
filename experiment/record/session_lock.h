/// One writer to a session, or to a dataset.
#pragma once

#include <filesystem>

#include "experiment/base/folder_lock.h"

namespace overt {

/// Keeps others from writing to the same session: a lock on its directory that ends with the process.
class SessionLock {
  public:
    /// Throws RecordError if another program holds it.
    explicit SessionLock(const std::filesystem::path& directory);

  private:
    FolderLock lock_;
};

} // namespace overt
