#include "experiment/calibration/drift_from_samples.h"

#include <array>

#include "experiment/calibration/resting_gaze.h"

namespace overt {

DriftOutcome drift_from_samples(EyeTracker& tracker, Clock& clock, const ScreenGeometry& screen,
                                ScreenPoint target, SessionDuration patience) {
    const TrackerDescription description = tracker.description();
    std::array<RestingGaze, 2> eyes{RestingGaze(screen, {}), RestingGaze(screen, {})};
    std::array<TrackerItem, 256> items;
    DriftOutcome outcome;
    tracker.start_recording();
    const SessionTime latest = clock.now() + patience;
    while (outcome.kind == DriftOutcome::Kind::no_eye && clock.now() < latest && !tracker.lost()) {
        clock.wait_until(clock.now() + between_looks);
        for (std::size_t taken = items.size(); taken == items.size();) {
            taken = tracker.poll(items);
            for (std::size_t i = 0; i < taken; ++i)
                if (const auto* sample = std::get_if<GazeSample>(&items[i]))
                    eyes[static_cast<std::size_t>(sample->eye)].take(*sample);
        }
        int resting = 0;
        ScreenPoint sum{};
        for (const RestingGaze& eye : eyes)
            if (const std::optional<RestedGaze> rested = eye.rested()) {
                sum = {sum.x_px + rested->median.x_px, sum.y_px + rested->median.y_px};
                ++resting;
            }
        if (resting == (description.both_eyes ? 2 : 1))
            outcome = {DriftOutcome::Kind::measured,
                       screen.angle_between({sum.x_px / resting, sum.y_px / resting}, target)};
    }
    tracker.stop_recording();
    return outcome;
}

} // namespace overt
