#include "render/stimulus/frame_maker.h"

#include <algorithm>
#include <exception>
#include <set>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "render/bake/own_surface.h"

namespace overt {

std::vector<Pose> FrameMaker::missing_frames(const Stimulus& stimulus, const FrameQuality& quality,
                                             const std::optional<Pose>& only) const {
    std::vector<Pose> missing = cache_->missing_frames(stimulus, quality);
    if (only)
        std::erase_if(missing, [&](const Pose& pose) { return !is_same_pose(pose, *only); });
    return missing;
}

void FrameMaker::make_frames(std::span<const Stimulus> stimuli, const FrameQuality& quality,
                             const Progress& progress, std::optional<Pose> only) {
    double all = 0.0, done = 0.0;
    int count = 0, frames = 0;
    const auto cost_of = [&](const Stimulus& stimulus) {
        if (quality.is_live())
            return 1.0;
        return is_sum(stimulus, quality)
                   ? 0.0
                   : expected_cost(quality, cache_->protocol(), cache_->material_of(stimulus).kind);
    };
    // Stimuli may share frames: each is made once, with the first that needs it.
    struct Missing {
        Stimulus stimulus;
        Pose pose;
    };
    std::vector<Missing> missing;
    std::set<std::filesystem::path> files, folders;
    // What is added up comes after its parts.
    std::vector<Stimulus> in_order;
    for (const Stimulus& stimulus : stimuli) {
        if (is_sum(stimulus, quality) && !missing_frames(stimulus, quality, only).empty())
            for (const Stimulus& part : cache_->parts_of(stimulus))
                in_order.push_back(part);
        in_order.push_back(stimulus);
    }
    for (const Stimulus& stimulus : in_order) {
        for (const Pose& pose : cache_->pictures_of(stimulus))
            folders.insert(cache_->frame_file_of(stimulus, quality, pose).parent_path());
    }
    std::ranges::for_each(folders, remove_abandoned_files);
    for (const Stimulus& stimulus : in_order) {
        for (const Pose& pose : missing_frames(stimulus, quality, only)) {
            if (!files.insert(cache_->frame_file_of(stimulus, quality, pose)).second)
                continue;
            missing.push_back({stimulus, pose});
            all += cost_of(stimulus);
            ++count;
        }
    }
    const std::string what = quality.is_live() ? "drawing frames" : "rendering previews";
    // While one frame is compressed and written, the next is made.
    std::future<void> writing;
    // The tracer's threads hear from a progress that throws only that they are to stop.
    std::exception_ptr stopped;
    for (const auto& [made, pose] : missing) {
        const Stimulus stimulus = made;
        const double cost = cost_of(stimulus);
        const auto tell = [&](double share_of_frame) {
            try {
                if (progress)
                    progress(what, frames, count, all > 0.0 ? (done + share_of_frame * cost) / all : 0.0);
            } catch (...) {
                stopped = std::current_exception();
            }
            return !stopped;
        };
        if (!tell(0.0))
            std::rethrow_exception(stopped);
        if (quality.is_live()) {
            draw_live_frame(stimulus, pose, quality, writing);
        } else if (is_sum(stimulus, quality)) {
            if (writing.valid())
                writing.get();
            cache_->add_up(stimulus, pose, quality);
        } else {
            SpectralFrame frame = trace(stimulus, pose, quality, tell);
            if (writing.valid())
                writing.get();
            if (stopped)
                std::rethrow_exception(stopped);
            writing = std::async(std::launch::async,
                                 [this, stimulus, of = pose, quality, frame = std::move(frame)] {
                                     cache_->store(stimulus, of, quality, frame);
                                 });
        }
        done += cost;
        ++frames;
    }
    if (writing.valid())
        writing.get();
    if (progress && count > 0)
        progress(what, count, count, 1.0);
}

void FrameMaker::add_up_what_is_there(std::span<const Stimulus> stimuli, const FrameQuality& quality) {
    for (const Stimulus& stimulus : stimuli) {
        if (!is_sum(stimulus, quality))
            continue;
        for (const Pose& pose : missing_frames(stimulus, quality, std::nullopt))
            if (cache_->can_add_up(stimulus, pose, quality))
                cache_->add_up(stimulus, pose, quality);
    }
}

void FrameMaker::draw_live_frame(const Stimulus& stimulus, const Pose& pose, const FrameQuality& quality,
                                 std::future<void>& writing) {
    const SceneView& scene = cache_->scene_of(stimulus);
    std::filesystem::create_directories(cache_->frame_file_of(stimulus, quality, pose).parent_path());
    if (!renderer_ || live_light_ != stimulus.light || live_size_px_ != scene.view.image_px) {
        renderer_.emplace(*context_, cache_->protocol().light_of(stimulus), scene.view.image_px);
        live_material_ = -1;
    }
    live_light_ = stimulus.light;
    live_size_px_ = scene.view.image_px;
    const MaterialSettings& material = cache_->material_of(stimulus);
    const Object& object = cache_->object_of(stimulus);
    const MeshBuffers& buffers = maps_->buffers_of(stimulus.object, true);
    if (live_material_ != stimulus.material || (material.is_own() && live_object_ != stimulus.object)) {
        if (material.is_own() && object.appearance) {
            painted_.reset();
            painted_.emplace(*context_, object.mesh, buffers, *object.appearance, material);
            renderer_->set_painted(*painted_);
        } else {
            renderer_->set_material(material);
        }
    }
    live_material_ = stimulus.material;
    live_object_ = stimulus.object;
    LinearImage image = renderer_->draw(buffers, scene, pose);
    if (writing.valid())
        writing.get();
    const GlDescription& gl = context_->description();
    writing =
        std::async(std::launch::async, [this, stimulus, pose, quality, image = std::move(image),
                                        renderer = fmt::format("{}, OpenGL {}", gl.renderer, gl.version)] {
            cache_->store_live(stimulus, pose, quality, image, renderer);
        });
}

SpectralFrame FrameMaker::trace(const Stimulus& stimulus, const Pose& pose, const FrameQuality& quality,
                                const BakeProgress& progress) {
    OVERT_EXPECTS(!is_sum(stimulus, quality));
    const PoseIndex turn = cache_->poses().index_of(pose.object);
    maps_->draw_missing_map(viewed(stimulus), turn);
    const TriangleMap map = cache_->read_map(viewed(stimulus), turn);
    const MaterialSettings& material = cache_->material_of(stimulus);
    if (!light_ || light_of_ != stimulus.light)
        light_.emplace(cache_->protocol().light_of(stimulus));
    light_of_ = stimulus.light;
    light_->turn_to(pose.light);
    if (!scene_ || scene_object_ != stimulus.object || scene_material_ != stimulus.material) {
        scene_.reset();
        const Object& object = cache_->object_of(stimulus);
        scene_.emplace(object.mesh, material, object.appearance);
        scene_object_ = stimulus.object;
        scene_material_ = stimulus.material;
    }
    std::vector<std::uint8_t> covered(map.codes.size());
    for (std::size_t i = 0; i < covered.size(); ++i)
        covered[i] = map.codes[i] != 0;
    return bake_frame(*scene_, *light_, cache_->scene_of(stimulus), pose.object, covered,
                      bake_settings(quality, cache_->protocol().bake, material.kind), progress);
}

} // namespace overt
