#include "render/stimulus/frame_maker.h"

#include <exception>

#include "experiment/base/whole_file.h"
#include "render/stimulus/frame_description.h"

namespace overt {

std::vector<PoseIndex> FrameMaker::missing_frames(const Stimulus& stimulus, const FrameQuality& quality,
                                                  std::optional<PoseIndex> only) const {
    std::vector<PoseIndex> missing = cache_->missing_frames(stimulus, quality);
    if (only)
        std::erase_if(missing, [&](PoseIndex pose) { return pose != *only; });
    return missing;
}

void FrameMaker::make_frames(std::span<const Stimulus> stimuli, const FrameQuality& quality,
                             const Progress& progress, std::optional<PoseIndex> only) {
    double all = 0.0, done = 0.0;
    int count = 0, frames = 0;
    const auto cost_of = [&](const Stimulus& stimulus) {
        return quality.is_live()
                   ? 1.0
                   : expected_cost(quality, cache_->protocol(), cache_->material_of(stimulus).kind);
    };
    for (const Stimulus& stimulus : stimuli) {
        remove_abandoned_files(cache_->frame_file_of(stimulus, quality, {0}).parent_path());
        const auto missing = static_cast<int>(missing_frames(stimulus, quality, only).size());
        all += missing * cost_of(stimulus);
        count += missing;
    }
    const std::string what = quality.is_live() ? "drawing frames" : "rendering previews";
    // While one frame is compressed and written, the next is made.
    std::future<void> writing;
    // The tracer's threads hear from a progress that throws only that they are to stop.
    std::exception_ptr stopped;
    for (const Stimulus& stimulus : stimuli) {
        for (const PoseIndex pose : missing_frames(stimulus, quality, only)) {
            const double cost = cost_of(stimulus);
            const auto tell = [&](double share_of_frame) {
                try {
                    if (progress)
                        progress(what, frames, count, (done + share_of_frame * cost) / all);
                } catch (...) {
                    stopped = std::current_exception();
                }
                return !stopped;
            };
            if (!tell(0.0))
                std::rethrow_exception(stopped);
            if (quality.is_live()) {
                draw_live_frame(stimulus, pose, quality, writing);
            } else {
                SpectralFrame frame = trace(stimulus, pose, quality, tell);
                if (writing.valid())
                    writing.get();
                if (stopped)
                    std::rethrow_exception(stopped);
                writing =
                    std::async(std::launch::async, [this, stimulus, pose, quality, frame = std::move(frame)] {
                        cache_->store(stimulus, pose, quality, frame);
                    });
            }
            done += cost;
            ++frames;
        }
    }
    if (writing.valid())
        writing.get();
    if (progress && count > 0)
        progress(what, count, count, 1.0);
}

void FrameMaker::draw_live_frame(const Stimulus& stimulus, PoseIndex pose, const FrameQuality& quality,
                                 std::future<void>& writing) {
    const Object& object = cache_->object_of(stimulus);
    const MaterialSettings& material = cache_->material_of(stimulus);
    const std::filesystem::path file = cache_->frame_file_of(stimulus, quality, pose);
    std::filesystem::create_directories(file.parent_path());
    if (!renderer_)
        renderer_.emplace(*context_, cache_->protocol().lights.front(), object.scene.view.image_px);
    if (live_material_ != stimulus.material)
        renderer_->set_material(material);
    live_material_ = stimulus.material;
    const Degrees angle = cache_->angle_of(pose);
    LinearImage image = renderer_->draw(maps_->buffers_of(stimulus.object, true), object.scene, angle);
    if (writing.valid())
        writing.get();
    ImageAttributes attributes = describe_stimulus(cache_->protocol(), object, material, angle);
    attributes.emplace_back("overt:renderer", "OpenGL");
    writing =
        std::async(std::launch::async, [file, image = std::move(image), attributes = std::move(attributes)] {
            write_linear_exr(file, image, attributes);
        });
}

SpectralFrame FrameMaker::trace(const Stimulus& stimulus, PoseIndex pose, const FrameQuality& quality,
                                const BakeProgress& progress) {
    maps_->draw_missing_map(stimulus.object, pose);
    const TriangleMap map = read_triangle_map(cache_->map_file(stimulus.object, pose));
    const Object& object = cache_->object_of(stimulus);
    const MaterialSettings& material = cache_->material_of(stimulus);
    if (!light_)
        light_.emplace(cache_->protocol().lights.front());
    if (!scene_ || scene_of_ != stimulus) {
        scene_.reset(); // the memory of one at a time
        scene_.emplace(object.mesh, material);
        scene_of_ = stimulus;
    }
    std::vector<std::uint8_t> covered(map.codes.size());
    for (std::size_t i = 0; i < covered.size(); ++i)
        covered[i] = map.codes[i] != 0;
    return bake_frame(*scene_, *light_, object.scene, cache_->angle_of(pose), covered,
                      bake_settings(quality, cache_->protocol().bake, material.kind), progress);
}

} // namespace overt
