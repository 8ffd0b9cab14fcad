/// What surrounds the trials, as a protocol states it: consent, instructions, the operator's keys, spoken
/// answers, the program's own words, what a dataset says of itself. Explained key by key in sitting_keys.cpp
/// and word_keys.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiment/base/enum_names.h"

namespace overt {

/// [consent]
struct ConsentSettings {
    std::string text; ///< empty: the observer is not asked
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
    bool keyboard_answers = true; ///< the window's keyboard answers for the observer, too
    std::string pause_text = "# Pause\nPlease wait a moment.";
    std::vector<std::string> skip_reasons{"eye lost", "observer's wish", "equipment", "other"};
};

enum class AnswerUse : std::uint8_t { none, optional, required };
template <> inline constexpr auto names_of<AnswerUse> = enum_names<AnswerUse>("none", "optional", "required");

/// [answers]
struct AnswerSettings {
    AnswerUse record = AnswerUse::none;
    std::string device; ///< part of its name; empty: the system's default
    int sample_rate_hz = 48000;
    int bits = 16; ///< 16 or 24
    bool meter_on_screen = false;
};

/// [words]: what the program itself says on the screen.
struct WordSettings {
    std::string keyboard_lost = "What is typed goes to another window.\nClick on this one to go on.";
    std::string screen_changed = "The screen is not what it was when the session began.\n"
                                 "Go on all the same? Otherwise the session ends.";
    std::string recalibrate = "Calibrate the eye tracker anew?\nThe session then goes on where it is.";
    std::string validation = "Go on with this calibration? Otherwise it is done again.";
    std::string validation_poor = "This calibration is poorer than the protocol allows.\n"
                                  "Go on all the same? Otherwise it is done again.";
    std::string not_calibrated =
        "The eye tracker is not calibrated.\nCalibrate again? Otherwise the session ends.";
    std::string tracker_lost =
        "The eye tracker was lost.\nConnect and calibrate again? Otherwise the session ends.";
    std::string repeat = "Break this trial off and repeat it at once?";
    std::string reject = "Reject this trial?\nIt comes again as the protocol says.";
    std::string skip = "Skip this trial?\nIt does not come again.";
    std::string abort = "End the session?\nWhat was recorded stays.";
    std::string abort_in_trial =
        "End the session?\nThis trial is recorded as broken off; what was recorded before stays.";
    std::string yes = "yes", no = "no";
    std::string optional = "optional";
    std::string choose = "choose", back = "back", other_fields = "other fields", next = "next", done = "done";
    std::string missing = "please fill this in";
    std::string not_possible = "this cannot be";
    std::string form_title = "About you";
    std::string space_bar = "space bar", enter_key = "enter";
    std::string agree = "I agree", decline = "I do not agree";
    std::string go_on = "go on", answered = "I have answered", close = "close";
    std::string rest = "keys work after {} s", goes_on_itself = "goes on by itself after {} s";
    std::string please_wait = "One moment, please.";
    std::string experimenter = "For the experimenter";
    std::string too_loud = "too loud";
    std::string no_voice = "no voice is heard";
};

/// [dataset]: what a dataset that the session becomes part of says of itself.
struct DatasetSettings {
    std::string name; ///< empty: the protocol's title
    std::vector<std::string> authors;
    std::string license;
    std::vector<std::string> keywords;
    std::string acknowledgements, how_to_acknowledge;
    std::vector<std::string> funding, ethics_approvals, references;
    std::string doi;
    std::string institution_name, institution_address, department;
};

} // namespace overt
