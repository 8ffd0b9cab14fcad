/// An operator who is not there: keys that a simulated session is led by, and keys that its observer presses.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/ports/response_panel.h"
#include "experiment/ports/session_phase.h"

namespace overt {

/// Something that the observer does at a device while an answer is awaited.
struct ScriptedInput {
    SessionDuration after{}; ///< the moment of its key
    ObserverInput input;     ///< without its time
};

/// One key, pressed once.
struct ScriptedOperatorKey {
    SessionPhase phase = SessionPhase::task_screen;
    std::optional<int> trial; ///< index, practice not counted; nothing: whichever comes first
    double after_s = 0.0;     ///< the phase began
    ResponsePress::Key key = ResponsePress::Key::pause;
    char32_t answer = U'y'; ///< to the question that follows: y, n, or the digit of a reason
    /// The observer's, by the name on it, instead of one of the operator's: `key` is `next` if it goes on.
    std::string pressed = {};
    /// What of it answers: a key's press and release, words that are typed, the mouse. In the order of times.
    std::vector<ScriptedInput> inputs = {};
    std::string text; ///< as it was written
    bool is_observers() const { return !inputs.empty(); }
};

/// Reads "PHASE[@TRIAL]+SECONDS=KEY[,ANSWER]", as "stimulus@3+0.5=skip,2": trials count from 1, the answer is
/// yes, no or, to skip, the digit of one of so many reasons, and yes if it is left out. KEY may also be
/// "press" and the name of a key that the observer presses, as "response screen@2+0.5=press 7": keys that
/// write, space and enter go on, as at a keyboard; where an answer is awaited, they answer. "press 7 for 0.4"
/// holds the key for so many seconds, 0.08 if that is left out. While an answer is awaited, "type WORDS"
/// types, a letter each 0.05 s; "click RIGHT DOWN" clicks at a place from the middle of the screen in pixels;
/// "drag RIGHT DOWN RIGHT DOWN" drags from one place to another in 0.2 s; "wheel STEPS" turns the mouse's
/// wheel. Throws InputError that says what may stand there.
ScriptedOperatorKey read_operator_key(std::string_view text, int reasons);

} // namespace overt
