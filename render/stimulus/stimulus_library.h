/// All stimuli of a protocol: has their frames and maps made where the cache lacks them, and gives the frames
/// to the presenter.
#pragma once

#include <map>
#include <mutex>
#include <utility>

#include "experiment/maps/light_pictures.h"
#include "render/presenter/frame_store.h"
#include "render/stimulus/frame_maker.h"

namespace overt {

class StimulusLibrary final : public FrameSource {
  public:
    /// `protocol` and `objects` must outlive the library. `cache`: see StimulusCache.
    StimulusLibrary(const GlContext& context, const Protocol& protocol, std::span<const Object> objects,
                    std::filesystem::path cache);

    StimulusLibrary(const StimulusLibrary&) = delete; // its parts know one another by their addresses

    const StimulusCache& cache() const { return cache_; }
    MapMaker& maps() { return maps_; }
    FrameMaker& frames() { return frames_; }

    /// For a session: finds the best quality of which the cache has all frames of all stimuli, and is content
    /// with no less than `least`. If there is none, previews and live frames are made now; what should be
    /// better is an InputError that says how to bake it. Checks the size of ready-made frames. Throws
    /// InputError, GraphicsError, RecordError.
    void prepare_frames(const Progress& progress, BakeQuality least);

    /// For a look at one stimulus, or at one of its animation frames: the best there is of the whole
    /// stimulus, or else a preview of what is looked at. Throws likewise.
    void prepare_frames(const Stimulus& stimulus, const Progress& progress,
                        std::optional<AnimationFrameIndex> only = {});

    /// Has page() give frames of this quality of all stimuli that are not ready-made. They have to be there.
    void take_frames(const FrameQuality& quality);

    /// The best quality of which the cache has every frame of every stimulus, no less than `least`.
    std::optional<FrameQuality> quality_of_session(BakeQuality least) const {
        return cache_.best_quality(cache_.rendered_stimuli(), least);
    }

    /// The frames that page() gives of a stimulus that is not ready-made.
    const FrameQuality& quality_of_frames(const Stimulus& stimulus) const;

    Stimulus in_slot(const PlacedStimulus& placed, Eye eye) const override {
        return protocol_->in_slot(placed, eye);
    }
    std::vector<int> page_of_frame(const Stimulus& stimulus) const override;
    /// Before the stimulus's background, opaque; where that is the display's own, with alpha.
    LinearImage page(const Stimulus& stimulus, int page) const override;
    const LinearImage& read_page(const Stimulus& stimulus, int page, LinearImage& room) const override;
    /// The file that a page is read from.
    std::filesystem::path page_file(const Stimulus& stimulus, int page) const;
    /// The page with the object alone, whatever is behind it: colours are multiplied by alpha, which is its
    /// coverage.
    LinearImage object_on_page(const Stimulus& stimulus, int page) const;
    /// The page as a screen shows it: over the display's background, opaque.
    LinearImage page_on_screen(const Stimulus& stimulus, int page) const;

    /// Where the pictures of a stimulus come from, in words.
    std::string source_of(const Stimulus& stimulus) const;
    /// Of everything that made its frames, the display's characterisation included; for ready-made ones, of
    /// the files' bytes.
    ContentHash made_from_hash(const Stimulus& stimulus) const;

    /// Of the pixels that are shown, with what makes them the display's light, and the poses; of ready-made
    /// frames, of the files' bytes. Empty while a frame is not there. Throws InputError.
    ContentHash frames_hash(const Stimulus& stimulus) const;

    /// Of live frames, what OpenGL said of the renderer that drew them; else empty.
    std::string renderer_of(const Stimulus& stimulus) const;

    /// Frames of the cache that were none, and were made anew by prepare_frames(): a sentence each.
    const std::vector<std::string>& remarks() const { return remarks_; }

    /// The file with the luminance of a stimulus in small pictures (light_pictures.h), one for each picture
    /// of its motion, from the cache. What is not there is made if `make` says so, which reads all frames of
    /// the stimulus. Nothing for what is not there, and for ready-made frames without alpha: what they show
    /// of the object is not known. Throws InputError, RecordError.
    std::optional<std::filesystem::path> light_file(const Stimulus& stimulus, bool make) const;

    /// The first frame on the display's background, for looking at (write_srgb_png), from the cache; made if
    /// it is not there. Throws likewise.
    std::filesystem::path first_frame_file(const Stimulus& stimulus) const;

  private:
    const LinearImage& read_object(const Stimulus& stimulus, int page, LinearImage& room) const;
    const LinearImage& background_of(const Stimulus& stimulus) const;
    ContentHash object_pixels_hash(const Stimulus& stimulus) const;
    ContentHash object_hash(const Stimulus& stimulus) const;
    LightPictures light_of(const Stimulus& stimulus) const;
    glm::ivec2 image_px(const Stimulus& stimulus) const;

    const Protocol* protocol_;
    StimulusCache cache_;
    MapMaker maps_;
    FrameMaker frames_;
    std::map<Stimulus, FrameQuality> qualities_; ///< of each stimulus's frames
    /// By background and view, once a page needed them; pages are read by several threads.
    mutable std::mutex backgrounds_mutex_;
    mutable std::map<std::pair<int, int>, LinearImage> backgrounds_;
    std::vector<std::string> remarks_;
};

} // namespace overt
