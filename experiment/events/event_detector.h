/// Fixations, saccades and blinks from samples of gaze, one by one: while a session runs, and from
/// recordings. It is the same code, so that both give the same events.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/events/event_settings.h"
#include "experiment/events/gaze_angles.h"
#include "experiment/events/gaze_motion.h"
#include "experiment/gaze_event.h"

namespace overt {

/// Told of each fixation, saccade and blink once it has ended.
class EventListener {
  public:
    virtual ~EventListener() = default;
    /// Valid during the call. In the order of their ends for each eye, but a blink comes before the saccade
    /// around it.
    virtual void detected(const GazeEvent& event) = 0;
};

/// One eye's movements, by velocity and acceleration as an EyeLink's parser tells them apart
/// (docs/events.md):
/// - a sample is fast if the speed exceeds its threshold, or the acceleration its own;
/// - a saccade begins with the first of fast samples that last for the time to verify, lead far enough away,
/// and of which
///   one at least is fast by its speed: acceleration tells when, but in noise not whether;
/// - it ends with the last fast sample before the eye is slow for the time to verify;
/// - where there is no pupil there is a blink, and around it a saccade: the lid that moves over the pupil
/// looks like one;
/// - all the rest is fixation, pursuit too.
/// An event is told at most 20 ms (the longest of the times to verify) and a window of 8 ms after its end, or
/// after one sample more of a slow tracker. Allocates only in the constructor. One thread at a time.
class EyeMovementDetector {
  public:
    /// The listener must outlive this.
    EyeMovementDetector(Eye eye, const EventSettings& settings, const GazeAngles& angles,
                        EventListener& listener);

    /// Samples of this eye, in the order of their times, at any rate and not necessarily even. One that is
    /// not later than the one before it is left out; one from more than longest_gap_ms before it begins a
    /// recording.
    void push(const GazeSample& sample);

    /// No more samples of this recording: what is open ends with its last sample, as in an EyeLink's files.
    /// Another recording may follow, of any time.
    void finish();

  private:
    /// Samples in a row, summed.
    struct Stretch {
        int samples = 0, valid = 0; ///< valid: with gaze
        TrackerTime first_at, last_at;
        TrackerClock::duration lasts{}; ///< the last sample
        std::optional<ScreenPoint> first, last;
        glm::dvec2 sum_px{0.0};
        double sum_pupil = 0.0;
        double peak_deg_s = 0.0;
        void add(const TrackedGaze& gaze, double speed_deg_s);
        void add(const Stretch& later);
        void clear() { *this = {}; }
    };
    struct Fastness {
        bool by_speed, by_acceleration;
        bool any() const { return by_speed || by_acceleration; }
    };
    enum class State : unsigned char { fixation, saccade };

    void judge(const TrackedGaze& gaze);
    void judge_lost(const TrackedGaze& gaze);
    void judge_in_saccade(const TrackedGaze& gaze, double speed_deg_s, bool is_fast);
    void judge_in_fixation(const TrackedGaze& gaze, double speed_deg_s, Fastness fastness);
    Fastness fastness_of(const TrackedGaze& gaze, double speed_deg_s);
    GazeEvent event_of(GazeEvent::Kind kind, const Stretch& stretch) const;
    void end_fixation();
    void end_saccade();
    void end_blink();

    const Eye eye_;
    const EventSettings settings_;
    const GazeAngles angles_;
    EventListener& listener_;
    const TrackerClock::duration onset_verify_, offset_verify_, blink_verify_;

    MotionWindow window_;
    MeanSpeed recent_speed_;
    State state_ = State::fixation;
    Stretch fixation_, saccade_;
    Stretch run_;                   ///< fast within a fixation, not yet a saccade
    bool run_has_moved_ = false;    ///< far enough to be one
    bool run_has_speed_ = false;    ///< somewhere
    Stretch slow_;                  ///< slow since the saccade's last fast sample
    glm::dvec3 departure_deg_{0.0}; ///< where the eye rested before it became fast
    bool has_blink_ = false;        ///< that goes on, or ended too lately to be sure
    Stretch blink_;
};

/// Both eyes, each by itself.
class EventDetector {
  public:
    EventDetector(const EventSettings& settings, const GazeAngles& angles, EventListener& listener)
        : eyes_{EyeMovementDetector(Eye::left, settings, angles, listener),
                EyeMovementDetector(Eye::right, settings, angles, listener)} {}

    void push(const GazeSample& sample) { eyes_[static_cast<std::size_t>(sample.eye)].push(sample); }
    void finish() {
        for (EyeMovementDetector& eye : eyes_)
            eye.finish();
    }

  private:
    std::array<EyeMovementDetector, 2> eyes_;
};

} // namespace overt
