/// What surrounds the trials, as a protocol states it: consent, instructions, the operator's keys, spoken
/// answers. Explained key by key in sitting_keys.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace overt {

/// [consent]
struct ConsentSettings {
    std::string text; ///< empty: nobody is asked
    std::string accept_key = "y", decline_key = "n";
};

/// [instructions]
struct InstructionSettings {
    std::vector<std::string> pages;
};

/// [operator]: keys by their names, and what stands on the screen.
struct OperatorSettings {
    std::string pause = "f1";
    std::string recalibrate = "f2";
    std::string repeat = "f3";
    std::string reject = "f4";
    std::string skip = "f5";
    std::string abort = "escape";
    std::string yes = "y", no = "n";
    std::string pause_text = "Pause.\nPlease wait a moment.";
    std::vector<std::string> skip_reasons{"eye lost", "observer's wish", "equipment", "other"};
};

enum class AnswerUse : std::uint8_t { none, optional, required };

/// [answers]
struct AnswerSettings {
    AnswerUse record = AnswerUse::none;
    std::string device; ///< part of its name; empty: the system's default
    int sample_rate_hz = 48000;
    int bits = 16; ///< 16 or 24
};

} // namespace overt
