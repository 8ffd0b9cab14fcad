/// A folder that lasts as long as its object.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

/// Made anew under the system's temporary folder, and removed with all that is in it.
class ScratchFolder {
  public:
    /// `prefix`: how its name begins. Throws RecordError if there is no room or no right.
    explicit ScratchFolder(const std::string& prefix) {
        std::string name = (std::filesystem::temp_directory_path() / (prefix + "-XXXXXX")).string();
        if (!::mkdtemp(name.data()))
            throw RecordError(fmt::format("{}: a temporary folder cannot be made there: set TMPDIR", name));
        path_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

} // namespace overt
