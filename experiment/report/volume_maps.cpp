#include "experiment/report/volume_maps.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/safe_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/report/map_names.h"
#include "experiment/study/study_maps.h"
#include "experiment/surface/volume_file.h"

namespace overt {

int write_volumes(const StudyResults& results, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    std::string index = "file,object,title,sigma_mm,highest_per_mm3,x_low_mm,y_low_mm,z_low_mm,x_high_mm,"
                        "y_high_mm,z_high_mm\n";
    constexpr int table_side = 33;
    int written = 0;
    FileNames names;
    for (const StudyMap& map : results.maps) {
        const StudyObject& object = results.objects[static_cast<std::size_t>(map.object)];
        const StudyGroup& group = results.groups[static_cast<std::size_t>(map.group)];
        const std::vector<const StudyFixation*> fixations = fixations_on(results, group.trials, map.object);
        if (map.weighting != MapWeighting::duration || !object.mesh || !object.mm_per_unit ||
            fixations.empty() || map.trials == 0)
            continue;
        double sigma_mm = 0.0;
        for (const StudyFixation* fixation : fixations)
            sigma_mm += fixation->sigma_mm / static_cast<double>(fixations.size());
        if (!(sigma_mm > 0.0))
            continue;
        const double scale = *object.mm_per_unit;
        Bounds bounds = object.mesh->bounds();
        bounds.min *= scale;
        bounds.max *= scale;
        VoxelDensity voxels(bounds, sigma_mm);
        for (const StudyFixation* fixation : fixations)
            voxels.add(fixation->position * scale, 1e3 * fixation->duration_s / map.trials);
        voxels.blur();
        const double most = *std::ranges::max_element(voxels.values());
        const std::string words = words_of_keys(group.keys);
        const std::string name = names.of(fmt::format("map_{}_{}", object.id, words)),
                          title = fmt::format("{}: {}", object.title, words);
        constexpr std::string_view meaning = "ms of fixation of a trial per mm^3 of the object";
        write_nrrd(folder / fmt::format("{}.nrrd", name), voxels, "mm",
                   fmt::format("{}; shown {}", meaning, shown_size_words(object)));
        write_cube_table(folder / fmt::format("{}.cube", name), voxels, bounds, most, table_side, title,
                         meaning);
        index +=
            fmt::format("{},{},{},{:.6g},{:.9g},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}\n", csv_cell(name),
                        csv_cell(object.id), csv_cell(title), sigma_mm, most, bounds.min.x, bounds.min.y,
                        bounds.min.z, bounds.max.x, bounds.max.y, bounds.max.z);
        ++written;
    }
    write_whole_file(folder / "index.csv", index);
    return written;
}

} // namespace overt
