#include "experiment/record/write/sitting_events.h"

namespace overt {

SittingEvents::SittingEvents(GazeRows& rows, int sitting, const SittingDetection& detection)
    : rows_(rows), detector_(detection.settings, GazeAngles(detection.screen), *this) {
    rows_.detection(sitting, detection_by(detection.settings));
}

void SittingEvents::begin_trial() {
    finish_trial();
    in_trial_ = true;
}

void SittingEvents::sample(const GazeSample& sample) {
    if (in_trial_)
        detector_.push(sample);
}

void SittingEvents::finish_trial() {
    if (in_trial_)
        detector_.finish();
    in_trial_ = false;
}

} // namespace overt
