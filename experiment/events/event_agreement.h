/// How well detected events agree with those of a reference: a tracker's own, a person's, or planted ones.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "experiment/gaze_event.h"

namespace overt {

/// Of one kind of event, over any number of recordings. Two events are the same if the time that both have is
/// more than half of the time that either has (intersection over union > 0.5): no event can then have two
/// partners. Reported with the errors of begin and end, as Hooge et al. (Behavior Research Methods 50, 2018)
/// ask.
class EventAgreement {
  public:
    explicit EventAgreement(GazeEvent::Kind kind) : kind_(kind) {}

    /// Of one eye in one recording; each in the order of their begins. Other kinds are passed over.
    void add(std::span<const GazeEvent> reference, std::span<const GazeEvent> detected);

    int in_reference() const { return in_reference_; }
    int detected() const { return detected_; }
    int matched() const { return static_cast<int>(onset_errors_ms_.size()); }
    /// Harmonic mean of the shares of both that have a partner; 1 if there are no events at all.
    double f1() const;
    /// Medians of the sizes of errors of those with a partner; nothing without any.
    std::optional<double> median_onset_error_ms() const;
    std::optional<double> median_offset_error_ms() const;

  private:
    GazeEvent::Kind kind_;
    int in_reference_ = 0, detected_ = 0;
    std::vector<double> onset_errors_ms_, offset_errors_ms_; ///< detected less reference
};

/// Cohen's kappa of a yes or no for each sample: agreement beyond chance (Cohen 1960).
class SampleAgreement {
  public:
    void add(bool in_reference, bool detected);
    /// 1 if all samples agree; nothing is said of none.
    double kappa() const;

  private:
    double samples_ = 0.0, both_ = 0.0, in_reference_ = 0.0, detected_ = 0.0;
};

/// Which samples lie in an event of this kind, by the times of its first and last sample. Where a blink lies
/// in a saccade, both are said. `events` in the order of their begins.
std::vector<bool> samples_within(std::span<const GazeSample> samples, std::span<const GazeEvent> events,
                                 GazeEvent::Kind kind);

} // namespace overt
