#include "experiment/record/asc/asc_pair_check.h"

#include <cmath>

#include <fmt/format.h>

namespace overt {

void AscPairCheck::samples(std::span<const GazeSample> samples) {
    constexpr std::size_t most_kept = 60'000; // half a minute at 2000 Hz
    ++(is_recording_ ? inside_ : outside_);
    for (const GazeSample& sample : samples) {
        std::deque<GazeSample>& latest = latest_[static_cast<std::size_t>(sample.eye)];
        latest.push_back(sample);
        if (latest.size() > most_kept)
            latest.pop_front();
    }
}

void AscPairCheck::event(const GazeEvent& event) {
    has_recordings_ |= event.kind == GazeEvent::Kind::started;
    if (event.kind == GazeEvent::Kind::started || event.kind == GazeEvent::Kind::ended)
        is_recording_ = event.kind == GazeEvent::Kind::started;
    if (event.kind == GazeEvent::Kind::fixation && event.place && event.eye)
        take_fixation(event);
}

void AscPairCheck::take_fixation(const GazeEvent& fixation) {
    constexpr double most_apart_px = 10.0; // what the one says is the mean of the others
    double x_px = 0.0, y_px = 0.0;
    int count = 0;
    const std::deque<GazeSample>& latest = latest_[static_cast<std::size_t>(*fixation.eye)];
    for (auto sample = latest.rbegin(); sample != latest.rend() && sample->sampled_at >= fixation.start;
         ++sample) {
        if (!sample->gaze || sample->sampled_at > fixation.end)
            continue;
        x_px += sample->gaze->x_px;
        y_px += sample->gaze->y_px;
        ++count;
    }
    const bool agrees = count > 0 && std::hypot(x_px / count - fixation.place->x_px,
                                                y_px / count - fixation.place->y_px) <= most_apart_px;
    ++(agrees ? agreeing_ : contradicted_);
}

std::string AscPairCheck::fault() const {
    constexpr int most_outside_percent = 10;
    if (has_recordings_ && 100 * outside_ > most_outside_percent * (inside_ + outside_))
        return fmt::format(
            "{} of {} lines of samples lie outside of the recordings (START to END) of the events", outside_,
            inside_ + outside_);
    if (contradicted_ > agreeing_)
        return fmt::format("{} of {} fixations have other places than the samples meanwhile, or no samples",
                           contradicted_, contradicted_ + agreeing_);
    return {};
}

} // namespace overt
