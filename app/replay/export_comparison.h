/// Files of two sessions byte for byte: those in their folders, and all exports of both.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace overt {

struct FileDifference {
    std::string file; ///< as its folder has it, with "/"; of an export, with the format before it
    std::string what; ///< the line and both texts, or what is missing
};

struct FileComparison {
    int files = 0;
    std::uintmax_t bytes = 0;
    std::vector<FileDifference> differences; ///< by name
};

/// The meshes, maps, pictures and spoken answers in the folders of two sessions, but for those `left_out`.
/// EXR files of other bytes are the same if their pixels and all they say of them are: their dates differ.
FileComparison compare_session_files(const std::filesystem::path& recorded,
                                     const std::filesystem::path& replayed,
                                     const std::vector<std::string>& left_out = {});

/// Exports both sessions in every format, below `work`, and compares the files. `progress` is told of each
/// format. Throws RecordError and InputError as exports do.
FileComparison compare_exports(const std::filesystem::path& recorded, const std::filesystem::path& replayed,
                               const std::filesystem::path& work,
                               const std::function<void(int done, int all)>& progress);

} // namespace overt
