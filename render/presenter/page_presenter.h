/// The presenter: a frame store of ready-encoded pages, and a canvas that is what the display shows.
#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "experiment/ports/presenter.h"
#include "experiment/screen_geometry.h"
#include "experiment/stimulus/gaze_tags.h"
#include "experiment/stimulus/photodiode_patch.h"
#include "render/image/linear_image.h"
#include "render/presenter/answer_drawing.h"
#include "render/presenter/frame_store.h"
#include "render/signal/display_encoder.h"
#include "render/signal/mark_pass.h"
#include "render/signal/signal_pass.h"
#include "render/signal/t_lock.h"
#include "render/vblank/display_surface.h"

namespace overt {

/// Why a presenter counts as closed after close_on(). Stands in records.
inline constexpr std::string_view interrupted_reason = "interrupted by a signal";

class PagePresenter final : public Presenter {
  public:
    /// All references must outlive the presenter. `slots`: where each slot's image stands, all in even or all
    /// in odd columns; none: there is one, where `geometry` has the image. `eye`: whose pictures `frames` is
    /// asked for. Throws GraphicsError, also if the display's framebuffer has other bits per channel than the
    /// output mode sends.
    PagePresenter(const GlContext& context, DisplaySurface& surface, const FrameSource& frames,
                  const ScreenGeometry& geometry, const DisplaySettings& display, ScreenSettings screens,
                  std::vector<ImageBox> slots = {}, Eye eye = Eye::left);

    DisplayTiming timing() const override { return surface_->timing(); }
    void load_slots(std::span<const PlacedStimulus> shown) override;
    void expect_slots(std::span<const PlacedStimulus> shown) noexcept override;
    void use_spare_time() noexcept override { store_.use_spare_time(); }
    FlipReport show(const Screen& screen) override;
    void put_beside_stimuli(const AnswerView* answers) override;
    AnswerPlace place_in_answers(double right_px, double down_px) const noexcept override {
        return place_among(is_stimulus_on_canvas_ ? beside_.targets : targets_,
                           0.5 * glm::dvec2(geometry_.screen_px) + glm::dvec2(right_px, down_px));
    }
    void show_level(const LevelBar& bar) override;
    using Presenter::mark_stimuli;
    void mark_stimuli(std::span<const StimulusMark> marks,
                      std::span<const StimulusMark> of_other_eye) noexcept override;
    FlipReport flip_slots(std::span<const AnimationFrameIndex> frames) noexcept override;
    void raise_with_next_flip(std::uint16_t outputs, double pulse_ms) noexcept override {
        if (has_t_lock(display_.output))
            send_with_next_flip(t_lock::outputs_row, t_lock::pulse(outputs, 0.0, pulse_ms));
    }
    void veil(bool is_on) override;
    std::optional<SwapModes> take_swap_modes() noexcept override { return surface_->take_swap_modes(); }
    bool closed() const noexcept override {
        return surface_->closed() || is_interrupted() || !failure_.empty();
    }
    std::string why_closed() const override;

    /// Counts as closed once this is set, by whatever thread or signal handler. It must outlive the
    /// presenter.
    void close_on(const std::atomic<bool>& flag) noexcept { interrupted_ = &flag; }

    /// Sends a message to a Display++ in this row with the next refresh that flip() or show() lights, and
    /// with that one only; what the message asks for happens at the refresh after it. Only in the modes with
    /// T-Lock.
    void send_with_next_flip(int row, const t_lock::Packet& packet) noexcept;

    /// The bytes of the screen as they go to the display, read back from where it takes them: top row first,
    /// four to a pixel, red first, or words of ten bits per channel in native_10bit.
    std::vector<std::byte> read_canvas() const;

    /// Draws a page of what is loaded, in the place of the first, as flip() does, without showing it, and
    /// reads it.
    std::vector<std::byte> read_page(int page);

    /// Pages of all that is loaded.
    int pages() const { return loaded_ ? loaded_->pages : 0; }

