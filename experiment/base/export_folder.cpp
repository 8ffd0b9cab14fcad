#include "experiment/base/export_folder.h"

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

/// An existing directory is replaced only if nothing is lost by it.
const fs::path& unless_refused(const fs::path& directory, bool overwrite,
                               const std::function<bool(const std::string&)>& is_ours) {
    if (!fs::exists(directory) || (fs::is_directory(directory) && fs::is_empty(directory)))
        return directory;
    if (!overwrite || !fs::is_directory(directory))
        throw InputError(fmt::format(
            "{}: exists already. Name another folder, or replace it with --overwrite.", directory.string()));
    for (const auto& entry : fs::directory_iterator(directory))
        if (!is_ours(entry.path().filename().string()))
            throw InputError(
                fmt::format("{}: holds \"{}\", which no export has written, so it is not overwritten. "
                            "Name another folder.",
                            directory.string(), entry.path().filename().string()));
    return directory;
}

} // namespace

ExportFolder::ExportFolder(const fs::path& directory, bool overwrite,
                           const std::function<bool(const std::string&)>& is_ours)
    : partial_(unless_refused(directory, overwrite, is_ours)) {}

void ExportFolder::publish() {
    std::error_code error;
    fs::remove_all(partial_.final_path(), error);
    if (error)
        throw RecordError(fmt::format("{}: the earlier export cannot be removed: {}. Check the permissions.",
                                      partial_.final_path().string(), error.message()));
    partial_.publish();
}

} // namespace overt
