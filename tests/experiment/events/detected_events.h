/// Detecting in tests.
#pragma once

#include <span>
#include <vector>

#include "experiment/events/event_agreement.h"
#include "experiment/events/event_detector.h"
#include "experiment/events/planted_gaze.h"

namespace overt::testing {

class EventList final : public EventListener {
  public:
    void detected(const GazeEvent& event) override { events.push_back(event); }
    std::vector<GazeEvent> events;
};

inline std::vector<GazeEvent> detect(std::span<const GazeSample> samples, const EventSettings& settings = {},
                                     const GazeAngles& angles = GazeAngles(ScreenGeometry{})) {
    EventList list;
    EventDetector detector(settings, angles, list);
    for (const GazeSample& sample : samples)
        detector.push(sample);
    detector.finish();
    return list.events;
}

inline std::vector<GazeEvent> of_kind(const std::vector<GazeEvent>& events, GazeEvent::Kind kind) {
    std::vector<GazeEvent> chosen;
    for (const GazeEvent& event : events)
        if (event.kind == kind)
            chosen.push_back(event);
    return chosen;
}

inline EventAgreement agreement(GazeEvent::Kind kind, const std::vector<GazeEvent>& planted,
                                const std::vector<GazeEvent>& found) {
    EventAgreement agreement(kind);
    agreement.add(planted, found);
    return agreement;
}

} // namespace overt::testing
