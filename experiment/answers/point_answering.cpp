#include <algorithm>

#include <fmt/format.h>

#include "experiment/answers/answer_kinds.h"

namespace overt {

namespace {

/// Where the mouse's left button went down. Which place of the object that is depends on the frame that was
/// lit, which the record tells: it is looked up from there.
class PointAnswering final : public Answering {
  public:
    using Answering::Answering;

    Effect take(const ObserverInput& input, const AnswerPlace&) noexcept override {
        if (input.kind != ObserverInput::Kind::pointer_down || input.button != 1)
            return Effect::none;
        right_px_ = input.right_px;
        down_px_ = input.down_px;
        has_pointed_ = true;
        return Effect::chosen;
    }
    bool has_value() const noexcept override { return has_pointed_; }
    /// As read_pointed_px() takes it apart.
    std::string value() const override { return fmt::format("{:.3f} {:.3f}", right_px_, down_px_); }
    bool points() const noexcept override { return true; }
    void draw(AnswerItem& item) const override { item.kind = AnswerItem::Kind::keys; }
    void offer(AnswerOffer&) const override {}

  private:
    double right_px_ = 0.0, down_px_ = 0.0;
    bool has_pointed_ = false;
};

/// A key says when: where gaze was then, or the fixation before it, the record tells.
class GazePointAnswering final : public Answering {
  public:
    using Answering::Answering;

    Effect take(const ObserverInput& input, const AnswerPlace&) noexcept override {
        if (input.kind != ObserverInput::Kind::key_down ||
            std::ranges::find(settings().keys, input.key.view()) == settings().keys.end())
            return Effect::none;
        has_pointed_ = true;
        return Effect::chosen;
    }
    bool has_value() const noexcept override { return has_pointed_; }
    std::string value() const override { return std::string(name_of(settings().by)); }
    void draw(AnswerItem& item) const override { item.kind = AnswerItem::Kind::keys; }
    void offer(AnswerOffer& offer) const override { offer.keys = settings().keys; }

  private:
    bool has_pointed_ = false;
};

} // namespace

std::unique_ptr<Answering> point_answering(const AnswerForm& form) {
    if (form.settings->by != PointedBy::mouse)
        return std::make_unique<GazePointAnswering>(form);
    return std::make_unique<PointAnswering>(form);
}

} // namespace overt