  private:
    bool is_interrupted() const noexcept { return interrupted_ && interrupted_->load(); }
    const Framebuffer& canvas() const { return signal_ ? *signal_ : picture_; }
    void check_depth() const;
    void clear_picture(bool for_stimulus = false) noexcept;
    /// A loaded stimulus in its slot.
    struct InSlot {
        std::size_t picture = 0;   ///< of the stored ones
        ScreenPatch patch;         ///< what its pages cover
        int page_on_canvas = -1;   ///< -1: the background, or another screen
        int last_page = -1;        ///< that was on the canvas; -1: none was yet
        std::int64_t last_lit = 0; ///< how many pages had been put on the canvas then
        int frame_on_canvas = -1;
        bool has_marks = false; ///< on the canvas
    };
    /// Makes what is loaded of a page the source of copies; false if it could not be read, which closes the
    /// presenter.
    bool attach_page(int page) noexcept;
    void put_page(InSlot& slot, int page) noexcept;
    void put_marks(InSlot& slot) noexcept;
    /// A slot that nothing was lit in comes up with what is shown at this index.
    bool comes_up(std::size_t index) const noexcept;
    /// Of what is loaded for the same slot, what was lit there last.
    const InSlot& lit_last_with(std::size_t index) const;
    /// Noise, or squares of what was shown last, in the slots of what is loaded.
    void put_masks(const Screen& screen);
    void put_scrambled(const InSlot& slot, const ImageBox& at, const Screen& screen, int place);
    void check_place(std::size_t slot) const;
    void put_tags();
    /// A picture at a place of the screen, and what its encoding changes around it.
    Framebuffer encoded(const LinearImage& picture, glm::ivec2 origin) const;
    void put_on(const Framebuffer& target, const LinearImage& picture, glm::ivec2 origin);
    void make_patch();
    void put_patch(bool white) noexcept;
    void compose() noexcept;
    FlipReport present() noexcept;
    void put_row(int row, int first_px, std::span<const SignalPixel> pixels) noexcept;
    void put_messages() noexcept;

    const GlContext* context_;
    DisplaySurface* surface_;
    ScreenGeometry geometry_;
    DisplaySettings display_;
    ScreenSettings screens_;
    DisplayEncoder encoder_;
    Framebuffer background_;
    // What is shown, as the encoder writes it; where the encoder leaves the last step, what becomes of it.
    Framebuffer picture_;
    std::optional<SignalPass> last_step_;
    std::optional<Framebuffer> signal_;
    // In the place of the canvas while that is veiled: black, also as a signal.
    std::optional<Framebuffer> veil_;
    FrameStore store_;
    Framebuffer page_target_;
    AnswerPictures answer_pictures_;
    std::vector<AnswerTarget> targets_; ///< of the answers that are shown
    /// What stands around stimuli, if answers are given there: the background with them on it.
    struct Beside {
        std::optional<Framebuffer> picture;
        std::vector<AnswerTarget> targets;
        bool shows_pointer = false;
    };
    Beside beside_;
    const Framebuffer& around_stimuli() const { return beside_.picture ? *beside_.picture : background_; }
    // What is drawn over stimuli.
    std::optional<MarkPass> mark_pass_; ///< once there is any
    std::array<StimulusMark, most_marks> marks_{};
    std::size_t mark_count_ = 0;
    bool are_marks_new_ = false; ///< since the last flip
    std::vector<ImageBox> slots_;
    const StoredStimuli* loaded_ = nullptr; ///< null: nothing
    std::vector<PlacedStimulus> shown_;     ///< what is loaded
    std::vector<InSlot> in_slots_;          ///< the same
    bool is_stimulus_on_canvas_ = false;    ///< else another screen
    // Messages to the display.
    struct Message {
        int row;
        t_lock::PacketRow pixels;
    };
    std::array<std::optional<Message>, 2> messages_;
    bool rows_are_dirty_ = false;
    t_lock::ColourTableRow colour_table_row_{};
    t_lock::Packet onset_packet_;
    int outputs_ = 0; ///< of a VPixx device, with the next flip
    // The square for a photodiode.
    struct Patch {
        PatchPlace place;
        Framebuffer black, white;
    };
    std::optional<Patch> patch_;
    bool patch_is_white_ = false;
    std::int64_t refreshes_ = 0; ///< presented so far
    std::int64_t pages_put_ = 0; ///< on the canvas so far
    const std::atomic<bool>* interrupted_ = nullptr;
    std::string failure_; ///< of a frame that could not be read while it was shown
};

} // namespace overt
