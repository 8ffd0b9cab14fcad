/// The frame store: all pages of the stimuli that a trial shows, ready as the display takes them, and
/// meanwhile those of the next trial.
#pragma once

#include <array>
#include <exception>
#include <optional>
#include <span>
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

/// Stimuli on the card, each once however many slots show it.
struct StoredStimuli {
    std::vector<Stimulus> stimuli;
    std::vector<std::vector<int>> page_of_frame; ///< of each; pages of all of them count on
    std::vector<int> first_page;                 ///< the same
    int pages = 0;
    std::optional<TextureArray> textures; ///< a layer for each page, maybe more

    /// The page of a frame of the stimulus with this index.
    int page_of(std::size_t stimulus, int frame) const noexcept {
        return page_of_frame[stimulus][static_cast<std::size_t>(frame)];
    }
};

/// Holds what two trials show at most. With the context current, on its thread.
class FrameStore {
  public:
    /// `context`, `source` and `encoder` must outlive the store. Pictures of `image_px` stand at `origin_px`
    /// of the screen, or at places whose columns are odd or even as its are: pairs of pixels lie alike in
    /// them. `budget_bytes`: what stimuli may take on the card, those of both trials together.
    FrameStore(const GlContext& context, const FrameSource& source, const DisplayEncoder& encoder,
               glm::ivec2 origin_px, glm::ivec2 image_px, std::size_t budget_bytes);
    ~FrameStore();

    /// What of the screen a page covers at `origin_px`.
    const ScreenPatch& patch() const { return patch_; }

    /// The stimuli to be shown now, each once: nothing to do if they were expected and have arrived, else
    /// waits for them. They stay until others are loaded. Throws GraphicsError, InputError, also what went
    /// wrong while they were expected.
    const StoredStimuli& load(std::span<const Stimulus> stimuli);
    const StoredStimuli& load(const Stimulus& stimulus) { return load({&stimulus, 1}); }

    /// The stimuli to be loaded next: begins to read them in the background, unless they are there already or
    /// do not fit into the budget beside those that are shown. Failures are kept for load().
    void expect(std::span<const Stimulus> stimuli) noexcept;
    void expect(const Stimulus& stimulus) noexcept { expect({&stimulus, 1}); }

    /// Hands over to the card what has been read of the expected stimuli, one page at most. To be called
    /// again and again where a few milliseconds matter to nobody. Failures are kept for load().
    void use_spare_time() noexcept;

  private:
    std::size_t page_bytes() const;
    int pages_of(std::span<const Stimulus> stimuli) const;
    bool fits_beside_current(int pages) const;
    StoredStimuli& spare() { return stored_[1 - current_]; }
    void begin(std::span<const Stimulus> stimuli, int threads);
    void forget_expected();
    bool is_current(std::span<const Stimulus> stimuli) const noexcept;
    bool is_expected(std::span<const Stimulus> stimuli) const noexcept;

    const GlContext* context_;
    const FrameSource* source_;
    const DisplayEncoder* encoder_;
    glm::ivec2 origin_px_, image_px_;
    std::size_t budget_bytes_;
    ScreenPatch patch_;
    std::optional<PageStaging> staging_; ///< from the first page on
    std::array<StoredStimuli, 2> stored_;
    std::size_t current_ = 0;
    bool is_loaded_ = false; ///< stored_[current_] can be shown
    /// What spare() holds or is about to hold.
    std::optional<std::vector<Stimulus>> expected_;
    std::optional<PageLoader> loader_; ///< while pages of it are missing
    std::exception_ptr failure_;
};

} // namespace overt
