#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/answers/answer_kinds.h"

namespace overt {

namespace {

/// A line without `step` moves by this share of its length.
constexpr double usual_move = 0.01;
/// So many moves at once by "page up", "page down" and the wheel with a step.
constexpr int coarse_moves = 10;

/// Without what binary fractions leave behind: 0.3 and not 0.30000000000000004.
std::string as_written(double number) { return fmt::format("{:.10g}", number + 0.0); }

/// Nothing stands on the scale until it is touched: by arrows the marker comes up in the middle, which says
/// nothing yet; a digit or a click is an answer at once. So the middle is chosen by who moves there only.
class ScaleAnswering final : public Answering {
  public:
    explicit ScaleAnswering(const AnswerForm& form) : Answering(form) {
        is_turned_ = (settings().direction == ScaleDirection::right_to_left) != (form.mapping == 1);
    }

    Effect take(const ObserverInput& input, const AnswerPlace& place) noexcept override {
        using Kind = ObserverInput::Kind;
        const bool by_keys = settings().with != AnsweredWith::mouse;
        switch (input.kind) {
        case Kind::key_down:
            return by_keys ? take_key(input.key.view()) : Effect::none;
        case Kind::dial:
            return by_keys ? move(static_cast<int>(std::lround(input.steps))) : Effect::none;
        case Kind::wheel:
            return by_keys ? Effect::none : move(static_cast<int>(std::lround(input.steps)));
        case Kind::pointer_down:
        case Kind::pointer_moved:
        case Kind::pointer_up:
            return settings().with == AnsweredWith::keys ? Effect::none : take_place(place, input.kind);
        default:
            return Effect::none;
        }
    }
    bool has_value() const noexcept override { return has_value_; }
    std::string value() const override {
        if (const std::optional<int> at = step_here(); at && !settings().labels.empty())
            return settings().labels[static_cast<std::size_t>(*at)];
        return as_written(*number());
    }
    std::optional<double> number() const noexcept override {
        if (!along_)
            return std::nullopt;
        // To the protocol's step, from the low end.
        const double grain =
            settings().steps ? span() / std::max(1, *settings().steps - 1) : settings().step.value_or(0.0);
        const double beyond = *along_ * span();
        return settings().low() + (grain > 0.0 ? std::round(beyond / grain) * grain : beyond);
    }
    void draw(AnswerItem& item) const override {
        item.kind = settings().steps ? AnswerItem::Kind::steps : AnswerItem::Kind::line;
        item.ends = settings().ends;
        if (is_turned_)
            std::ranges::reverse(item.ends);
        item.ticks = settings().ticks;
        item.is_right_to_left = is_turned_;
        for (int i = 0; i < settings().steps.value_or(0); ++i) {
            const int at = is_turned_ ? *settings().steps - 1 - i : i;
            const auto index = static_cast<std::size_t>(at);
            item.options.push_back(
                {.label = index < settings().labels.size() ? settings().labels[index] : std::string(),
                 .key = settings().with == AnsweredWith::mouse ? std::string() : settings().key_of_step(at),
                 .picture = {},
                 .is_chosen = step_here() == at});
        }
        if (!settings().steps && along_)
            item.marker = is_turned_ ? 1.0 - *along_ : *along_;
        if (settings().shows_value && along_)
            item.marker_label = as_written(*number());
    }

    void offer(AnswerOffer& offer) const override {
        offer.low = settings().low();
        offer.high = settings().high();
        offer.step = span() / moves();
        offer.is_turned = is_turned_;
        for (int i = 0; i < settings().steps.value_or(0); ++i) {
            const auto index = static_cast<std::size_t>(i);
            offer.numbers.push_back(settings().number_of_step(i));
            offer.values.push_back(index < settings().labels.size() ? settings().labels[index]
                                                                    : as_written(offer.numbers.back()));
            if (std::string key = settings().key_of_step(i); !key.empty())
                offer.keys.push_back(std::move(key));
        }
    }

  private:
    double span() const { return settings().high() - settings().low(); }
    int moves() const {
        if (settings().steps)
            return *settings().steps - 1;
        return std::max(
            1, static_cast<int>(std::lround(span() / settings().step.value_or(usual_move * span()))));
    }
    std::optional<int> step_here() const noexcept {
        return along_ && settings().steps ? std::optional(static_cast<int>(std::lround(*along_ * moves())))
                                          : std::nullopt;
    }

    Effect take_key(std::string_view key) noexcept {
        for (int i = 0; i < settings().steps.value_or(0); ++i)
            if (is_key_of_step(key, i))
                return set(moves() > 0 ? static_cast<double>(i) / moves() : 0.0);
        if (key == "right" || key == "left")
            return move(key == "right" ? 1 : -1);
        if (key == "page up" || key == "page down")
            return move(key == "page up" ? coarse_moves : -coarse_moves);
        if (key == "home" || key == "end")
            return set((key == "end") != is_turned_ ? 1.0 : 0.0);
        return Effect::none;
    }
    /// Without making a text.
    bool is_key_of_step(std::string_view key, int index) const noexcept {
        const std::vector<std::string>& keys = settings().keys;
        if (!keys.empty())
            return static_cast<std::size_t>(index) < keys.size() &&
                   keys[static_cast<std::size_t>(index)] == key;
        return *settings().steps <= 9 && key.size() == 1 && key.front() == static_cast<char>('1' + index);
    }

    Effect move(int to_the_right) noexcept {
        if (to_the_right == 0)
            return Effect::none;
        if (!along_) {
            along_ = moves() % 2 == 0 || !settings().steps ? 0.5 : 0.5 - 0.5 / moves();
            return Effect::touched;
        }
        const double by = static_cast<double>(is_turned_ ? -to_the_right : to_the_right) / moves();
        const double before = *along_;
        along_ = std::clamp(std::round((before + by) * moves()) / moves(), 0.0, 1.0);
        const bool has_moved = *along_ != before;
        has_value_ = has_value_ || has_moved;
        return has_moved ? Effect::changed : Effect::none;
    }
    Effect set(double along) noexcept {
        along_ = std::clamp(along, 0.0, 1.0);
        has_value_ = true;
        return Effect::chosen;
    }
    Effect take_place(const AnswerPlace& place, ObserverInput::Kind kind) noexcept {
        const bool is_up = kind == ObserverInput::Kind::pointer_up;
        if (place.along) {
            const double along = is_turned_ ? 1.0 - *place.along : *place.along;
            // Drawn along; what stands when the button is let go is the answer.
            const bool is_new = !along_ || *along_ != along || is_up;
            set(along);
            return is_up ? Effect::chosen : is_new ? Effect::changed : Effect::none;
        }
        if (is_up && place.option >= 0 && settings().steps && place.option < *settings().steps) {
            const int at = is_turned_ ? *settings().steps - 1 - place.option : place.option;
            return set(moves() > 0 ? static_cast<double>(at) / moves() : 0.0);
        }
        return Effect::none;
    }

    bool is_turned_ = false;      ///< the low end is at the right
    std::optional<double> along_; ///< from the low end, 0 … 1
    bool has_value_ = false;
};

} // namespace

std::unique_ptr<Answering> scale_answering(const AnswerForm& form) {
    return std::make_unique<ScaleAnswering>(form);
}

} // namespace overt
