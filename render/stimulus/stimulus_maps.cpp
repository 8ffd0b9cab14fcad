// The hidden maps of a StimulusLibrary.
#include <limits>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "render/stimulus/frame_key.h"
#include "render/stimulus/given_maps.h"
#include "render/stimulus/stimulus_library.h"

namespace overt {

namespace {

double share(int done, int total) { return static_cast<double>(done) / total; }

} // namespace

bool StimulusLibrary::has_given_maps(int sculpture) const {
    return !protocol_->sculptures[static_cast<std::size_t>(sculpture)].lut.empty();
}

void StimulusLibrary::prepare_given_maps(const Progress& progress) {
    const int count = static_cast<int>(poses_.angles.size());
    for (int sculpture = 0; sculpture < static_cast<int>(sculptures_.size()); ++sculpture) {
        if (!has_given_maps(sculpture))
            continue;
        const std::string what = "reading the maps of " + sculptures_[static_cast<std::size_t>(sculpture)].id;
        if (progress)
            progress(what, 0, count, 0.0);
        parallel_for(count, [&](int pose) {
            const std::filesystem::path file = map_file(sculpture, {pose});
            if (std::filesystem::exists(file))
                return;
            const CoordinateImageFile map =
                read_given_map(*protocol_, sculpture, first_frame_of(poses_, PoseIndex{pose}));
            std::filesystem::create_directories(file.parent_path());
            write_coordinate_exr(file, map.image, map.description);
        });
        if (progress)
            progress(what, count, count, 1.0);
    }
}

SceneView StimulusLibrary::scene_of_given_maps(int sculpture) const {
    SceneView scene;
    scene.view.camera.vertical_fov.value = 0.0;
    scene.view.image_px = {protocol_->view.width_px, protocol_->view.height_px};
    const MapDescription first = read_map_description(map_file(sculpture, {0}));
    if (first.camera)
        scene.view.camera = *first.camera;
    if (first.bounds) {
        scene.bounds = *first.bounds;
        return scene;
    }
    // Coordinates that need no box to be read: it is as large as what is seen.
    scene.bounds = {glm::dvec3(std::numeric_limits<double>::infinity()),
                    glm::dvec3(-std::numeric_limits<double>::infinity())};
    for (int pose = 0; pose < static_cast<int>(poses_.angles.size()); ++pose) {
        for (const glm::vec4& pixel : read_coordinate_image(map_file(sculpture, {pose})).image.pixels) {
            if (pixel.w == 0.0f)
                continue;
            scene.bounds.min = glm::min(scene.bounds.min, glm::dvec3(pixel));
            scene.bounds.max = glm::max(scene.bounds.max, glm::dvec3(pixel));
        }
    }
    return scene;
}

void StimulusLibrary::prepare_maps(const Progress& progress) {
    for (int sculpture = 0; sculpture < static_cast<int>(sculptures_.size()); ++sculpture) {
        if (sculptures_[static_cast<std::size_t>(sculpture)].has_mesh())
            prepare_maps(sculpture, progress);
    }
}

void StimulusLibrary::prepare_maps(int sculpture, const Progress& progress) {
    const std::string what = "mapping " + sculptures_[static_cast<std::size_t>(sculpture)].id;
    const int count = static_cast<int>(poses_.angles.size());
    bool drew = false;
    for (int pose = 0; pose < count; ++pose) {
        if (progress && !std::filesystem::exists(map_file(sculpture, {pose})))
            progress(what, pose, count, share(pose, count));
        drew = draw_missing_map(sculpture, {pose}) || drew;
    }
    if (drew && progress)
        progress(what, count, count, 1.0);
}

bool StimulusLibrary::draw_missing_map(int sculpture, PoseIndex pose) {
    const std::filesystem::path file = map_file(sculpture, pose);
    if (std::filesystem::exists(file))
        return false;
    const Sculpture& figure = sculptures_[static_cast<std::size_t>(sculpture)];
    const Degrees angle = poses_.angles[static_cast<std::size_t>(pose.value)];
    std::filesystem::create_directories(file.parent_path());
    const TriangleMap map = draw_map(sculpture, pose);
    if (map.covered_pixels() == 0) {
        throw InputError(fmt::format(
            "sculpture «{}» is nowhere in the picture at {:.3g} degrees: correct the camera under [view]",
            figure.id, angle.value));
    }
    const Camera& camera = figure.scene.view.camera;
    write_triangle_map(
        file, map,
        {{"mesh_sha256", figure.mesh_hash},
         {"angle_deg", fmt::format("{}", angle.value)},
         {"camera_position",
          fmt::format("{} {} {}", camera.position.x, camera.position.y, camera.position.z)},
         {"camera_target", fmt::format("{} {} {}", camera.target.x, camera.target.y, camera.target.z)},
         {"camera_vertical_fov_deg", fmt::format("{}", camera.vertical_fov.value)}});
    return true;
}

const MeshBuffers& StimulusLibrary::buffers_of(int sculpture, bool for_light) {
    if (buffered_sculpture_ != sculpture || (for_light && !buffered_for_light_)) {
        const Mesh& mesh = sculptures_[static_cast<std::size_t>(sculpture)].mesh;
        buffers_.reset();
        if (for_light) {
            buffers_.emplace(*context_, mesh, openness_of_vertices(mesh));
        } else {
            buffers_.emplace(*context_, mesh);
        }
        buffered_sculpture_ = sculpture;
        buffered_for_light_ = for_light;
    }
    return *buffers_;
}

TriangleMap StimulusLibrary::draw_map(int sculpture, PoseIndex pose) {
    const SceneView& scene = sculptures_[static_cast<std::size_t>(sculpture)].scene;
    if (!coordinate_pass_)
        coordinate_pass_.emplace(*context_, scene.view.image_px);
    return {scene.view.image_px, coordinate_pass_->draw(buffers_of(sculpture, false), scene,
                                                        poses_.angles[static_cast<std::size_t>(pose.value)])};
}

std::filesystem::path StimulusLibrary::map_file(int sculpture, PoseIndex pose) const {
    if (has_given_maps(sculpture)) {
        return cached("given_maps", hash_of_given_map(*protocol_, sculpture, first_frame_of(poses_, pose)),
                      pose.value);
    }
    return cached("maps", map_key(sculptures_[static_cast<std::size_t>(sculpture)]), pose.value);
}

CoordinateMaps StimulusLibrary::maps_of(int sculpture) const {
    const Sculpture& figure = sculptures_[static_cast<std::size_t>(sculpture)];
    OVERT_EXPECTS(figure.has_mesh());
    std::vector<TriangleMap> maps;
    for (int pose = 0; pose < static_cast<int>(poses_.angles.size()); ++pose)
        maps.push_back(read_triangle_map(map_file(sculpture, {pose})));
    return {figure.mesh, figure.scene, poses_.angles, std::move(maps)};
}

} // namespace overt
