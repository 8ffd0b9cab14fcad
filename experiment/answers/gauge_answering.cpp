#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "experiment/answers/answer_kinds.h"

namespace overt {

namespace {

/// Beyond it a surface has hardly any picture.
constexpr double most_slant_deg = 89.0;
/// So many drags and presses can be taken back.
constexpr std::size_t most_undone = 256;

/// A circle that is leaned like a joystick: slant is how far, tilt where to. As a vector of slant in degrees
/// to the right and upwards, so that drags and arrows add to it alike in all directions.
class GaugeAnswering final : public Answering {
  public:
    explicit GaugeAnswering(const AnswerForm& form) : Answering(form), lean_(lean_of(form.start)) {}

    Effect take(const ObserverInput& input, const AnswerPlace&) noexcept override {
        using Kind = ObserverInput::Kind;
        switch (input.kind) {
        case Kind::key_down:
            if (input.key.view() == settings().undo_key)
                return undo();
            return lean_by_key(input.key.view());
        case Kind::pointer_down:
            if (input.button == 2)
                return Effect::none;
            if (input.button == 3)
                return has_value() ? Effect::accepted : Effect::none;
            remember();
            from_px_ = {input.right_px, input.down_px};
            before_drag_ = lean_;
            is_dragged_ = true;
            has_moved_ = false;
            return Effect::touched;
        case Kind::pointer_moved:
            return is_dragged_ ? drag_to(input) : Effect::none;
        case Kind::pointer_up:
            if (!is_dragged_ || input.button != 1)
                return Effect::none;
            is_dragged_ = false;
            if (!has_moved_) // a click moves nothing
                count_ -= std::min<std::size_t>(count_, 1);
            return Effect::touched;
        default:
            return Effect::none;
        }
    }
    /// It was moved, and not all of it was taken back: the place where it stood at first is no answer.
    bool has_value() const noexcept override { return count_ > 0 && (!is_dragged_ || has_moved_); }
    /// "34.500 120.250": slant and tilt in degrees.
    std::string value() const override {
        const Attitude now = *attitude();
        return fmt::format("{:.3f} {:.3f}", now.slant.value, now.tilt.value);
    }
    std::optional<double> number() const noexcept override { return attitude()->slant.value; }
    std::optional<Attitude> attitude() const noexcept override {
        const double tilt = to_degrees(Radians{std::atan2(lean_.y, lean_.x)}).value;
        return Attitude{{glm::length(lean_)}, {tilt < 0.0 ? tilt + 360.0 : tilt}};
    }
    void add_details(GivenAnswer& given) const override {
        given.gauge = GaugeAnswer{.probe = form_.probe,
                                  .point = form_.point,
                                  .start = form_.start,
                                  .set = *attitude(),
                                  .is_at_limit = glm::length(lean_) >= most_slant_deg - 1e-9};
    }
    bool points() const noexcept override { return true; }
    void draw(AnswerItem& item) const override { item.kind = AnswerItem::Kind::keys; }
    void offer(AnswerOffer& offer) const override {
        offer.attitude = attitude();
        offer.step = settings().key_step_deg;
        offer.slant_per_px_deg = settings().slant_per_px_deg;
    }

  private:
    static glm::dvec2 lean_of(const Attitude& attitude) {
        const double tilt = to_radians(attitude.tilt).value;
        return attitude.slant.value * glm::dvec2(std::cos(tilt), std::sin(tilt));
    }
    static glm::dvec2 within_limit(glm::dvec2 lean) noexcept {
        const double slant = glm::length(lean);
        return slant > most_slant_deg ? lean * (most_slant_deg / slant) : lean;
    }
    /// The oldest are forgotten; what cannot be taken back any more stays moved.
    void remember() noexcept {
        if (count_ == earlier_.size()) {
            std::move(earlier_.begin() + 2, earlier_.end(), earlier_.begin() + 1);
            --count_;
        }
        earlier_[count_++] = lean_;
    }
    Effect undo() noexcept {
        if (count_ == 0 || is_dragged_)
            return Effect::none;
        lean_ = earlier_[--count_];
        return Effect::changed;
    }
    Effect lean_by_key(std::string_view key) noexcept {
        const double step = settings().key_step_deg;
        const glm::dvec2 by = key == "right"  ? glm::dvec2(step, 0.0)
                              : key == "left" ? glm::dvec2(-step, 0.0)
                              : key == "up"   ? glm::dvec2(0.0, step)
                              : key == "down" ? glm::dvec2(0.0, -step)
                                              : glm::dvec2(0.0);
        if (by == glm::dvec2(0.0) || is_dragged_)
            return Effect::none;
        remember();
        lean_ = within_limit(lean_ + by);
        return Effect::changed;
    }
    Effect drag_to(const ObserverInput& input) noexcept {
        const glm::dvec2 by(input.right_px - from_px_.x, from_px_.y - input.down_px);
        has_moved_ = has_moved_ || by != glm::dvec2(0.0);
        lean_ = within_limit(before_drag_ + settings().slant_per_px_deg * by);
        return Effect::changed;
    }

    glm::dvec2 lean_; ///< slant in degrees, to the right and upwards
    glm::dvec2 from_px_{0.0}, before_drag_{0.0};
    bool is_dragged_ = false, has_moved_ = false;
    std::array<glm::dvec2, most_undone> earlier_{};
    std::size_t count_ = 0; ///< of these
};

} // namespace

std::unique_ptr<Answering> gauge_answering(const AnswerForm& form) {
    return std::make_unique<GaugeAnswering>(form);
}

} // namespace overt
