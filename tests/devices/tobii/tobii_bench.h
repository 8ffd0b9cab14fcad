/// What tests of Tobii's trackers share.
#pragma once

#include <memory>

#include "devices/host/clocks.h"
#include "devices/tobii/tobii_driver.h"
#include "tests/support/diary_setup_screen.h"
#include "tests/support/kept_items.h"
#include "tests/support/stand_in_library.h"

namespace overt::test {

/// A driver over a stand-in for the library, as new.
struct TobiiBench {
    explicit TobiiBench(const std::string& file = OVERT_STAND_IN_TOBII) : library(file) {
        settings.library = file;
        settings.calibration_points = {{960.0, 540.0}, {192.0, 108.0}, {1728.0, 972.0}};
        settings.target_delay = std::chrono::milliseconds(11);
        wish.both_eyes = true;
        wish.rate_hz = 500.0;
    }

    TrackerDescription connect() {
        driver = std::make_unique<TobiiDriver>(settings, clock);
        return driver->connect(wish);
    }

    /// Until so many samples came, or the recording is not running.
    RecordingState read_samples(std::size_t wanted) {
        RecordingState state = RecordingState::running;
        const SessionTime give_up = clock.now() + std::chrono::seconds(60);
        while (items.all<GazeSample>().size() < wanted && state == RecordingState::running &&
               clock.now() < give_up)
            state = driver->read(items, clock.now() + std::chrono::milliseconds(2));
        return state;
    }

    StandInLibrary library;
    SteadyClock clock;
    TobiiSettings settings;
    TrackerWish wish;
    KeptItems items;
    std::unique_ptr<TobiiDriver> driver;
};

} // namespace overt::test
