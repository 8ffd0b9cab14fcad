#include "experiment/events/event_agreement.h"

#include <algorithm>
#include <cmath>

namespace overt {
namespace {

double ms(TrackerClock::duration time) { return std::chrono::duration<double, std::milli>(time).count(); }

std::vector<const GazeEvent*> of_kind(std::span<const GazeEvent> events, GazeEvent::Kind kind) {
    std::vector<const GazeEvent*> chosen;
    for (const GazeEvent& event : events)
        if (event.kind == kind)
            chosen.push_back(&event);
    return chosen;
}

bool are_the_same(const GazeEvent& a, const GazeEvent& b) {
    const TrackerTime a_end = a.start + a.duration, b_end = b.start + b.duration;
    const auto shared = std::min(a_end, b_end) - std::max(a.start, b.start);
    const auto whole = std::max(a_end, b_end) - std::min(a.start, b.start);
    return shared > TrackerClock::duration::zero() && 2 * shared > whole;
}

std::optional<double> median_size(std::vector<double> values) {
    if (values.empty())
        return std::nullopt;
    for (double& value : values)
        value = std::abs(value);
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1)
        return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

} // namespace

void EventAgreement::add(std::span<const GazeEvent> reference, std::span<const GazeEvent> detected) {
    const std::vector<const GazeEvent*> of_reference = of_kind(reference, kind_),
                                        of_detector = of_kind(detected, kind_);
    in_reference_ += static_cast<int>(of_reference.size());
    detected_ += static_cast<int>(of_detector.size());
    std::size_t from = 0;
    for (const GazeEvent* theirs : of_reference) {
        // Those that ended before it are no partners of what comes after it, either.
        while (from < of_detector.size() &&
               of_detector[from]->start + of_detector[from]->duration <= theirs->start)
            ++from;
        for (std::size_t i = from; i < of_detector.size(); ++i) {
            const GazeEvent& ours = *of_detector[i];
            if (ours.start >= theirs->start + theirs->duration)
                break;
            if (!are_the_same(*theirs, ours))
                continue;
            onset_errors_ms_.push_back(ms(ours.start - theirs->start));
            offset_errors_ms_.push_back(ms(ours.end - theirs->end));
            break;
        }
    }
}

double EventAgreement::f1() const {
    const int all = in_reference_ + detected_;
    return all > 0 ? 2.0 * matched() / all : 1.0;
}

std::optional<double> EventAgreement::median_onset_error_ms() const { return median_size(onset_errors_ms_); }
std::optional<double> EventAgreement::median_offset_error_ms() const {
    return median_size(offset_errors_ms_);
}

void SampleAgreement::add(bool in_reference, bool detected) {
    ++samples_;
    both_ += in_reference == detected;
    in_reference_ += in_reference;
    detected_ += detected;
}

double SampleAgreement::kappa() const {
    const double observed = both_ / samples_;
    const double by_chance =
        (in_reference_ * detected_ + (samples_ - in_reference_) * (samples_ - detected_)) /
        (samples_ * samples_);
    return observed >= 1.0 ? 1.0 : (observed - by_chance) / (1.0 - by_chance);
}

std::vector<bool> samples_within(std::span<const GazeSample> samples, std::span<const GazeEvent> events,
                                 GazeEvent::Kind kind) {
    const std::vector<const GazeEvent*> chosen = of_kind(events, kind);
    std::vector<bool> within;
    within.reserve(samples.size());
    std::size_t next = 0;
    for (const GazeSample& sample : samples) {
        while (next < chosen.size() && chosen[next]->end < sample.sampled_at)
            ++next;
        within.push_back(next < chosen.size() && chosen[next]->start <= sample.sampled_at);
    }
    return within;
}

} // namespace overt
