#include "devices/simulated/simulated_keys.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "experiment/ports/recorded_key_press.h"

namespace overt {

namespace {

constexpr SessionDuration key_held = std::chrono::milliseconds(70);
constexpr SessionDuration between_keys = std::chrono::milliseconds(120);
constexpr SessionDuration before_accepting = std::chrono::milliseconds(300);
/// A press that comes too early comes so soon after the step before began.
constexpr SessionDuration early_after = std::chrono::milliseconds(20);

} // namespace

std::optional<ObserverInput> SimulatedKeys::release_due(const std::vector<PlannedInput>& from,
                                                        std::size_t next,
                                                        const std::optional<SessionTime>& since) noexcept {
    using Kind = ObserverInput::Kind;
    // Nothing begins by letting go: where that is next, something was told already.
    const std::span<const PlannedInput> left = std::span(from).subspan(next);
    if (left.empty() || (left[0].input.kind != Kind::key_up && left[0].input.kind != Kind::pointer_up))
        return std::nullopt;
    ObserverInput input = left[0].input;
    input.at = *since + left[0].after;
    return input;
}

void SimulatedKeys::clear() noexcept {
    if (const auto release = release_due(planned_, next_, opened_))
        release_ = release;
    else if (const auto early = release_due(early_, next_early_, awaited_))
        release_ = early;
    early_.clear();
    planned_.clear();
    next_early_ = next_ = 0;
    awaited_.reset();
    opened_.reset();
}

void SimulatedKeys::press(std::vector<PlannedInput>& to, std::string_view key, SessionDuration after) {
    ObserverInput input;
    input.kind = ObserverInput::Kind::key_down;
    input.device = ShortName(simulated_observer_device);
    input.key = ShortName(key);
    to.push_back({input, after});
    input.kind = ObserverInput::Kind::key_up;
    to.push_back({input, after + key_held});
}

void SimulatedKeys::type(const std::string& text, SessionDuration& after) {
    for (const char letter : text) {
        ObserverInput input;
        input.kind = ObserverInput::Kind::text;
        input.device = ShortName(simulated_observer_device);
        input.character = static_cast<char32_t>(static_cast<unsigned char>(letter));
        planned_.push_back({input, after});
        after += between_keys;
    }
}

/// By one drag of the mouse, from the middle of the screen.
void SimulatedKeys::lean(const AnswerOffer& offer, const Attitude& attitude, SessionDuration& after) {
    const auto vector_of = [](const Attitude& of) {
        const double tilt = to_radians(of.tilt).value;
        return of.slant.value * glm::dvec2(std::cos(tilt), std::sin(tilt));
    };
    const glm::dvec2 by = (vector_of(attitude) - vector_of(*offer.attitude)) / offer.slant_per_px_deg;
    ObserverInput input;
    input.device = ShortName(simulated_observer_device);
    input.kind = ObserverInput::Kind::pointer_down;
    input.button = 1;
    planned_.push_back({input, after});
    input.right_px = by.x;
    input.down_px = -by.y;
    for (const auto kind : {ObserverInput::Kind::pointer_moved, ObserverInput::Kind::pointer_up}) {
        after += between_keys;
        input.kind = kind;
        planned_.push_back({input, after});
    }
}

void SimulatedKeys::point_at(double right_px, double down_px, SessionDuration after) {
    ObserverInput input;
    input.device = ShortName(simulated_observer_device);
    input.right_px = right_px;
    input.down_px = down_px;
    input.kind = ObserverInput::Kind::pointer_moved;
    planned_.push_back({input, after, true});
    input.button = 1;
    input.kind = ObserverInput::Kind::pointer_down;
    planned_.push_back({input, after, true});
    input.kind = ObserverInput::Kind::pointer_up;
    planned_.push_back({input, after + key_held, true});
}

/// From the middle, where the first press has the marker come up.
void SimulatedKeys::move_to(const AnswerOffer& offer, double number, SessionDuration& after) {
    const int moves = std::max(1, static_cast<int>(std::lround((*offer.high - *offer.low) / offer.step)));
    const int target = static_cast<int>(std::lround((number - *offer.low) / offer.step));
    const std::string_view up = offer.is_turned ? "left" : "right", down = offer.is_turned ? "right" : "left";
    int at = moves / 2;
    const auto go = [&](std::string_view key) {
        press(planned_, key, after);
        after += between_keys;
    };
    go(up);
    // Who means the middle goes away from it and comes back.
    if (at == target) {
        go(at < moves ? up : down);
        go(at < moves ? down : up);
    }
    constexpr int coarse = 10;
    const bool rises = target > at;
    for (; std::abs(target - at) >= coarse; at += rises ? coarse : -coarse)
        go(rises != offer.is_turned ? "page up" : "page down");
    for (; at != target; at += at < target ? 1 : -1)
        go(at < target ? up : down);
}

/// Column by column, first by coarse steps. By keys alone.
void SimulatedKeys::set(const AnswerOffer& offer, const std::vector<int>& at, SessionDuration& after) {
    for (std::size_t i = 0; i < offer.axes.size(); ++i) {
        const OfferedAxis& axis = offer.axes[i];
        int here = axis.start;
        const auto go = [&](std::string_view key, int by) {
            press(planned_, key, after);
            after += between_keys;
            here += by;
        };
        const bool rises = at[i] > here;
        if (axis.less.empty())
            continue;
        while (!axis.much_less.empty() && axis.coarse > 0 && std::abs(at[i] - here) >= axis.coarse)
            go(rises ? axis.much_more : axis.much_less, rises ? axis.coarse : -axis.coarse);
        while (here != at[i])
            go(rises ? axis.more : axis.less, rises ? 1 : -1);
    }
}

void SimulatedKeys::plan(const SimulatedAnswers& answers, const std::vector<AnswerOffer>& offers,
                         const Trial& trial) {
    const std::optional<SessionTime> awaited = awaited_;
    clear();
    awaited_ = awaited;
    SessionDuration begin{};
    for (const AnswerOffer& offer : offers) {
        const SimulatedAnswers::Intended given = answers.answer(offer, trial);
        SessionDuration after = begin + given.after;
        if (given.is_early && !offer.keys.empty())
            press(early_, offer.keys.front(), early_after);
        if (given.is_missing)
            continue;
        if (!offer.axes.empty()) {
            set(offer, given.at, after);
        } else if (given.attitude) {
            lean(offer, *given.attitude, after);
        } else if (offer.kind == "point" && !offer.keys.empty()) {
            press(planned_, offer.keys.front(), after); // by gaze
        } else if (offer.kind == "point") {
            point_at(given.right_px, given.down_px, after);
        } else if (!offer.values.empty() && offer.numbers.empty()) {
            if (static_cast<std::size_t>(given.choice) >= offer.keys.size())
                continue; // by the mouse alone
            press(planned_, offer.keys[static_cast<std::size_t>(given.choice)], after);
        } else if (!offer.numbers.empty() && offer.keys.size() == offer.numbers.size() && given.number) {
            const auto step = std::ranges::min_element(
                offer.numbers, {}, [&](double number) { return std::abs(number - *given.number); });
            press(planned_, offer.keys[static_cast<std::size_t>(step - offer.numbers.begin())], after);
        } else if (offer.kind == "scale" && given.number) {
            move_to(offer, *given.number, after);
        } else if (offer.kind == "number") {
            type(fmt::format("{:.10g}", given.number.value_or(0.0)), after);
        } else {
            type("seen", after);
        }
        if (!offer.accept_key.empty()) {
            after += before_accepting;
            press(planned_, offer.accept_key, after);
        }
        begin = after;
    }
}

std::optional<ObserverInput> SimulatedKeys::next(SessionTime now) noexcept {
    const auto take = [&](std::vector<PlannedInput>& from, std::size_t& next,
                          const std::optional<SessionTime>& since) -> std::optional<ObserverInput> {
        const std::span<const PlannedInput> left = std::span(from).subspan(next);
        if (!since || left.empty() || *since + left[0].after > now)
            return std::nullopt;
        ++next;
        const PlannedInput& planned = left[0];
        ObserverInput input = planned.input;
        input.at = *since + planned.after;
        if (planned.is_from_gaze && gaze_px_) {
            const glm::dvec2 gaze = gaze_px_(input.at);
            input.right_px += gaze.x;
            input.down_px += gaze.y;
        }
        return input;
    };
    if (release_ && release_->at <= now)
        return std::exchange(release_, std::nullopt);
    if (const std::optional<ObserverInput> early = take(early_, next_early_, awaited_))
        return early;
    return take(planned_, next_, opened_);
}

} // namespace overt
