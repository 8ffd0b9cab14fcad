#include "experiment/report/surface_files.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "experiment/base/parallel.h"
#include "experiment/base/safe_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/report/map_names.h"
#include "experiment/surface/colour_scale.h"
#include "experiment/surface/coloured_mesh_file.h"

namespace overt {
namespace {

/// One map to be written.
struct SurfaceFile {
    std::string name, title, quantity, kind;
    bool is_density; ///< per area, in mm^2
    const StudyObject* object;
    const std::vector<float>* values;
    ColourMap colours;
    double low, high;
};

/// A format with its unit of length.
struct MeshFormat {
    std::string_view ending, unit;
    double units_per_mm;
    void (*write)(const std::filesystem::path&, const ColouredMesh&);
};
constexpr MeshFormat mesh_formats[] = {{"glb", "m", 1e-3, write_glb}, {"ply", "mm", 1.0, write_coloured_ply}};

/// What a value of the file is in one of the map.
double value_scale(const SurfaceFile& file, const MeshFormat& format) {
    return file.is_density ? 1.0 / (format.units_per_mm * format.units_per_mm) : 1.0;
}

std::string quantity_in(const SurfaceFile& file, const MeshFormat& format) {
    return file.is_density ? fmt::format("{} per {}^2 of the object", file.quantity, format.unit)
                           : file.quantity;
}

std::vector<std::array<std::uint8_t, 3>> colours_of(const SurfaceFile& file) {
    const ColourTable& table = colour_table(file.colours);
    std::vector<std::array<std::uint8_t, 3>> colours;
    colours.reserve(file.values->size());
    for (std::size_t v = 0; v < file.values->size(); ++v) {
        const std::vector<float>& visible = file.object->seconds_visible;
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
        const bool fits = file.object->mesh && file.object->mm_per_unit &&
                          !file.object->mesh->triangles.empty() &&
                          file.values->size() == file.object->mesh->positions.size();
        if (!fits)
            return;
        file.name = names.of(file.name);
        files.push_back(std::move(file));
    };
    for (const StudyMap& map : results.maps) {
        const StudyObject& object = results.objects[static_cast<std::size_t>(map.object)];
        if (map.weighting != MapWeighting::duration || map.density.empty())
            continue;
        const std::vector<StudyKey>& keys = results.groups[static_cast<std::size_t>(map.group)].keys;
        const std::string words = words_of_keys(keys);
        add({fmt::format("map_{}_{}", object.id, words), fmt::format("{}: {}", object.title, words),
             "ms of fixation of a trial", "map", true, &object, &map.density, ColourMap::viridis, 0.0,
             most > 0.0 ? most : 1.0});
    }
    for (const StudyObject& object : results.objects) {
        const auto highest = [](const std::vector<float>& values) {
            const double top = values.empty() ? 0.0 : *std::ranges::max_element(values);
            return top > 0.0 ? top : 1.0;
        };
        add({fmt::format("exposure_{}", object.id), fmt::format("{}: exposure", object.title),
             "share of the exposure", "exposure", true, &object, &object.exposure_density, ColourMap::viridis,
             0.0, highest(object.exposure_density)});
        add({fmt::format("visible_{}", object.id), fmt::format("{}: time visible", object.title),
             "s of a presentation", "visible", false, &object, &object.seconds_visible, ColourMap::viridis,
             0.0, highest(object.seconds_visible)});
    }
    for (const DifferenceMap& map : results.differences) {
        const StudyObject& object = results.objects[static_cast<std::size_t>(map.object)];
        const std::string words =
            fmt::format("{}, {} {} less {}", words_of_keys(map.keys), map.column, map.a, map.b);
        add({fmt::format("difference_{}_{}", object.id, words), fmt::format("{}: {}", object.title, words),
             "share of fixation time", "difference", true, &object, &map.difference, ColourMap::coolwarm,
             largest > 0.0 ? -largest : -1.0, largest > 0.0 ? largest : 1.0});
    }
    return files;
}

void write_as(const MeshFormat& format, const SurfaceFile& file,
              std::span<const std::array<std::uint8_t, 3>> colours, const std::filesystem::path& folder) {
    const double per_value = value_scale(file, format);
    std::vector<float> values;
    values.reserve(file.values->size());
    for (const float value : *file.values)
        values.push_back(static_cast<float>(per_value * static_cast<double>(value)));
    const StudyObject& object = *file.object;
    std::vector<std::pair<std::string, std::string>> legend{
        {"quantity", quantity_in(file, format)},
        {"lengths", fmt::format("{} of the object", format.unit)},
        {"shown", shown_size_words(object)},
        {"colours", fmt::format("{} from {:.6g} to {:.6g}", name_of(file.colours), per_value * file.low,
                                per_value * file.high)},
        {"grey", "never visible in a presentation"}};
    const double scale = *object.mm_per_unit * format.units_per_mm;
    if (object.origin != glm::dvec3(0.0)) {
        const glm::dvec3 origin = scale * object.origin;
        legend.emplace_back("origin",
                            fmt::format("{} {} {} {}, with z up: added to a place it gives that in the "
                                        "coordinates of the mesh's file, turned and scaled",
                                        origin.x, origin.y, origin.z, format.unit));
    }
    format.write(folder / fmt::format("{}.{}", file.name, format.ending),
                 {*object.mesh, values, colours, file.title, scale, std::move(legend)});
}

} // namespace

int write_surfaces(const StudyResults& results, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    const std::vector<SurfaceFile> files = files_of(results);
    parallel_for(static_cast<int>(files.size()), [&](int i) {
        const SurfaceFile& file = files[static_cast<std::size_t>(i)];
        const auto colours = colours_of(file);
        for (const MeshFormat& format : mesh_formats)
            write_as(format, file, colours, folder);
    });
    std::string index = "file,kind,object,title,quantity,lengths,colours,low,high\n";
    for (const SurfaceFile& file : files) {
        for (const MeshFormat& format : mesh_formats) {
            const double per_value = value_scale(file, format);
            index += fmt::format("{},{},{},{},{},{} of the object,{},{:.9g},{:.9g}\n",
                                 csv_cell(fmt::format("{}.{}", file.name, format.ending)), file.kind,
                                 csv_cell(file.object->id), csv_cell(file.title),
                                 csv_cell(quantity_in(file, format)), format.unit, name_of(file.colours),
                                 per_value * file.low, per_value * file.high);
        }
    }
    write_whole_file(folder / "index.csv", index);
    return static_cast<int>(files.size());
}

} // namespace overt
