#include "render/stimulus/frame_maker.h"

#include <exception>

#include "experiment/base/whole_file.h"
#include "render/stimulus/frame_description.h"

namespace overt {

std::vector<PoseIndex> FrameMaker::missing_frames(const Condition& condition, const FrameQuality& quality,
                                                  std::optional<PoseIndex> only) const {
    std::vector<PoseIndex> missing = cache_->missing_frames(condition, quality);
    if (only)
        std::erase_if(missing, [&](PoseIndex pose) { return pose != *only; });
    return missing;
}

void FrameMaker::make_frames(std::span<const Condition> conditions, const FrameQuality& quality,
                             const Progress& progress, std::optional<PoseIndex> only) {
    double all = 0.0, done = 0.0;
    int count = 0, frames = 0;
    const auto cost_of = [&](const Condition& condition) {
        return quality.is_live()
                   ? 1.0
                   : expected_cost(quality, cache_->protocol(), cache_->material_of(condition).kind);
    };
    for (const Condition& condition : conditions) {
        remove_abandoned_files(cache_->frame_file_of(condition, quality, {0}).parent_path());
        const auto missing = static_cast<int>(missing_frames(condition, quality, only).size());
        all += missing * cost_of(condition);
        count += missing;
    }
    const std::string what = quality.is_live() ? "drawing frames" : "rendering previews";
    // While one frame is compressed and written, the next is made.
    std::future<void> writing;
    // The tracer's threads hear from a progress that throws only that they are to stop.
    std::exception_ptr stopped;
    for (const Condition& condition : conditions) {
        for (const PoseIndex pose : missing_frames(condition, quality, only)) {
            const double cost = cost_of(condition);
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
                draw_live_frame(condition, pose, quality, writing);
            } else {
                SpectralFrame frame = trace(condition, pose, quality, tell);
                if (writing.valid())
                    writing.get();
                if (stopped)
                    std::rethrow_exception(stopped);
                writing = std::async(std::launch::async,
                                     [this, condition, pose, quality, frame = std::move(frame)] {
                                         cache_->store(condition, pose, quality, frame);
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

void FrameMaker::draw_live_frame(const Condition& condition, PoseIndex pose, const FrameQuality& quality,
                                 std::future<void>& writing) {
    const Object& object = cache_->object_of(condition);
    const MaterialSettings& material = cache_->material_of(condition);
    const std::filesystem::path file = cache_->frame_file_of(condition, quality, pose);
    std::filesystem::create_directories(file.parent_path());
    if (!renderer_)
        renderer_.emplace(*context_, cache_->protocol().light, object.scene.view.image_px);
    if (live_material_ != condition.material)
        renderer_->set_material(material);
    live_material_ = condition.material;
    const Degrees angle = cache_->angle_of(pose);
    LinearImage image = renderer_->draw(maps_->buffers_of(condition.object, true), object.scene, angle);
    if (writing.valid())
        writing.get();
    ImageAttributes attributes = describe_stimulus(cache_->protocol(), object, material, angle);
    attributes.emplace_back("overt:renderer", "OpenGL");
    writing =
        std::async(std::launch::async, [file, image = std::move(image), attributes = std::move(attributes)] {
            write_linear_exr(file, image, attributes);
        });
}

SpectralFrame FrameMaker::trace(const Condition& condition, PoseIndex pose, const FrameQuality& quality,
                                const BakeProgress& progress) {
    maps_->draw_missing_map(condition.object, pose);
    const TriangleMap map = read_triangle_map(cache_->map_file(condition.object, pose));
    const Object& object = cache_->object_of(condition);
    const MaterialSettings& material = cache_->material_of(condition);
    if (!light_)
        light_.emplace(cache_->protocol().light);
    if (!scene_ || scene_of_ != condition) {
        scene_.reset(); // the memory of one at a time
        scene_.emplace(object.mesh, material);
        scene_of_ = condition;
    }
    std::vector<std::uint8_t> covered(map.codes.size());
    for (std::size_t i = 0; i < covered.size(); ++i)
        covered[i] = map.codes[i] != 0;
    return bake_frame(*scene_, *light_, object.scene, cache_->angle_of(pose), covered,
                      bake_settings(quality, cache_->protocol().bake, material.kind), progress);
}

} // namespace overt
