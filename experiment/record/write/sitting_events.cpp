#include "experiment/record/write/sitting_events.h"

namespace overt {

SittingEvents::SittingEvents(SQLite::Database& database, int sitting, const SittingDetection& detection)
    : rows_(database), detector_(detection.settings, GazeAngles(detection.screen), *this) {
    rows_.detection(sitting, detection_by(detection.settings));
}

void SittingEvents::begin_trial(std::int64_t trial_id) {
    finish_trial();
    rows_.begin_trial(trial_id);
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
