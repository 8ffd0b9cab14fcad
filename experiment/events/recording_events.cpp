#include "experiment/events/recording_events.h"

namespace overt {

RecordingThresholds thresholds_for(const ReadGaze& read, const GazeAngles& angles,
                                   const ChosenThresholds& chosen) {
    GazeNoiseMeter meter(angles);
    read([&](std::span<const GazeSample> samples, bool begins) {
        if (begins)
            meter.finish();
        for (const GazeSample& sample : samples)
            meter.push(sample);
    });
    meter.finish();
    const std::optional<GazeNoise> measured = meter.measured();
    return {chosen.over(measured ? usual_settings(*measured) : EventSettings{}), measured};
}

void find_events(const ReadGaze& read, const GazeAngles& angles, const EventSettings& settings,
                 EventListener& listener) {
    EventDetector detector(settings, angles, listener);
    read([&](std::span<const GazeSample> samples, bool begins) {
        if (begins)
            detector.finish();
        for (const GazeSample& sample : samples)
            detector.push(sample);
    });
    detector.finish();
}

} // namespace overt
