#include "render/stimulus_library.h"

#include <future>
#include <limits>

#include <fmt/format.h>

#include "experiment/colour/display_colour.h"
#include "experiment/error.h"
#include "experiment/parallel.h"
#include "render/given_maps.h"
#include "render/ready_made_frames.h"

namespace overt {

namespace {

/// Changes whenever the same inputs would give other maps.
constexpr int coordinate_pass_version = 1;

ContentHasher& add_view(ContentHasher& hasher, const SceneView& scene) {
    const Camera& camera = scene.view.camera;
    for (const glm::dvec3& vector : {camera.position, camera.target})
        hasher.add(vector.x).add(vector.y).add(vector.z);
    return hasher.add(camera.vertical_fov.value).add(scene.view.image_px.x).add(scene.view.image_px.y);
}

ContentHasher& add_material(ContentHasher& hasher, const MaterialSettings& material) {
    hasher.add(static_cast<int>(material.kind)).add(std::string_view(material.metal));
    for (const double number : {material.roughness, material.coat_ior, material.coat_bump})
        hasher.add(number);
    for (const double number : material.coat_absorbance)
        hasher.add(number);
    for (const double number : material.reflectance)
        hasher.add(number);
    return hasher;
}

ContentHash hash_of_light(const LightSettings& light) {
    ContentHasher hasher;
    hasher.add(std::string_view(light.probe == "overcast" ? light.probe : hash_of_file(light.probe)));
    hasher.add(light.exposure).add(light.rotation_deg).add(stimulus_renderer_version);
    return hasher.finish();
}

} // namespace

StimulusLibrary::StimulusLibrary(const GlContext& context, const Protocol& protocol,
                                 std::span<const Sculpture> sculptures, std::filesystem::path cache)
    : context_(&context), protocol_(&protocol), sculptures_(sculptures), cache_(std::move(cache)),
      poses_(distinct_poses(protocol.animation)), light_hash_(hash_of_light(protocol.light)) {}

void StimulusLibrary::prepare_frames(const Progress& progress) {
    for (int sculpture = 0; sculpture < static_cast<int>(sculptures_.size()); ++sculpture) {
        for (int material = 0; material < static_cast<int>(protocol_->materials.size()); ++material) {
            prepare_frames({sculpture, material}, progress);
        }
    }
}

void StimulusLibrary::prepare_frames(const Condition& condition, const Progress& progress) {
    const Sculpture& sculpture = sculptures_[static_cast<std::size_t>(condition.sculpture)];
    const MaterialSettings& material = protocol_->materials[static_cast<std::size_t>(condition.material)];
    const std::string name = fmt::format("{}, {}", sculpture.id, material.id);
    if (const FrameSequenceSettings* sequence = sequence_of(condition)) {
        check_frame_sizes(*sequence, protocol_->animation.frame_count,
                          {protocol_->view.width_px, protocol_->view.height_px});
        return;
    }
    if (!sculpture.has_mesh()) {
        throw InputError(fmt::format("{}: there is neither a mesh to draw nor [[frames]] to show", name));
    }
    const int count = static_cast<int>(poses_.angles.size());
    std::vector<int> missing;
    for (int pose = 0; pose < count; ++pose) {
        if (!std::filesystem::exists(page_file(condition, pose)))
            missing.push_back(pose);
    }
    if (missing.empty())
        return;
    std::filesystem::create_directories(page_file(condition, 0).parent_path());
    if (!renderer_)
        renderer_.emplace(*context_, protocol_->light, sculpture.scene.view.image_px);
    renderer_->set_material(material);
    int done = count - static_cast<int>(missing.size());
    // While one frame is compressed and written, the next is drawn.
    std::future<void> writing;
    for (const int pose : missing) {
        if (progress)
            progress("drawing " + name, done++, count);
        const Degrees angle = poses_.angles[static_cast<std::size_t>(pose)];
        LinearImage image = renderer_->draw(buffers_of(condition.sculpture, true), sculpture.scene, angle);
        if (writing.valid())
            writing.get();
        ImageAttributes attributes{{"overt:sculpture", sculpture.id},
                                   {"overt:material", material.id},
                                   {"overt:mesh_sha256", sculpture.mesh_hash},
                                   {"overt:angle_deg", fmt::format("{}", angle.value)},
                                   {"overt:renderer", "OpenGL preview"}};
        writing = std::async(std::launch::async, [file = page_file(condition, pose), image = std::move(image),
                                                  attributes = std::move(attributes)] {
            write_linear_exr(file, image, attributes);
        });
    }
    writing.get();
    if (progress)
        progress("drawing " + name, count, count);
}

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
            progress(what, 0, count);
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
            progress(what, count, count);
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
    const Sculpture& figure = sculptures_[static_cast<std::size_t>(sculpture)];
    const int count = static_cast<int>(poses_.angles.size());
    bool drew = false;
    for (int pose = 0; pose < count; ++pose) {
        const std::filesystem::path file = map_file(sculpture, {pose});
        if (std::filesystem::exists(file))
            continue;
        std::filesystem::create_directories(file.parent_path());
        if (progress)
            progress("mapping " + figure.id, pose, count);
        const TriangleMap map = draw_map(sculpture, {pose});
        if (map.covered_pixels() == 0) {
            throw InputError(fmt::format(
                "sculpture «{}» is nowhere in the picture at {:.3g} degrees: correct the camera under [view]",
                figure.id, poses_.angles[static_cast<std::size_t>(pose)].value));
        }
        const Camera& camera = figure.scene.view.camera;
        write_triangle_map(
            file, map,
            {{"mesh_sha256", figure.mesh_hash},
             {"angle_deg", fmt::format("{}", poses_.angles[static_cast<std::size_t>(pose)].value)},
             {"camera_position",
              fmt::format("{} {} {}", camera.position.x, camera.position.y, camera.position.z)},
             {"camera_target", fmt::format("{} {} {}", camera.target.x, camera.target.y, camera.target.z)},
             {"camera_vertical_fov_deg", fmt::format("{}", camera.vertical_fov.value)}});
        drew = true;
    }
    if (drew && progress)
        progress("mapping " + figure.id, count, count);
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

std::vector<int> StimulusLibrary::page_of_frame(const Condition& condition) const {
    std::vector<int> pages;
    for (int frame = 0; frame < protocol_->animation.frame_count; ++frame) {
        // Each ready-made frame is shown itself, even where two share a pose.
        pages.push_back(is_ready_made(condition) ? frame : poses_.pose_of({frame}).value);
    }
    return pages;
}

LinearImage StimulusLibrary::page(const Condition& condition, int page) const {
    LinearImage image;
    read_page(condition, page, image);
    return image;
}

void StimulusLibrary::read_page(const Condition& condition, int page, LinearImage& into) const {
    if (const FrameSequenceSettings* sequence = sequence_of(condition)) {
        read_linear_image(frame_file(*sequence, {page}), sequence->encoding, into);
        return;
    }
    read_linear_image(page_file(condition, page), FrameEncoding::linear, into);
    if (protocol_->display.characterisation) {
        const glm::mat3 to_display(display_from_rec709(*protocol_->display.characterisation));
        for (glm::vec4& pixel : into.pixels)
            pixel = glm::vec4(to_display * glm::vec3(pixel), pixel.w);
    }
}

std::string StimulusLibrary::source_of(const Condition& condition) const {
    if (const FrameSequenceSettings* sequence = sequence_of(condition))
        return "frames " + sequence->files;
    return "OpenGL preview";
}

ContentHash StimulusLibrary::frames_hash(const Condition& condition) const {
    ContentHasher hasher;
    if (const FrameSequenceSettings* sequence = sequence_of(condition)) {
        for (int frame = 0; frame < protocol_->animation.frame_count; ++frame) {
            hasher.add(std::string_view(hash_of_file(frame_file(*sequence, {frame}))));
        }
        return hasher.finish();
    }
    hasher.add(std::string_view(drawn_hash(condition)));
    if (protocol_->display.characterisation)
        hasher.add(std::string_view(protocol_->display.characterisation->sha256));
    return hasher.finish();
}

ContentHash StimulusLibrary::drawn_hash(const Condition& condition) const {
    ContentHasher hasher;
    const Sculpture& sculpture = sculptures_[static_cast<std::size_t>(condition.sculpture)];
    hasher.add(std::string_view(sculpture.mesh_hash)).add(std::string_view(light_hash_));
    add_view(hasher, sculpture.scene);
    add_material(hasher, protocol_->materials[static_cast<std::size_t>(condition.material)]);
    return hasher.finish();
}

std::filesystem::path StimulusLibrary::cached(std::string_view kind, const ContentHash& hash,
                                              int pose) const {
    return cache_ / kind / hash.substr(0, 24) /
           fmt::format("{:+010.5f}deg.exr", poses_.angles[static_cast<std::size_t>(pose)].value);
}

std::filesystem::path StimulusLibrary::page_file(const Condition& condition, int page) const {
    return cached("frames", drawn_hash(condition), page);
}

std::filesystem::path StimulusLibrary::map_file(int sculpture, PoseIndex pose) const {
    if (has_given_maps(sculpture)) {
        return cached("given_maps", hash_of_given_map(*protocol_, sculpture, first_frame_of(poses_, pose)),
                      pose.value);
    }
    const Sculpture& figure = sculptures_[static_cast<std::size_t>(sculpture)];
    ContentHasher hasher;
    hasher.add(std::string_view(figure.mesh_hash)).add(coordinate_pass_version);
    add_view(hasher, figure.scene);
    return cached("maps", hasher.finish(), pose.value);
}

CoordinateMaps StimulusLibrary::maps_of(int sculpture) const {
    const Sculpture& figure = sculptures_[static_cast<std::size_t>(sculpture)];
    OVERT_EXPECTS(figure.has_mesh());
    std::vector<TriangleMap> maps;
    for (int pose = 0; pose < static_cast<int>(poses_.angles.size()); ++pose)
        maps.push_back(read_triangle_map(map_file(sculpture, {pose})));
    return {figure.mesh, figure.scene, poses_.angles, std::move(maps)};
}

const FrameSequenceSettings* StimulusLibrary::sequence_of(const Condition& condition) const {
    return find_frames(*protocol_, condition.sculpture, condition.material);
}

} // namespace overt
