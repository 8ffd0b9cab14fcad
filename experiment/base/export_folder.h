/// The folder of an export: it appears whole, and replaces nothing but an earlier export.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "experiment/base/partial_directory.h"

namespace overt {

class ExportFolder {
  public:
    /// `is_ours` knows the names of files that an export of this kind writes. Throws InputError if the
    /// directory exists and is not empty, unless `overwrite` and everything in it is ours; RecordError if
    /// none can be made there.
    ExportFolder(const std::filesystem::path& directory, bool overwrite,
                 const std::function<bool(const std::string&)>& is_ours);

    /// Where the files are to be put.
    const std::filesystem::path& path() const { return partial_.path(); }

    /// Removes the earlier export and gives this one its name. No file may be open. Throws RecordError.
    void publish();

  private:
    PartialDirectory partial_;
};

} // namespace overt
