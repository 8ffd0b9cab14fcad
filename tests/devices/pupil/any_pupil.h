/// What is done with any bytes that might come from where Pupil Capture is: by the fuzzer, and by the test
/// that replays its corpus. It may do nothing but return.
#pragma once

#include <string_view>

#include "devices/pupil/pupil_samples.h"
#include "tests/support/kept_items.h"

namespace overt::test {

inline void take_any_pupil(std::string_view bytes) {
    PupilSamples samples(TrackerWish(), {{0.0, 0.0}, 1920.0, 1080.0}, 0.6);
    KeptItems items;
    if (const std::optional<PupilDatum> pupil = read_pupil_datum(bytes))
        samples.take(*pupil);
    read_surface(bytes, [&](const SurfaceGaze& gaze) { samples.take(gaze, items); });
    MsgpackReader reader(bytes);
    while (!reader.failed())
        reader.skip();
}

} // namespace overt::test
