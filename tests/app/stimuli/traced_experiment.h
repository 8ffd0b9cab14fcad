/// A path-traced experiment of few and small frames, and what `overt bake` leaves of it on the disk.
#pragma once

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiment/pictures/picture_file.h"
#include "tests/app/small_experiment.h"

namespace overt::test {

/// Path traced, of few and small frames.
inline std::string traced_protocol() {
    std::string text = with(small_protocol, "[bake]\nquality = \"live\"\n", "");
    text = with(text, "width_px = 128\nheight_px = 128\n", "width_px = 40\nheight_px = 48\n");
    return with(text, "frame_count = 31\nframe_rate_hz = 30\n", "frame_count = 7\nframe_rate_hz = 6\n");
}
inline constexpr int poses = 3; ///< of a period of seven frames: in front, and one to each side

inline std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    if (!std::filesystem::exists(folder))
        return files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file())
            files.push_back(entry.path().lexically_relative(folder));
    }
    std::sort(files.begin(), files.end());
    return files;
}

inline int whole_files_below(const std::filesystem::path& folder) {
    const auto files = files_below(folder);
    return static_cast<int>(std::count_if(files.begin(), files.end(), [](const std::filesystem::path& file) {
        return file.filename().string().front() != '.';
    }));
}

/// All channels of a picture as floats.
inline std::vector<float> values_in(const std::filesystem::path& file) {
    PictureFile picture(file, "picture");
    const PictureHeader& header = picture.header();
    std::vector<float> values(static_cast<std::size_t>(header.size_px.x * header.size_px.y) *
                              header.channels.size());
    picture.read(header.channel_count(), PixelType::float32, values.data());
    return values;
}

inline PictureHeader header_of(const std::filesystem::path& file) {
    return PictureFile(file, "picture").header();
}

/// Whether two folders have the same files with the same pictures.
inline bool same_pictures(const std::filesystem::path& a, const std::filesystem::path& b) {
    const auto files = files_below(a);
    if (files != files_below(b))
        return false;
    return std::all_of(files.begin(), files.end(), [&](const std::filesystem::path& file) {
        return values_in(a / file) == values_in(b / file);
    });
}

inline ProgramRun bake(const SmallExperiment& experiment, std::vector<std::string> more,
                       const std::filesystem::path& cache = {}) {
    std::vector<std::string> arguments{"bake", experiment.protocol().string(), "--context", "osmesa"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_overt(arguments, {"OVERT_CACHE=" + (cache.empty() ? experiment.cache() : cache).string()});
}

} // namespace overt::test
