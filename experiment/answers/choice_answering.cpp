#include <algorithm>

#include "experiment/answers/answer_kinds.h"

namespace overt {

namespace {

/// Choices that keys or clicks choose. The keys stay where they are, and the choices go round over them.
class ChoiceAnswering final : public Answering {
  public:
    ChoiceAnswering(const AnswerForm& form, bool is_seen) : Answering(form), is_seen_(is_seen) {}

    Effect take(const ObserverInput& input, const AnswerPlace& place) noexcept override {
        using Kind = ObserverInput::Kind;
        if (input.kind == Kind::key_down && settings().with != AnsweredWith::mouse) {
            const auto key = std::ranges::find(settings().keys, input.key.view());
            return key == settings().keys.end() ? Effect::none
                                                : choose(static_cast<int>(key - settings().keys.begin()));
        }
        if (settings().with == AnsweredWith::keys)
            return Effect::none;
        // A click is down and up on the same choice.
        if (input.kind == Kind::pointer_down)
            down_on_ = place.option;
        else if (input.kind == Kind::pointer_up && place.option >= 0 && place.option == down_on_)
            return choose(place.option);
        return Effect::none;
    }
    bool has_value() const noexcept override { return shown_ >= 0; }
    std::string value() const override { return values()[written(shown_)]; }
    void draw(AnswerItem& item) const override {
        item.kind = is_seen_ ? AnswerItem::Kind::choice : AnswerItem::Kind::keys;
        for (std::size_t i = 0; is_seen_ && i < values().size(); ++i) {
            const bool has_key = settings().with != AnsweredWith::mouse && i < settings().keys.size();
            item.options.push_back({.label = form_.labels[written(static_cast<int>(i))],
                                    .key = has_key ? settings().keys[i] : std::string(),
                                    .picture = {},
                                    .is_chosen = shown_ == static_cast<int>(i)});
        }
    }

    void offer(AnswerOffer& offer) const override {
        for (std::size_t i = 0; i < values().size(); ++i)
            offer.values.push_back(values()[written(static_cast<int>(i))]);
        offer.keys = settings().keys;
    }

  private:
    /// A key without choices means itself.
    const std::vector<std::string>& values() const {
        return settings().is_choice() ? settings().choices : settings().keys;
    }
    std::size_t written(int shown) const {
        return (static_cast<std::size_t>(shown) + static_cast<std::size_t>(form_.mapping)) % values().size();
    }
    Effect choose(int shown) noexcept {
        if (shown >= static_cast<int>(values().size()))
            return Effect::none;
        shown_ = shown;
        return Effect::chosen;
    }

    bool is_seen_;
    int shown_ = -1;   ///< which of them was chosen, as they are shown
    int down_on_ = -1; ///< the mouse's button went down on this one
};

} // namespace

std::unique_ptr<Answering> choice_answering(const AnswerForm& form) {
    return std::make_unique<ChoiceAnswering>(form, true);
}

std::unique_ptr<Answering> key_answering(const AnswerForm& form) {
    return std::make_unique<ChoiceAnswering>(form, false);
}

} // namespace overt
