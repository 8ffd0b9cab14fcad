/// The frame store: all pages of the stimuli that a trial shows, ready as the display takes them, and
/// meanwhile those of the next trial.
#pragma once

#include <array>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "experiment/gaze.h"
#include "experiment/screen_geometry.h"
#include "experiment/stimulus/frame_memory.h"
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
    /// The stimulus whose pages a slot shows to an eye: where pictures depend on the size of the slot, or on
    /// the eye, one that says so.
    virtual Stimulus in_slot(const PlacedStimulus& placed, Eye /*eye*/) const { return placed.stimulus; }
    /// The same for those who read many: put into `room`, whose memory is used again, or the source's own
    /// picture if it keeps one.
    virtual const LinearImage& read_page(const Stimulus& stimulus, int page, LinearImage& room) const {
        return room = this->page(stimulus, page);
    }
};

/// A stimulus as slots of one size show it.
struct SlotPicture {
    Stimulus stimulus; ///< FrameSource::in_slot
    int slot = 0;      ///< one of them
};

/// Stimuli on the card, each once however many slots of one size show it.
struct StoredStimuli {
    std::vector<SlotPicture> pictures;
    std::vector<std::vector<int>> page_of_frame; ///< of each; pages of all of them count on
    std::vector<int> first_page;                 ///< the same
    int pages = 0;
    PageTurns turns;                      ///< in which they come to layers; they go round where not all fit
    std::optional<TextureArray> textures; ///< of so many layers, maybe more

    /// The page of a frame of the picture with this index.
    int page_of(std::size_t stimulus, int frame) const noexcept {
        return page_of_frame[stimulus][static_cast<std::size_t>(frame)];
    }
};

/// Holds what two trials show at most. With the context current, on its thread.
///
/// One stimulus alone may have more pages than there is room for. Then those that are shown next are kept, in
/// the order of its frames round after round; meanwhile threads read on, and each page that was shown makes
/// room for one.
class FrameStore {
  public:
    /// `context`, `source` and `encoder` must outlive the store. `slots`: where pictures stand on the screen,
    /// at least one; all columns are odd, or all even, so that pairs of pixels lie alike in pictures of one
    /// size. `budget_bytes`: what stimuli may take on the card, those of both trials together; each page
    /// takes what the largest slot needs. `eye`: whose pictures the source is asked for.
    FrameStore(const GlContext& context, const FrameSource& source, const DisplayEncoder& encoder,
               std::vector<ImageBox> slots, std::size_t budget_bytes, Eye eye = Eye::left);
    ~FrameStore();

    /// What of the screen a page covers in a slot.
    const ScreenPatch& patch(int slot = 0) const { return patches_.at(static_cast<std::size_t>(slot)); }
    /// Room for each page: the largest patch, in columns and in rows.
    glm::ivec2 layer_px() const { return layer_px_; }

    /// The stimuli to be shown now: nothing to do if they were expected and have arrived, else waits for
    /// them. They stay until others are loaded. Throws GraphicsError, InputError, also what went wrong while
    /// they were expected.
    const StoredStimuli& load(std::span<const PlacedStimulus> shown);
    const StoredStimuli& load(const Stimulus& stimulus) {
        const PlacedStimulus only{stimulus};
        return load({&only, 1});
    }

    /// The stimuli to be loaded next: begins to read them in the background, unless they are there already or
    /// do not fit into the budget beside those that are shown. Failures are kept for load().
    void expect(std::span<const PlacedStimulus> shown) noexcept;
    void expect(const Stimulus& stimulus) noexcept {
        const PlacedStimulus only{stimulus};
        expect({&only, 1});
    }

    /// The layer of what is loaded that has a page. Of a stimulus that comes while it is shown, those shown
    /// before are let go, and a page that is not there yet is waited for. Throws what reading it threw.
    int layer_of(int page);
    /// To be called after each refresh: hands over to the card one page at most that is shown soon.
    void stream_on() noexcept;
    /// What is loaded is to be shown from its begin on.
    void rewind();

    /// Which of StoredStimuli::pictures a slot shows; `stored` has it.
    std::size_t picture_of(const StoredStimuli& stored, const PlacedStimulus& placed) const;

    /// Hands over to the card what has been read of the expected stimuli, one page at most. To be called
    /// again and again where a few milliseconds matter to nobody. Failures are kept for load().
    void use_spare_time() noexcept;

  private:
    std::vector<SlotPicture> pictures_of(std::span<const PlacedStimulus> shown) const;
    bool is_same(const SlotPicture& a, const SlotPicture& b) const noexcept;
    bool are_same(std::span<const SlotPicture> a, std::span<const SlotPicture> b) const noexcept;
    std::size_t page_bytes() const;
    int pages_of(std::span<const SlotPicture> pictures) const;
    bool fits_beside_current(int pages) const;
    StoredStimuli& spare() { return stored_[1 - current_]; }
    void begin(std::span<const SlotPicture> pictures, int threads);
    /// Throws InputError if there is no room for them.
    PageTurns turns_of(const StoredStimuli& stored) const;
    std::unique_ptr<PageLoader> loader_of(const StoredStimuli& stored, int threads,
                                          std::int64_t first_turn = 0);
    TextureArray& current_textures() { return *stored_[current_].textures; }
    void stream_from(std::int64_t turn);
    void forget_expected();
    bool is_current(std::span<const SlotPicture> pictures) const noexcept;
    bool is_expected(std::span<const SlotPicture> pictures) const noexcept;

    const GlContext* context_;
    const FrameSource* source_;
    Eye eye_; ///< whose pictures it is asked for
    const DisplayEncoder* encoder_;
    std::vector<ImageBox> slots_;
    std::size_t budget_bytes_;
    std::vector<ScreenPatch> patches_; ///< by slot
    glm::ivec2 layer_px_{0};
    std::optional<PageStaging> staging_; ///< from the first page on
    std::array<StoredStimuli, 2> stored_;
    std::size_t current_ = 0;
    bool is_loaded_ = false; ///< stored_[current_] can be shown
    /// What spare() holds or is about to hold.
    std::optional<std::vector<SlotPicture>> expected_;
    std::unique_ptr<PageLoader> loader_; ///< while pages of it are missing; else null
    std::exception_ptr failure_;
    std::unique_ptr<PageLoader> stream_; ///< of what is loaded, if that goes round; else null
};

} // namespace overt
