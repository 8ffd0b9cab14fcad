/// A folder for one test.
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "experiment/base/scratch_folder.h"

namespace overt::test {

/// Made anew and removed with all that is in it.
class TemporaryFolder : public ScratchFolder {
  public:
    TemporaryFolder() : ScratchFolder("overt-test") {}

    /// Writes a file of that name, in folders that are made for it, and gives its path.
    std::filesystem::path file(const std::string& name, std::string_view content) const {
        std::filesystem::path file = path() / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream stream(file, std::ios::binary);
        stream.write(content.data(), static_cast<std::streamsize>(content.size()));
        if (!stream.flush())
            throw std::runtime_error("a test's file cannot be written");
        return file;
    }
};

} // namespace overt::test
