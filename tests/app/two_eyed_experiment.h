/// The small experiment through a stereoscope.
#pragma once

#include "tests/app/small_experiment.h"

namespace overt::test {

/// Each eye has a half of 272 x 192 pixels. `eye`: that the tracker measures.
inline std::string two_eyed(const std::string& eye) {
    std::string text =
        with(small_protocol, "output = \"color++\"\n", "output = \"native-8bit\"\ngamma = 2.2\n");
    text = with(text, "[bake]\n", "[stereo]\nkind = \"mirrors\"\ninterocular_mm = 70\n\n[bake]\n");
    return with(text, "rate_hz = 1000\n", "rate_hz = 1000\neye = \"" + eye + "\"\n");
}

} // namespace overt::test
