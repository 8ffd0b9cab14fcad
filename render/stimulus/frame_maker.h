/// Makes the frames that the cache lacks.
#pragma once

#include <future>
#include <optional>

#include "render/bake/frame_baker.h"
#include "render/stimulus/map_maker.h"
#include "render/stimulus/stimulus_renderer.h"

namespace overt {

class FrameMaker {
  public:
    /// All must outlive the maker, which is used on the context's thread.
    FrameMaker(const GlContext& context, const StimulusCache& cache, MapMaker& maps)
        : context_(&context), cache_(&cache), maps_(&maps) {}

    /// Makes the frames of these stimuli that the cache lacks, of all pictures or of one, and puts them
    /// there. Throws InputError, GraphicsError, RecordError.
    void make_frames(std::span<const Stimulus> stimuli, const FrameQuality& quality, const Progress& progress,
                     std::optional<Pose> only = {});

    /// Adds up frames of stimuli whose light is a sum, where those of all parts are there and it is not.
    /// Throws InputError, RecordError.
    void add_up_what_is_there(std::span<const Stimulus> stimuli, const FrameQuality& quality);

    /// Traces one frame on all processors (see bake_frame()), drawing its map before if the cache lacks it;
    /// the cache does not get it. Of no stimulus whose light is a sum. Not complete if `progress` stopped it.
    /// What a stimulus needs is built when it comes up and kept until another does. Throws InputError,
    /// GraphicsError.
    SpectralFrame trace(const Stimulus& stimulus, const Pose& pose, const FrameQuality& quality,
                        const BakeProgress& progress);

  private:
    std::vector<Pose> missing_frames(const Stimulus& stimulus, const FrameQuality& quality,
                                     const std::optional<Pose>& only) const;
    /// Whether its frames are added up of others; live ones are drawn like all.
    bool is_sum(const Stimulus& stimulus, const FrameQuality& quality) const {
        return !quality.is_live() && !cache_->protocol().light_of(stimulus).sum.empty();
    }
    void draw_live_frame(const Stimulus& stimulus, const Pose& pose, const FrameQuality& quality,
                         std::future<void>& writing);

    const GlContext* context_;
    const StimulusCache* cache_;
    MapMaker* maps_;
    // What is traced, and its light: the memory of one at a time.
    std::optional<SpectralLight> light_;
    int light_of_ = -1;
    std::optional<BakeScene> scene_;
    int scene_object_ = -1, scene_material_ = -1;
    std::optional<PaintedSurface>
        painted_; ///< that the renderer draws, where the object's file says its look
    std::optional<StimulusRenderer> renderer_;
    // That the renderer is prepared for.
    int live_light_ = -1, live_material_ = -1, live_object_ = -1;
    glm::ivec2 live_size_px_{0};
};

} // namespace overt
