/// A folder that lasts as long as its object.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

/// Made anew, and removed with all that is in it.
class ScratchFolder {
  public:
    /// `prefix`: how its name begins; `parent`: where it is made. Throws RecordError if there is no room or
    /// no right.
    explicit ScratchFolder(const std::string& prefix,
                           const std::filesystem::path& parent = std::filesystem::temp_directory_path()) {
        std::string name = (parent / (prefix + "-XXXXXX")).string();
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
