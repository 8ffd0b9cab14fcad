/// An Open Gaze tracker in memory and virtual time, and its driver.
#pragma once

#include <memory>

#include "devices/opengaze/opengaze_tracker.h"
#include "tests/devices/link/in_memory_line.h"
#include "tests/devices/opengaze/opengaze_server_model.h"
#include "tests/devices/tracker/scripted_setup_screen.h"
#include "tests/support/kept_items.h"

namespace overt::test {

struct OpenGazeBench {
    VirtualClock clock{SessionTime(std::chrono::seconds(10))};
    FarEnd far{clock};
    OpenGazeServerModel model;
    OpenGazeSettings settings;
    TrackerWish wish;
    KeptItems items;
    std::unique_ptr<OpenGazeTracker> tracker;

    OpenGazeBench() {
        far.port = "in memory";
        far.answer = [this](std::string_view bytes) { return model.receive(bytes, to_seconds(clock.now())); };
        far.before_read = [this](SessionTime until) {
            // Never ahead of what is read next: what it is told then would come too late.
            if (!far.arriving.empty())
                until = std::min(until, far.arriving.front().at);
            for (bool said = false; streamed_ <= until && !said; streamed_ += 1ms) {
                std::string text = model.stream(to_seconds(streamed_));
                said = !text.empty();
                far.send(streamed_ + far.delay, std::move(text));
            }
        };
        wish.both_eyes = true;
    }

    TrackerDescription connect() {
        streamed_ = clock.now();
        tracker = std::make_unique<OpenGazeTracker>(settings, clock,
                                                    [this] { return std::make_unique<InMemoryLine>(far); });
        return tracker->connect(wish);
    }

    /// As the device's thread does. Gives the state in the end.
    RecordingState read_for(SessionDuration time) {
        const SessionTime end = clock.now() + time;
        RecordingState state = RecordingState::running;
        while (clock.now() < end && state == RecordingState::running)
            state = tracker->read(items, std::min(end, clock.now() + 2ms));
        return state;
    }

    RecordingState record(SessionDuration time) {
        tracker->start();
        const RecordingState state = read_for(time);
        tracker->stop();
        return state;
    }

  private:
    SessionTime streamed_;
};

} // namespace overt::test
