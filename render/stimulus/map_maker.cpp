#include "render/stimulus/map_maker.h"

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/maps/coordinate_image_file.h"
#include "render/stimulus/given_maps.h"

namespace overt {

void MapMaker::prepare_given_maps(const Progress& progress) {
    const int count = static_cast<int>(cache_->poses().angles.size());
    for (const ViewedObject& viewed : all_viewed_objects(cache_->protocol())) {
        if (!cache_->has_given_maps(viewed.object))
            continue;
        const std::string what = "reading the maps of " + viewed_name(cache_->protocol(), viewed);
        if (progress)
            progress(what, 0, count, 0.0);
        parallel_for(count, [&](int pose) {
            const std::filesystem::path file = cache_->map_file(viewed, {pose});
            if (std::filesystem::exists(file))
                return;
            const CoordinateImageFile map = read_given_map(cache_->protocol(), viewed.object,
                                                           first_frame_of(cache_->poses(), PoseIndex{pose}));
            std::filesystem::create_directories(file.parent_path());
            write_coordinate_exr(file, map.image, map.description);
        });
        if (progress)
            progress(what, count, count, 1.0);
    }
}

void MapMaker::prepare_maps(const Progress& progress) {
    for (const ViewedObject& viewed : all_viewed_objects(cache_->protocol())) {
        if (cache_->objects()[static_cast<std::size_t>(viewed.object)].has_mesh())
            prepare_maps(viewed, progress);
    }
}

void MapMaker::prepare_maps(const ViewedObject& viewed, const Progress& progress) {
    const std::string what = "mapping " + viewed_name(cache_->protocol(), viewed);
    const int count = cache_->poses().count();
    bool drew = false;
    for (int pose = 0; pose < count; ++pose) {
        if (progress && !cache_->has_map(viewed, {pose}))
            progress(what, pose, count, static_cast<double>(pose) / count);
        drew = draw_missing_map(viewed, {pose}) || drew;
    }
    if (drew && progress)
        progress(what, count, count, 1.0);
}

bool MapMaker::draw_missing_map(const ViewedObject& viewed, PoseIndex pose) {
    const std::filesystem::path file = cache_->map_file(viewed, pose);
    if (cache_->has_map(viewed, pose))
        return false;
    const Object& figure = cache_->objects()[static_cast<std::size_t>(viewed.object)];
    const ObjectPose& angle = cache_->poses().object_of(pose);
    std::filesystem::create_directories(file.parent_path());
    const TriangleMap map = draw_map(viewed, pose);
    if (map.covered_pixels() == 0) {
        throw InputError(fmt::format(
            "object \"{}\" is nowhere in the picture at {:.3g} degrees: correct the camera under {}",
            figure.id, angle.angle.value, section_of_view(cache_->protocol(), viewed.view)));
    }
    const Camera& camera = figure.scene(viewed.view).view.camera;
    MapAttributes words{
        {"mesh_sha256", figure.mesh_hash},
        {"angle_deg", fmt::format("{}", angle.angle.value)},
        {"camera_position", fmt::format("{} {} {}", camera.position.x, camera.position.y, camera.position.z)},
        {"camera_target", fmt::format("{} {} {}", camera.target.x, camera.target.y, camera.target.z)},
        {"camera_vertical_fov_deg", fmt::format("{}", camera.vertical_fov.value)}};
    if (camera.aside != 0.0)
        words.emplace_back("camera_aside", fmt::format("{}", camera.aside));
    write_triangle_map(file, map, words);
    return true;
}

TriangleMap MapMaker::draw_map(const ViewedObject& viewed, PoseIndex pose) {
    const SceneView& scene = cache_->objects()[static_cast<std::size_t>(viewed.object)].scene(viewed.view);
    if (!coordinate_pass_ || coordinate_pass_->target().size_px() != scene.view.image_px)
        coordinate_pass_.emplace(*context_, scene.view.image_px);
    return {scene.view.image_px,
            coordinate_pass_->draw(buffers_of(viewed.object, false), scene, cache_->poses().object_of(pose))};
}

const MeshBuffers& MapMaker::buffers_of(int object, bool for_light) {
    if (buffered_object_ != object || (for_light && !buffered_for_light_)) {
        const Mesh& mesh = cache_->objects()[static_cast<std::size_t>(object)].mesh;
        buffers_.reset();
        if (for_light) {
            buffers_.emplace(*context_, mesh, openness_of_vertices(mesh));
        } else {
            buffers_.emplace(*context_, mesh);
        }
        buffered_object_ = object;
        buffered_for_light_ = for_light;
    }
    return *buffers_;
}

} // namespace overt
