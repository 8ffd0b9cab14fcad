#include "devices/eyelink/eyelink_items.h"

#include <cmath>
#include <cstring>

namespace overt {
namespace {

constexpr float no_value = -32768.0f;

enum SampleFlags : std::uint16_t { left_eye = 0x8000, right_eye = 0x4000, half_millisecond = 0x0002 };

constexpr std::size_t sample_bytes = 80; ///< of the fields that are read
constexpr std::size_t eye_event_bytes = 114, port_event_bytes = 8;

template <class Number> Number at(std::span<const std::byte> item, std::size_t offset) noexcept {
    Number number{};
    std::memcpy(&number, item.data() + offset, sizeof number);
    return number;
}

bool is_value(float number) noexcept { return std::isfinite(number) && number != no_value; }

std::optional<float> value_at(std::span<const std::byte> item, std::size_t offset) noexcept {
    const auto number = at<float>(item, offset);
    return is_value(number) ? std::optional<float>(number) : std::nullopt;
}

std::optional<ScreenPoint> place_at(std::span<const std::byte> item, std::size_t x, std::size_t y) noexcept {
    const auto x_px = value_at(item, x), y_px = value_at(item, y);
    return x_px && y_px ? std::optional<ScreenPoint>({*x_px, *y_px}) : std::nullopt;
}

TrackerTime milliseconds_at(std::span<const std::byte> item, std::size_t offset) noexcept {
    return tracker_time(std::int64_t{at<std::uint32_t>(item, offset)} * 1000);
}

/// Eye 0 is the left one, in each pair of numbers.
GazeSample eye_of(std::span<const std::byte> item, TrackerTime time, std::size_t eye) noexcept {
    GazeSample sample;
    sample.sampled_at = time;
    sample.eye = eye == 0 ? Eye::left : Eye::right;
    const auto pupil = at<float>(item, 40 + 4 * eye);
    // Where the pupil is not seen, a place is only what was left in the record.
    if (is_value(pupil) && pupil > 0.0f) {
        sample.gaze = place_at(item, 48 + 4 * eye, 56 + 4 * eye);
        if (sample.gaze)
            sample.pupil_area = pupil;
    }
    return sample;
}

/// Degrees between the ends of a saccade: pixels over the mean of the pixels per degree at both.
std::optional<float> amplitude_of(std::span<const std::byte> item, const TrackerEvent& saccade) noexcept {
    const auto start_x = value_at(item, 96), end_x = value_at(item, 100);
    const auto start_y = value_at(item, 104), end_y = value_at(item, 108);
    if (!saccade.place || !saccade.arrival || !start_x || !end_x || !start_y || !end_y)
        return std::nullopt;
    const double px_per_deg_x = 0.5 * (*start_x + *end_x), px_per_deg_y = 0.5 * (*start_y + *end_y);
    if (!(px_per_deg_x > 0.0) || !(px_per_deg_y > 0.0))
        return std::nullopt;
    return static_cast<float>(std::hypot((saccade.arrival->x_px - saccade.place->x_px) / px_per_deg_x,
                                         (saccade.arrival->y_px - saccade.place->y_px) / px_per_deg_y));
}

std::optional<TrackerEvent> eye_event(EyelinkItem kind, std::span<const std::byte> item,
                                      double rate_hz) noexcept {
    if (item.size() < eye_event_bytes)
        return std::nullopt;
    const auto eye = at<std::int16_t>(item, 8);
    if (eye != 0 && eye != 1)
        return std::nullopt;
    TrackerEvent event;
    event.eye = eye == 0 ? Eye::left : Eye::right;
    event.start = milliseconds_at(item, 12);
    event.end = milliseconds_at(item, 16);
    const double lasted_ms = static_cast<double>((event.end - event.start).count()) / 1000.0;
    event.duration = std::chrono::milliseconds(
        std::llround(std::floor(lasted_ms + (rate_hz > 0.0 ? 1000.0 / rate_hz : 0.0))));
    if (kind == EyelinkItem::blink_end) {
        event.kind = GazeEvent::Kind::blink;
    } else if (kind == EyelinkItem::fixation_end) {
        event.kind = GazeEvent::Kind::fixation;
        event.place = place_at(item, 68, 72);
        event.pupil = value_at(item, 76);
    } else {
        event.kind = GazeEvent::Kind::saccade;
        event.place = place_at(item, 28, 32);
        event.arrival = place_at(item, 48, 52);
        event.amplitude_deg = amplitude_of(item, event);
        event.peak_velocity_deg_s = value_at(item, 84);
    }
    return event;
}

} // namespace

std::optional<EyelinkEyes> eyelink_eyes(std::int16_t available) noexcept {
    switch (available) {
    case 0:
        return EyelinkEyes::left;
    case 1:
        return EyelinkEyes::right;
    case 2:
        return EyelinkEyes::both;
    default:
        return std::nullopt;
    }
}

void EyelinkDecoder::take_sample(std::span<const std::byte> item, TrackerItemSink& sink) noexcept {
    if (item.size() < sample_bytes || at<std::int16_t>(item, 4) != static_cast<int>(EyelinkItem::sample))
        return;
    const auto flags = at<std::uint16_t>(item, 6);
    const TrackerTime time =
        milliseconds_at(item, 0) + std::chrono::microseconds((flags & half_millisecond) != 0 ? 500 : 0);
    if (has_lost_data_) {
        std::int64_t lost = 0; // not known
        if (rate_hz_ > 0.0 && last_sample_ != TrackerTime{} && time > last_sample_)
            lost = std::llround(static_cast<double>((time - last_sample_).count()) * 1e-6 * rate_hz_) - 1;
        sink.put(TrackerGap{TrackerGap::Reason::overflow, last_sample_, lost});
        has_lost_data_ = false;
    }
    const bool names_eyes = (flags & (left_eye | right_eye)) != 0;
    if (names_eyes ? (flags & left_eye) != 0 : recorded_ != EyelinkEyes::right)
        sink.put(eye_of(item, time, 0));
    if (names_eyes ? (flags & right_eye) != 0 : recorded_ != EyelinkEyes::left)
        sink.put(eye_of(item, time, 1));
    last_sample_ = time;
}

void EyelinkDecoder::take(EyelinkItem kind, std::span<const std::byte> item, TrackerItemSink& sink) noexcept {
    switch (kind) {
    case EyelinkItem::sample:
        take_sample(item, sink);
        break;
    case EyelinkItem::lost_data:
        has_lost_data_ = true;
        break;
    case EyelinkItem::blink_end:
    case EyelinkItem::saccade_end:
    case EyelinkItem::fixation_end:
        if (const auto event = eye_event(kind, item, rate_hz_))
            sink.put(*event);
        break;
    case EyelinkItem::button:
        if (item.size() >= port_event_bytes) {
            // Low byte: the states of buttons 1 to 8; high byte: which of them changed.
            const auto states = at<std::uint16_t>(item, 6);
            for (int button = 0; button < 8; ++button)
                if (((states >> (8 + button)) & 1) != 0)
                    sink.put(
                        TrackerButton{milliseconds_at(item, 0), button + 1, ((states >> button) & 1) != 0});
        }
        break;
    case EyelinkItem::input:
        if (item.size() >= port_event_bytes)
            sink.put(TrackerInput{milliseconds_at(item, 0), at<std::uint16_t>(item, 6)});
        break;
    default:
        break;
    }
}

} // namespace overt
