#include "app/record/recorded_surface.h"

#include <malloc.h>

#include <fmt/format.h>

#include "experiment/base/content_hash.h"
#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/scene/mesh_reader.h"
#include "experiment/stimulus/sculpture.h"

namespace overt {

namespace {

RecordError not_as_recorded(const std::filesystem::path& file, std::string_view what) {
    return RecordError(fmt::format(
        "{}: is not the {} that was recorded: it was changed, damaged or taken away", file.string(), what));
}

/// What cannot be read here was no user's input.
Mesh recorded_mesh(const std::filesystem::path& file) {
    try {
        MeshCleaningReport unused;
        return import_mesh(file, {}, unused);
    } catch (const InputError& error) {
        throw RecordError(error.what());
    }
}

/// Calls read(pose, file) for each map of a sculpture that is of this kind, on all processors, once it is
/// known that the file is the one recorded.
template <class Read>
void read_maps(const SessionRecord& record, int sculpture, RecordedMap::Kind kind, const Read& read) {
    std::vector<const RecordedMap*> maps;
    for (const RecordedMap& map : record.header().maps) {
        if (map.sculpture == sculpture && map.kind == kind)
            maps.push_back(&map);
    }
    parallel_for(static_cast<int>(maps.size()), [&](int i) {
        const RecordedMap& map = *maps[static_cast<std::size_t>(i)];
        const std::filesystem::path file = record.directory() / map.file;
        if (!std::filesystem::is_regular_file(file) || hash_of_file(file) != map.sha256)
            throw not_as_recorded(file, "map");
        read(static_cast<std::size_t>(map.pose.value), file);
    });
}

} // namespace

const SurfaceLookup* RecordedSurfaces::lookup_of(int sculpture) {
    const Surface& surface = surface_of(sculpture);
    if (surface.maps)
        return surface.maps.get();
    return surface.images.get();
}

RecordedSurfaces::Surface& RecordedSurfaces::surface_of(int sculpture) {
    if (keep_ == Keep::last && !loaded_.contains(sculpture)) {
        loaded_.clear();
        malloc_trim(0); // else the C library keeps it, and the next sculpture's comes on top
    }
    std::unique_ptr<Surface>& surface = loaded_[sculpture];
    if (surface)
        return *surface;
    auto loading = std::make_unique<Surface>();
    if (!record_->header().sculptures[static_cast<std::size_t>(sculpture)].mesh_file.empty()) {
        load_maps(*loading, sculpture);
    } else {
        load_images(*loading, sculpture);
    }
    surface = std::move(loading);
    return *surface;
}

void RecordedSurfaces::load_maps(Surface& surface, int sculpture) const {
    const SessionHeader& header = record_->header();
    const RecordedSculpture& recorded = header.sculptures[static_cast<std::size_t>(sculpture)];
    const std::filesystem::path mesh_file = record_->directory() / recorded.mesh_file;
    surface.mesh = recorded_mesh(mesh_file);
    if (hash_of_mesh(surface.mesh) != recorded.mesh_sha256)
        throw not_as_recorded(mesh_file, "mesh");
    SceneView scene{{recorded.camera, header.display.screen.image_px}, surface.mesh.bounds()};
    // A pose that was never lit in a session with live maps has an empty one.
    const glm::ivec2 image_px = header.display.screen.image_px;
    const std::size_t pixels = static_cast<std::size_t>(image_px.x) * static_cast<std::size_t>(image_px.y);
    std::vector<TriangleMap> maps(header.poses.angles.size(), {image_px, std::vector<std::uint32_t>(pixels)});
    read_maps(
        *record_, sculpture, RecordedMap::Kind::triangles,
        [&](std::size_t pose, const std::filesystem::path& file) { maps[pose] = read_triangle_map(file); });
    surface.maps =
        std::make_unique<CoordinateMaps>(surface.mesh, scene, header.poses.angles, std::move(maps), use_);
}

void RecordedSurfaces::load_images(Surface& surface, int sculpture) const {
    const SessionHeader& header = record_->header();
    std::vector<CoordinateImageFile> maps(header.poses.angles.size());
    read_maps(*record_, sculpture, RecordedMap::Kind::coordinates,
              [&](std::size_t pose, const std::filesystem::path& file) {
                  maps[pose] = read_coordinate_image(file);
              });
    // Without maps there is no surface; a sculpture with ready-made maps has one of every pose.
    if (maps.front().image.pixels.empty())
        return;
    surface.images = std::make_unique<CoordinateImageLookup>(std::move(maps), header.display.screen.image_px);
}

} // namespace overt
