#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "experiment/answers/answer_kinds.h"

namespace overt {

namespace {

/// So many changes can be undone; of more, the last.
constexpr std::size_t most_changes_undone = 512;

/// What a slot shows is set from level to level. What stands there says something from the start: who finds
/// that it matches accepts it.
class MatchAnswering final : public Answering {
  public:
    explicit MatchAnswering(const AnswerForm& form)
        : Answering(form), keys_(settings().match_keys()), coarse_keys_(settings().match_coarse_keys()) {
        const std::vector<MatchLevels::Axis>& columns = form_.levels.axes;
        for (std::size_t i = 0; i < std::min(columns.size(), axes_.size()); ++i) {
            axes_[i].count = static_cast<int>(columns[i].values.size());
            axes_[i].at = columns[i].start;
        }
        before_.reserve(most_changes_undone);
    }

    Effect take(const ObserverInput& input, const AnswerPlace&) noexcept override {
        using Kind = ObserverInput::Kind;
        const bool by_keys = settings().with != AnsweredWith::mouse;
        switch (input.kind) {
        case Kind::key_down:
            return by_keys ? take_key(input.key.view()) : Effect::none;
        case Kind::dial:
            return by_keys ? move(0, static_cast<int>(std::lround(input.steps))) : Effect::none;
        case Kind::tilt:
            return by_keys ? move(1, static_cast<int>(std::lround(input.steps))) : Effect::none;
        case Kind::wheel:
            return settings().with != AnsweredWith::keys ? move(0, static_cast<int>(std::lround(input.steps)))
                                                         : Effect::none;
        default:
            return Effect::none;
        }
    }
    bool has_value() const noexcept override { return true; }
    /// The numbers, with a blank between them.
    std::string value() const override {
        std::string text;
        for (std::size_t i = 0; i < form_.levels.axes.size(); ++i)
            text += fmt::format("{}{:.10g}", text.empty() ? "" : " ", value_of(i, axes_[i].at));
        return text;
    }
    /// Of the first column.
    std::optional<double> number() const noexcept override {
        return form_.levels.axes.empty() ? std::nullopt : std::optional(value_of(0, axes_[0].at));
    }
    std::optional<int> level() const noexcept override {
        return form_.levels.axes.empty() ? std::nullopt
                                         : std::optional(form_.levels.level_of(axes_[0].at, axes_[1].at));
    }
    void draw(AnswerItem& item) const override { item.kind = AnswerItem::Kind::keys; }

    void offer(AnswerOffer& offer) const override {
        const auto key = [](const std::vector<std::string>& keys, std::size_t i) {
            return i < keys.size() ? keys[i] : std::string();
        };
        for (std::size_t i = 0; i < form_.levels.axes.size(); ++i) {
            OfferedAxis& axis = offer.axes.emplace_back();
            axis.values = form_.levels.axes[i].values;
            axis.start = axes_[i].at;
            axis.reference = form_.levels.axes[i].reference;
            axis.coarse = settings().coarse_steps;
            if (settings().with == AnsweredWith::mouse)
                continue;
            axis.less = key(keys_, 2 * i);
            axis.more = key(keys_, 2 * i + 1);
            axis.much_less = key(coarse_keys_, 2 * i);
            axis.much_more = key(coarse_keys_, 2 * i + 1);
        }
    }

    void add_details(GivenAnswer& given) const override {
        given.slot = form_.levels.slot;
        for (std::size_t i = 0; i < form_.levels.axes.size(); ++i) {
            const MatchLevels::Axis& column = form_.levels.axes[i];
            const Axis& axis = axes_[i];
            given.settings.push_back({.along = column.along,
                                      .start = value_of(i, column.start),
                                      .final = value_of(i, axis.at),
                                      .low = column.values.front(),
                                      .high = column.values.back(),
                                      .reference = column.reference,
                                      .changes = axis.changes,
                                      .reversals = axis.reversals,
                                      .stopped_low = axis.stopped_low,
                                      .stopped_high = axis.stopped_high});
        }
        for (std::size_t level = 0; level < form_.levels.stimuli.size(); ++level) {
            MatchLevel& of = given.levels.emplace_back();
            of.level = static_cast<int>(level);
            of.stimulus = form_.levels.stimuli[level];
            const std::size_t across = form_.levels.axes.size() > 1 ? form_.levels.axes[1].values.size() : 1;
            of.values.push_back(form_.levels.axes[0].values[level / across]);
            if (form_.levels.axes.size() > 1)
                of.values.push_back(form_.levels.axes[1].values[level % across]);
        }
    }

  private:
    struct Axis {
        int at = 0, count = 1; ///< index of its value, of so many
        int changes = 0, reversals = 0, stopped_low = 0, stopped_high = 0;
        int direction = 0; ///< of the last change: -1, 1; 0: there was none
    };
    struct Place {
        std::size_t axis = 0;
        int at = 0;
    };
    double value_of(std::size_t axis, int at) const noexcept {
        return form_.levels.axes[axis].values[static_cast<std::size_t>(at)];
    }

    Effect take_key(std::string_view key) noexcept {
        if (key == settings().undo_key)
            return undo();
        for (std::size_t i = 0; i < keys_.size(); ++i)
            if (keys_[i] == key)
                return move(i / 2, i % 2 == 0 ? -1 : 1);
        for (std::size_t i = 0; i < coarse_keys_.size(); ++i)
            if (coarse_keys_[i] == key)
                return move(i / 2, i % 2 == 0 ? -settings().coarse_steps : settings().coarse_steps);
        return Effect::none;
    }

    Effect move(std::size_t of, int by) noexcept {
        if (by == 0 || of >= form_.levels.axes.size())
            return Effect::none;
        Axis& axis = axes_[of];
        const int wanted = axis.at + by;
        axis.stopped_low += wanted < 0 ? 1 : 0;
        axis.stopped_high += wanted >= axis.count ? 1 : 0;
        const int reached = std::clamp(wanted, 0, axis.count - 1);
        if (reached == axis.at)
            return Effect::none;
        if (before_.size() == before_.capacity())
            before_.erase(before_.begin());
        before_.push_back({of, axis.at});
        go_to(axis, reached);
        return Effect::changed;
    }
    Effect undo() noexcept {
        if (before_.empty())
            return Effect::none;
        const Place last = before_.back();
        before_.pop_back();
        go_to(axes_[last.axis], last.at);
        return Effect::changed;
    }
    static void go_to(Axis& axis, int at) noexcept {
        const int direction = at > axis.at ? 1 : -1;
        ++axis.changes;
        axis.reversals += axis.direction == -direction ? 1 : 0;
        axis.direction = direction;
        axis.at = at;
    }

    std::vector<std::string> keys_, coarse_keys_;
    std::array<Axis, 2> axes_{};
    std::vector<Place> before_; ///< where each change began that was not undone
};

} // namespace

std::unique_ptr<Answering> match_answering(const AnswerForm& form) {
    return std::make_unique<MatchAnswering>(form);
}

} // namespace overt
