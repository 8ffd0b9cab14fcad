#include "experiment/report/surface_files.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/parallel.h"
#include "experiment/base/whole_file.h"
#include "experiment/report/map_names.h"
#include "experiment/surface/colour_scale.h"
#include "experiment/surface/coloured_mesh_file.h"

namespace overt {
namespace {

/// One file to be written.
struct SurfaceFile {
    std::string name, title, unit, kind;
    const StudySculpture* sculpture;
    const std::vector<float>* values;
    ColourMap colours;
    double low, high;
};

std::vector<std::array<std::uint8_t, 3>> colours_of(const SurfaceFile& file) {
    const ColourTable& table = colour_table(file.colours);
    std::vector<std::array<std::uint8_t, 3>> colours;
    colours.reserve(file.values->size());
    for (std::size_t v = 0; v < file.values->size(); ++v) {
        const std::vector<float>& visible = file.sculpture->seconds_visible;
        if (v < visible.size() && visible[v] <= 0.0f) {
            colours.push_back(never_visible);
            continue;
        }
        const double share = ((*file.values)[v] - file.low) / (file.high - file.low);
        colours.push_back(table[static_cast<std::size_t>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)))]);
    }
    return colours;
}

std::vector<SurfaceFile> files_of(const StudyResults& results) {
    std::vector<SurfaceFile> files;
    double most = 0.0, largest = 0.0;
    for (const StudyMap& map : results.maps) {
        if (map.weighting == MapWeighting::duration)
            most = std::max(most, map.peak);
    }
    for (const DifferenceMap& map : results.differences) {
        for (const float value : map.difference)
            largest = std::max(largest, std::abs(static_cast<double>(value)));
    }
    FileNames names;
    const auto add = [&](SurfaceFile file) {
        const bool fits = file.sculpture->mesh && !file.sculpture->mesh->triangles.empty() &&
                          file.values->size() == file.sculpture->mesh->positions.size();
        if (!fits)
            return;
        file.name = names.of(file.name);
        files.push_back(std::move(file));
    };
    for (const StudyMap& map : results.maps) {
        const StudySculpture& sculpture = results.sculptures[static_cast<std::size_t>(map.sculpture)];
        if (map.weighting != MapWeighting::duration || map.density.empty())
            continue;
        const std::vector<StudyKey>& keys = results.groups[static_cast<std::size_t>(map.group)].keys;
        const std::string words = words_of_keys(keys);
        add({fmt::format("map_{}_{}", sculpture.id, words), fmt::format("{}: {}", sculpture.title, words),
             "ms of fixation per mm^2 and trial", "map", &sculpture, &map.density, ColourMap::viridis, 0.0,
             most > 0.0 ? most : 1.0});
    }
    for (const StudySculpture& sculpture : results.sculptures) {
        const auto highest = [](const std::vector<float>& values) {
            const double top = values.empty() ? 0.0 : *std::ranges::max_element(values);
            return top > 0.0 ? top : 1.0;
        };
        add({fmt::format("exposure_{}", sculpture.id), fmt::format("{}: exposure", sculpture.title),
             "share of the exposure per mm^2", "exposure", &sculpture, &sculpture.exposure_density,
             ColourMap::viridis, 0.0, highest(sculpture.exposure_density)});
        add({fmt::format("visible_{}", sculpture.id), fmt::format("{}: time visible", sculpture.title),
             "s of a presentation", "visible", &sculpture, &sculpture.seconds_visible, ColourMap::viridis,
             0.0, highest(sculpture.seconds_visible)});
    }
    for (const DifferenceMap& map : results.differences) {
        const StudySculpture& sculpture = results.sculptures[static_cast<std::size_t>(map.sculpture)];
        const std::string words =
            fmt::format("{}, {} {} less {}", words_of_keys(map.keys), map.column, map.a, map.b);
        add({fmt::format("difference_{}_{}", sculpture.id, words),
             fmt::format("{}: {}", sculpture.title, words), "share of fixation time per mm^2", "difference",
             &sculpture, &map.difference, ColourMap::coolwarm, largest > 0.0 ? -largest : -1.0,
             largest > 0.0 ? largest : 1.0});
    }
    return files;
}

} // namespace

int write_surfaces(const StudyResults& results, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    const std::vector<SurfaceFile> files = files_of(results);
    parallel_for(static_cast<int>(files.size()), [&](int i) {
        const SurfaceFile& file = files[static_cast<std::size_t>(i)];
        const auto colours = colours_of(file);
        const ColouredMesh coloured{
            *file.sculpture->mesh,
            *file.values,
            colours,
            file.title,
            {{"quantity", file.unit},
             {"colours", fmt::format("{} from {:.6g} to {:.6g}", name_of(file.colours), file.low, file.high)},
             {"grey", "never visible in a presentation"}}};
        write_glb(folder / fmt::format("{}.glb", file.name), coloured);
        write_coloured_ply(folder / fmt::format("{}.ply", file.name), coloured);
    });
    std::string index = "file,kind,sculpture,title,unit,colours,low,high\n";
    for (const SurfaceFile& file : files)
        index +=
            fmt::format("{},{},\"{}\",\"{}\",{},{},{:.9g},{:.9g}\n", file.name, file.kind, file.sculpture->id,
                        file.title, file.unit, name_of(file.colours), file.low, file.high);
    write_whole_file(folder / "index.csv", index);
    return static_cast<int>(files.size());
}

} // namespace overt
