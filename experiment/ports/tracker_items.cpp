#include "experiment/ports/tracker_items.h"

#include <algorithm>
#include <charconv>
#include <iterator>

#include <fmt/format.h>

namespace overt {
namespace {

constexpr std::string_view data_lost = "data lost (";
constexpr std::string_view gap_reasons[] = {"queue overflow", "connection", "unreadable"};

GazeEvent instant(GazeEvent::Kind kind, TrackerTime at, std::string text) {
    GazeEvent event;
    event.kind = kind;
    event.start = event.end = at;
    event.text = std::move(text);
    return event;
}

std::optional<double> widened(const std::optional<float>& value) {
    return value ? std::optional(static_cast<double>(*value)) : std::nullopt;
}

struct Words {
    std::optional<GazeEvent> operator()(const GazeSample&) const { return std::nullopt; }
    std::optional<GazeEvent> operator()(const SampleDetail&) const { return std::nullopt; }
    std::optional<GazeEvent> operator()(const ClockPair&) const { return std::nullopt; }
    std::optional<GazeEvent> operator()(const TrackerEvent& told) const {
        GazeEvent event;
        event.kind = told.kind;
        event.eye = told.eye;
        event.start = told.start;
        event.end = told.end;
        event.duration = told.duration;
        event.place = told.place;
        event.arrival = told.arrival;
        event.pupil = widened(told.pupil);
        event.amplitude_deg = widened(told.amplitude_deg);
        event.peak_velocity_deg_s = widened(told.peak_velocity_deg_s);
        return event;
    }
    std::optional<GazeEvent> operator()(const TrackerInput& input) const {
        return instant(GazeEvent::Kind::input, input.at, fmt::format("{}", input.value));
    }
    std::optional<GazeEvent> operator()(const TrackerButton& button) const {
        return instant(GazeEvent::Kind::button, button.at,
                       fmt::format("{} {}", button.number, button.is_down ? 1 : 0));
    }
    std::optional<GazeEvent> operator()(const TrackerGap& gap) const {
        return instant(GazeEvent::Kind::note, gap.after,
                       gap.lost_samples > 0 ? fmt::format("{}{}): {} samples", data_lost, name_of(gap.reason),
                                                          gap.lost_samples)
                                            : fmt::format("{}{})", data_lost, name_of(gap.reason)));
    }
};

std::optional<float> narrowed(const std::optional<double>& value) {
    return value ? std::optional(static_cast<float>(*value)) : std::nullopt;
}

/// A whole number at the beginning of a text, which is left behind; nothing if there is none.
std::optional<std::int64_t> take_number(std::string_view& text) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc())
        return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return number;
}

std::optional<TrackerItem> gap_of(const GazeEvent& note) {
    std::string_view text = note.text;
    if (!text.starts_with(data_lost))
        return std::nullopt;
    text.remove_prefix(data_lost.size());
    for (std::size_t i = 0; i < std::size(gap_reasons); ++i) {
        if (!text.starts_with(gap_reasons[i]))
            continue;
        text.remove_prefix(std::min(text.size(), gap_reasons[i].size() + std::string_view("): ").size()));
        return TrackerGap{static_cast<TrackerGap::Reason>(i), note.start, take_number(text).value_or(0)};
    }
    return std::nullopt;
}

} // namespace

std::string_view name_of(TrackerGap::Reason reason) noexcept { return gap_reasons[static_cast<int>(reason)]; }

// NOLINTNEXTLINE(bugprone-exception-escape): an item always holds one of its kinds
TrackerTime put_forward(TrackerItem& item, TrackerClock::duration by) noexcept {
    struct Forward {
        TrackerClock::duration by;
        TrackerTime operator()(GazeSample& sample) const { return sample.sampled_at += by; }
        TrackerTime operator()(SampleDetail& detail) const { return detail.sampled_at += by; }
        TrackerTime operator()(TrackerEvent& event) const {
            event.start += by;
            return event.end += by;
        }
        TrackerTime operator()(TrackerInput& input) const { return input.at += by; }
        TrackerTime operator()(TrackerButton& button) const { return button.at += by; }
        TrackerTime operator()(TrackerGap& gap) const { return gap.after += by; }
        TrackerTime operator()(ClockPair& pair) const { return pair.other += by; }
    };
    return std::visit(Forward{by}, item);
}

std::optional<GazeEvent> gaze_event_of(const TrackerItem& item) { return std::visit(Words{}, item); }

std::optional<TrackerItem> tracker_item_of(const GazeEvent& event) {
    using Kind = GazeEvent::Kind;
    std::string_view text = event.text;
    switch (event.kind) {
    case Kind::fixation:
    case Kind::saccade:
    case Kind::blink:
        if (!event.eye)
            return std::nullopt;
        return TrackerEvent{.kind = event.kind,
                            .eye = *event.eye,
                            .start = event.start,
                            .end = event.end,
                            .duration = event.duration,
                            .place = event.place,
                            .arrival = event.arrival,
                            .pupil = narrowed(event.pupil),
                            .amplitude_deg = narrowed(event.amplitude_deg),
                            .peak_velocity_deg_s = narrowed(event.peak_velocity_deg_s)};
    case Kind::input:
        if (const auto value = take_number(text))
            return TrackerInput{event.start, static_cast<std::uint32_t>(*value)};
        return std::nullopt;
    case Kind::button: {
        const auto number = take_number(text);
        if (!number || text.empty())
            return std::nullopt;
        text.remove_prefix(1);
        const auto state = take_number(text);
        return state ? std::optional<TrackerItem>(
                           TrackerButton{event.start, static_cast<int>(*number), *state == 1})
                     : std::nullopt;
    }
    case Kind::note:
        return gap_of(event);
    case Kind::message:
    case Kind::started:
    case Kind::ended:
        break;
    }
    return std::nullopt;
}

} // namespace overt
