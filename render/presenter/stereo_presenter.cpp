#include "render/presenter/stereo_presenter.h"

#include "render/presenter/field_pair.h"

namespace overt {

namespace {

/// What is there once on a screen is there in one field: a trigger in that which leads, the square for a
/// photodiode in that which has its corner.
DisplaySettings display_of_eye(const Protocol& protocol, Eye eye) {
    DisplaySettings display = display_of_field(protocol);
    display.frame_store_mb *= 0.5;
    const bool is_leading = eye == FieldPair::leading_eye(protocol.stereo);
    if (!is_leading)
        display.onset_trigger = 0;
    const bool is_right_corner =
        display.photodiode == PatchCorner::top_right || display.photodiode == PatchCorner::bottom_right;
    if (protocol.stereo.kind == StereoKind::mirrors ? is_right_corner == is_leading : !is_leading)
        display.photodiode = PatchCorner::none;
    return display;
}

} // namespace

StereoPresenter::StereoPresenter(const GlContext& context, DisplaySurface& surface, const FrameSource& frames,
                                 const Protocol& protocol)
    : leading_eye_(FieldPair::leading_eye(protocol.stereo)), analysed_eye_(protocol.tracker.analysed_eye()),
      fields_(std::make_unique<FieldPair>(context, surface, protocol)) {
    const auto presenter_of = [&](Eye eye) {
        return std::make_unique<PagePresenter>(context, fields_->of(eye), frames,
                                               screen_geometry_of(protocol), display_of_eye(protocol, eye),
                                               protocol.screens, slot_places(protocol), eye);
    };
    left_ = presenter_of(Eye::left);
    right_ = presenter_of(Eye::right);
}

StereoPresenter::~StereoPresenter() = default;

void StereoPresenter::load_slots(std::span<const PlacedStimulus> shown) {
    left_->load_slots(shown);
    right_->load_slots(shown);
}

void StereoPresenter::expect_slots(std::span<const PlacedStimulus> shown) noexcept {
    left_->expect_slots(shown);
    right_->expect_slots(shown);
}

void StereoPresenter::use_spare_time() noexcept {
    left_->use_spare_time();
    right_->use_spare_time();
}

FlipReport StereoPresenter::show(const Screen& screen) {
    following().show(screen);
    return leading().show(screen);
}

void StereoPresenter::put_beside_stimuli(const AnswerView* answers) {
    left_->put_beside_stimuli(answers);
    right_->put_beside_stimuli(answers);
}

void StereoPresenter::show_level(const LevelBar& bar) {
    following().show_level(bar);
    leading().show_level(bar);
}

void StereoPresenter::mark_stimuli(std::span<const StimulusMark> marks,
                                   std::span<const StimulusMark> of_other_eye) noexcept {
    of(analysed_eye_).mark_stimuli(marks);
    of(analysed_eye_ == Eye::left ? Eye::right : Eye::left).mark_stimuli(of_other_eye);
}

FlipReport StereoPresenter::flip_slots(std::span<const AnimationFrameIndex> frames) noexcept {
    following().flip_slots(frames);
    return leading().flip_slots(frames);
}

std::vector<std::byte> StereoPresenter::read_screen() const {
    return fields_->holds_screen() ? fields_->read_screen() : leading_presenter().read_canvas();
}

void StereoPresenter::veil(bool is_on) {
    left_->veil(is_on);
    right_->veil(is_on);
}

} // namespace overt
