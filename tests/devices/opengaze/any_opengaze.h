/// What is done with any bytes that an Open Gaze server might send: by the fuzzer, and by the test that
/// replays its corpus. It may do nothing but return.
#pragma once

#include <algorithm>
#include <string_view>

#include "devices/link/text_line.h"
#include "devices/opengaze/opengaze_calibration.h"
#include "devices/opengaze/opengaze_samples.h"
#include "tests/support/kept_items.h"

namespace overt::test {

inline void take_any_opengaze(std::string_view bytes) {
    LineSplitter splitter(1000);
    OpenGazeClock clock;
    clock.use_ticks(bytes.size() % 2 == 0 ? std::optional(1e7) : std::nullopt);
    TrackerWish wish;
    wish.both_eyes = bytes.size() % 3 != 0;
    const OpenGazeSettings settings;
    OpenGazeSamples samples(wish, TrackedPoint::eyes, settings.longest_delay);
    KeptItems items;
    // The first byte tells how the rest was cut on its way.
    const std::size_t piece = bytes.empty() ? 1 : 1 + static_cast<unsigned char>(bytes.front());
    for (; !bytes.empty(); bytes.remove_prefix(std::min(piece, bytes.size())))
        splitter.feed(bytes.substr(0, piece), [&](std::string_view line) {
            const auto message = parse_opengaze(line);
            if (!message)
                return samples.take_noise(items);
            samples.take(read_opengaze_record(*message), SessionTime(), clock, items);
            outcome_of(*message, settings, wish);
        });
}

} // namespace overt::test
