#include "experiment/protocol/keys/key_rows.h"

namespace overt::key_rows {

namespace {

/// Keys that every keyboard has: named ones, and letters and digits by what they write.
constexpr std::string_view key_names[] = {"escape", "f1",  "f2",  "f3",    "f4", "f5", "f6", "f7", "f8", "f9",
                                          "f10",    "f11", "f12", "pause", "a",  "b",  "c",  "d",  "e",  "f",
                                          "g",      "h",   "i",   "j",     "k",  "l",  "m",  "n",  "o",  "p",
                                          "q",      "r",   "s",   "t",     "u",  "v",  "w",  "x",  "y",  "z"};
constexpr std::string_view letter_names[] = {"a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l", "m",
                                             "n", "o", "p", "q", "r", "s", "t", "u", "v", "w", "x", "y", "z"};

} // namespace

std::vector<Key> consent() {
    using C = ConsentSettings;
    return {
        {"text", &C::text, left_out("the observer is not asked"), "What is read. Both keys stand below it."},
        {"accept_key", &C::accept_key, one_of(letter_names), "Agrees."},
        {"decline_key", &C::decline_key, one_of(letter_names), "Declines."},
    };
}

std::vector<Key> instructions() {
    using I = InstructionSettings;
    return {
        {"pages", &I::pages, left_out("none"), "The texts."},
    };
}

std::vector<Key> operators() {
    using O = OperatorSettings;
    return {
        {"pause", &O::pause, one_of(key_names), "Pauses, and goes on."},
        {"recalibrate", &O::recalibrate, one_of(key_names), "Calibrates the eye tracker anew."},
        {"repeat", &O::repeat, one_of(key_names), "Breaks the trial off; it comes again at once."},
        {"reject", &O::reject, one_of(key_names),
         "Breaks the trial off; it comes again as `[repeat] rejected` says."},
        {"skip", &O::skip, one_of(key_names), "Breaks the trial off; it does not come again."},
        {"abort", &O::abort, one_of(key_names), "Ends the session; in an animation, the trial first."},
        {"yes", &O::yes, one_of(letter_names), "Confirms."},
        {"no", &O::no, one_of(letter_names), "Takes it back."},
        {"keyboard_answers", &O::keyboard_answers,
         "Whether the window's keyboard also answers for the observer. `false`: it is the operator's alone, "
         "and the observer answers at a `[[button_box]]`; the form is still filled in at the keyboard."},
        {"pause_text", &O::pause_text, "What stands on the screen in a pause."},
        {"skip_reasons", &O::skip_reasons, left_out("eye lost, observer's wish, equipment, other"),
         "Why a trial is skipped, to be chosen by a digit."},
    };
}

std::vector<Key> answers() {
    using A = AnswerSettings;
    return {
        {"record", &A::record,
         "Required: no session without a sound device. Optional: a machine without one says so, and goes "
         "on."},
        {"device", &A::device, left_out("the system's default"),
         "Part of the sound device's name, as `overt doctor` lists it."},
        {"sample_rate_hz", &A::sample_rate_hz, range(8000, 192000, "Hz"), "Of the recording."},
        {"bits", &A::bits, range(16, 24), "Of a sample: 16 or 24."},
        {"meter_on_screen", &A::meter_on_screen,
         "A level meter below the text of the response screen, with a word when it is too loud or no voice "
         "is heard. Off by default, for who sees it speaks to it; the operator's terminal has a meter "
         "always. Its words are in `[words]`."},
    };
}

std::vector<Key> observer_fields() {
    using F = ObserverFieldSettings;
    return {
        {"id", &F::id, identifier().required(), "Short name, used in tables."},
        {"title", &F::title, left_out("the standard field's, or the id"), "What is asked."},
        {"kind", &F::kind, left_out("the standard field's, or `\"text\"`"), "What may stand there."},
        {"choices", &F::choices, left_out("the standard field's, or none"),
         "Of a choice: what there is to choose from."},
        {"min", &F::min, left_out("the standard field's, or no limit"), "Of a number: the smallest."},
        {"max", &F::max, left_out("the standard field's, or no limit"), "Of a number: the largest."},
        {"required", &F::required, "Whether the field must be filled in before the session goes on."},
        {"note", &F::note, left_out("none"), "Shown while the field is filled in."},
        {"steps", &F::steps, range(2, 11), "Of a scale: how many numbers it has, from 1."},
        {"ends", &F::ends, left_out("none"), "Of a scale: what its first and its last step mean."},
        {"when", &F::when,
         "When the observer is asked: `\"begin\"` of the session, its `\"end\"`, or `\"block:ID\"`, once the "
         "trials of that block are done."},
    };
}

} // namespace overt::key_rows
