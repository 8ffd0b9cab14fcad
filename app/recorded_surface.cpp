#include "app/recorded_surface.h"

#include <fmt/format.h>

#include "experiment/content_hash.h"
#include "experiment/error.h"
#include "experiment/parallel.h"
#include "experiment/scene/mesh_reader.h"

namespace overt {

const CoordinateMaps* RecordedSurfaces::maps_of(int sculpture) {
    const auto known = loaded_.find(sculpture);
    if (known != loaded_.end())
        return known->second ? known->second->maps.get() : nullptr;
    const SessionHeader& header = record_->header();
    const RecordedSculpture& recorded = header.sculptures[static_cast<std::size_t>(sculpture)];
    std::unique_ptr<Surface>& surface = loaded_[sculpture];
    if (recorded.mesh_file.empty())
        return nullptr;
    surface = std::make_unique<Surface>();
    MeshCleaningReport unused;
    surface->mesh = import_mesh(record_->directory() / recorded.mesh_file, {}, unused);
    SceneView scene{{recorded.camera, header.display.screen.image_px}, surface->mesh.bounds()};
    // A pose that was never lit in a session with live maps has an empty one.
    const glm::ivec2 image_px = header.display.screen.image_px;
    const std::size_t pixels = static_cast<std::size_t>(image_px.x) * static_cast<std::size_t>(image_px.y);
    std::vector<TriangleMap> maps(header.poses.angles.size(), {image_px, std::vector<std::uint32_t>(pixels)});
    std::vector<const RecordedMap*> files;
    for (const RecordedMap& map : header.maps) {
        if (map.sculpture == sculpture)
            files.push_back(&map);
    }
    parallel_for(static_cast<int>(files.size()), [&](int i) {
        const RecordedMap& map = *files[static_cast<std::size_t>(i)];
        const std::filesystem::path file = record_->directory() / map.file;
        if (hash_of_file(file) != map.sha256) {
            throw RecordError(fmt::format("{}: is not the map that was recorded: it was changed or damaged",
                                          file.string()));
        }
        maps[static_cast<std::size_t>(map.pose.value)] = read_triangle_map(file);
    });
    surface->maps =
        std::make_unique<CoordinateMaps>(surface->mesh, scene, header.poses.angles, std::move(maps));
    return surface->maps.get();
}

} // namespace overt
