#include "app/record/recorded_surface.h"

#include <malloc.h>

#include <fmt/format.h>

#include "experiment/base/content_hash.h"
#include "experiment/base/error.h"
#include "experiment/base/path_inside.h"
#include "experiment/scene/files/mesh_reader.h"
#include "experiment/stimulus/object.h"

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

/// An object's maps of one kind, by pose; null where there is none.
std::vector<const RecordedMap*> maps_of(const SessionHeader& header, const ViewedObject& viewed,
                                        RecordedMap::Kind kind) {
    std::vector<const RecordedMap*> maps(header.poses.angles.size(), nullptr);
    for (const RecordedMap& map : header.maps)
        if (map.viewed == viewed && map.kind == kind)
            maps[static_cast<std::size_t>(map.pose.value)] = &map;
    return maps;
}

/// Where a map lies, once it is known that the file is the one recorded.
std::filesystem::path sound_file(const SessionRecord& record, const RecordedMap& map) {
    std::filesystem::path file = record.directory() / map.file;
    if (!is_file_inside(record.directory(), map.file) || hash_of_file(file) != map.sha256)
        throw not_as_recorded(file, "map");
    return file;
}

} // namespace

const SurfaceLookup* RecordedSurfaces::lookup_of(const ViewedObject& viewed) {
    const Surface& surface = surface_of(viewed);
    if (surface.maps)
        return surface.maps.get();
    return surface.images.get();
}

const GlassSight* RecordedSurfaces::glass_of(const ViewedObject& viewed, double index) {
    Surface& surface = surface_of(viewed);
    return surface.maps ? &surface.glass.try_emplace(index, *surface.maps, index).first->second : nullptr;
}

RecordedSurfaces::Surface& RecordedSurfaces::surface_of(const ViewedObject& viewed) {
    if (keep_ == Keep::last && !loaded_.contains(viewed)) {
        // What both eyes see of an object is asked for together.
        const auto views = static_cast<int>(record_->header().views_of_an_eye());
        std::erase_if(loaded_, [&](const auto& held) {
            return held.first.object != viewed.object || held.first.view % views != viewed.view % views;
        });
        malloc_trim(0); // else the C library keeps it, and the next object's comes on top
    }
    std::unique_ptr<Surface>& surface = loaded_[viewed];
    if (surface)
        return *surface;
    auto loading = std::make_unique<Surface>();
    if (!record_->header().objects[static_cast<std::size_t>(viewed.object)].mesh_file.empty()) {
        load_maps(*loading, viewed);
    } else {
        load_images(*loading, viewed);
    }
    surface = std::move(loading);
    return *surface;
}

void RecordedSurfaces::load_maps(Surface& surface, const ViewedObject& viewed) const {
    const SessionHeader& header = record_->header();
    const RecordedObject& recorded = header.objects[static_cast<std::size_t>(viewed.object)];
    const std::filesystem::path mesh_file = require_file_inside(record_->directory(), recorded.mesh_file);
    surface.mesh = recorded_mesh(mesh_file);
    if (hash_of_mesh(surface.mesh) != recorded.mesh_sha256)
        throw not_as_recorded(mesh_file, "mesh");
    const glm::ivec2 image_px = header.screen_of_view(viewed.view).image_px;
    SceneView scene{{recorded.camera(viewed.view), image_px}, surface.mesh.bounds()};
    const std::size_t pixels = static_cast<std::size_t>(image_px.x) * static_cast<std::size_t>(image_px.y);
    const auto maps = maps_of(header, viewed, RecordedMap::Kind::triangles);
    surface.maps = std::make_unique<CoordinateMaps>(
        surface.mesh, scene, header.poses.angles,
        [&](PoseIndex pose) {
            // A pose that was never lit in a session with live maps has an empty one.
            const RecordedMap* const map = maps[static_cast<std::size_t>(pose.value)];
            return map ? read_triangle_map(sound_file(*record_, *map))
                       : TriangleMap{image_px, std::vector<std::uint32_t>(pixels)};
        },
        use_);
}

void RecordedSurfaces::load_images(Surface& surface, const ViewedObject& viewed) const {
    const SessionHeader& header = record_->header();
    const auto maps = maps_of(header, viewed, RecordedMap::Kind::coordinates);
    // Without maps there is no surface; an object with ready-made maps has one of every pose.
    if (!maps.front())
        return;
    surface.images = std::make_unique<CoordinateImageLookup>(
        maps.size(),
        [&](PoseIndex pose) {
            const RecordedMap* const map = maps[static_cast<std::size_t>(pose.value)];
            return map ? read_coordinate_image(sound_file(*record_, *map)) : CoordinateImageFile{};
        },
        header.screen_of_view(viewed.view).image_px);
}

} // namespace overt
