/// Two presenters as one: each draws what an eye sees into its field, and both are shown with the same
/// refresh.
#pragma once

#include <memory>

#include "experiment/protocol/protocol.h"
#include "render/presenter/page_presenter.h"

namespace overt {

class FieldPair;

class StereoPresenter final : public Presenter {
  public:
    /// Of a protocol with [stereo]. `frames` gives each eye's pictures (FrameSource::in_slot). All references
    /// must outlive the presenter. Throws as PagePresenter does.
    StereoPresenter(const GlContext& context, DisplaySurface& surface, const FrameSource& frames,
                    const Protocol& protocol);
    ~StereoPresenter() override;

    /// What draws an eye's field. One that is shown alone is seen beside what the other eye had before, if it
    /// is leading(); else with the leading one's next.
    PagePresenter& of(Eye eye) { return eye == Eye::left ? *left_ : *right_; }

    /// What draws the field in which the screen's messages begin, and shows both.
    PagePresenter& leading() { return of(leading_eye_); }

    /// The bytes of the whole screen as they go to the display, as PagePresenter::read_canvas() has them;
    /// through shutters, those of the leading eye.
    std::vector<std::byte> read_screen() const;

    DisplayTiming timing() const override { return leading_presenter().timing(); }
    void load_slots(std::span<const PlacedStimulus> shown) override;
    void expect_slots(std::span<const PlacedStimulus> shown) noexcept override;
    void use_spare_time() noexcept override;
    FlipReport show(const Screen& screen) override;
    void put_beside_stimuli(const AnswerView* answers) override;
    /// From the middle of a field: see in_field().
    AnswerPlace place_in_answers(double right_px, double down_px) const noexcept override {
        return leading_presenter().place_in_answers(right_px, down_px);
    }
    void show_level(const LevelBar& bar) override;
    using Presenter::mark_stimuli;
    void mark_stimuli(std::span<const StimulusMark> marks,
                      std::span<const StimulusMark> of_other_eye) noexcept override;
    FlipReport flip_slots(std::span<const AnimationFrameIndex> frames) noexcept override;
    void raise_with_next_flip(std::uint16_t outputs, double pulse_ms) noexcept override {
        leading().raise_with_next_flip(outputs, pulse_ms);
    }
    void veil(bool is_on) override;
    std::optional<SwapModes> take_swap_modes() noexcept override { return leading().take_swap_modes(); }
    bool closed() const noexcept override { return leading_presenter().closed(); }
    std::string why_closed() const override { return leading_presenter().why_closed(); }

  private:
    const PagePresenter& leading_presenter() const { return leading_eye_ == Eye::left ? *left_ : *right_; }
    PagePresenter& following() { return of(leading_eye_ == Eye::left ? Eye::right : Eye::left); }

    Eye leading_eye_, analysed_eye_;
    std::unique_ptr<FieldPair> fields_;
    std::unique_ptr<PagePresenter> left_, right_;
};

} // namespace overt
