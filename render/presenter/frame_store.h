/// The frame store: all pages of the stimulus that is shown, ready as the display takes them, and meanwhile
/// those of the next.
#pragma once

#include <array>
#include <exception>
#include <optional>
#include <vector>

#include "experiment/trial.h"
#include "render/image/linear_image.h"
#include "render/presenter/page_loader.h"
#include "render/signal/display_encoder.h"

namespace overt {

/// Where frames come from.
class FrameSource {
  public:
    virtual ~FrameSource() = default;
    /// Which page of the frame store shows each animation frame; frames that look alike share one. Pages
    /// count from 0.
    virtual std::vector<int> page_of_frame(const Stimulus& stimulus) const = 0;
    /// The picture for one page. May be called from several threads at once. Throws InputError.
    virtual LinearImage page(const Stimulus& stimulus, int page) const = 0;
    /// The same for those who read many: put into `room`, whose memory is used again, or the source's own
    /// picture if it keeps one.
    virtual const LinearImage& read_page(const Stimulus& stimulus, int page, LinearImage& room) const {
        return room = this->page(stimulus, page);
    }
};

/// A stimulus on the card.
struct StoredStimulus {
    Stimulus stimulus;
    std::vector<int> page_of_frame;
    int pages = 0;
    std::optional<TextureArray> textures; ///< a layer for each page, maybe more
};

/// Holds two stimuli at most. With the context current, on its thread.
class FrameStore {
  public:
    /// `context`, `source` and `encoder` must outlive the store. Pictures of `image_px` stand at `origin_px`
    /// of the screen. `budget_bytes`: what stimuli may take on the card, both together.
    FrameStore(const GlContext& context, const FrameSource& source, const DisplayEncoder& encoder,
               glm::ivec2 origin_px, glm::ivec2 image_px, std::size_t budget_bytes);
    ~FrameStore();

    /// What of the screen a page covers.
    const ScreenPatch& patch() const { return patch_; }

    /// The stimulus to be shown now: nothing to do if it was expected and has arrived, else waits for it. It
    /// stays until another is loaded. Throws GraphicsError, InputError, also what went wrong while it was
    /// expected.
    const StoredStimulus& load(const Stimulus& stimulus);

    /// The stimulus to be loaded next: begins to read it in the background, unless it is there already or
    /// both do not fit into the budget. Failures are kept for load().
    void expect(const Stimulus& stimulus) noexcept;

    /// Hands over to the card what has been read of the expected stimulus, one page at most. To be called
    /// again and again where a few milliseconds matter to nobody. Failures are kept for load().
    void use_spare_time() noexcept;

  private:
    std::size_t page_bytes() const;
    int pages_of(const Stimulus& stimulus) const;
    bool fits_beside_current(int pages) const;
    StoredStimulus& spare() { return stimuli_[1 - current_]; }
    void begin(const Stimulus& stimulus, int threads);
    void forget_expected();

    const GlContext* context_;
    const FrameSource* source_;
    const DisplayEncoder* encoder_;
    glm::ivec2 origin_px_, image_px_;
    std::size_t budget_bytes_;
    ScreenPatch patch_;
    std::optional<PageStaging> staging_; ///< from the first page on
    std::array<StoredStimulus, 2> stimuli_;
    std::size_t current_ = 0;
    bool is_loaded_ = false; ///< stimuli_[current_] can be shown
    /// Which stimulus spare() holds or is about to hold.
    std::optional<Stimulus> expected_;
    std::optional<PageLoader> loader_; ///< while pages of it are missing
    std::exception_ptr failure_;
};

} // namespace overt
