#include "experiment/protocol/key_rows.h"

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

Section consent() {
    using C = ConsentSettings;
    return {
        .name = "consent",
        .explanation = "A text that the observer has to agree to before anything else. Who declines ends the "
                       "session: that is all that is recorded then. The record keeps who agreed, when, and "
                       "the SHA-256 of the text.",
        .keys =
            {
                {{.name = "text",
                  .if_left_out = "the observer is not asked",
                  .explanation = "What is read. Both keys stand below it."},
                 &C::text},
                {{.name = "accept_key", .choices = letter_names, .explanation = "Agrees."}, &C::accept_key},
                {{.name = "decline_key", .choices = letter_names, .explanation = "Declines."},
                 &C::decline_key},
            },
        .home = &Protocol::consent};
}

Section instructions() {
    using I = InstructionSettings;
    return {.name = "instructions",
            .explanation =
                "What the observer reads after the welcome, page by page: backspace or the left arrow "
                "go back, any other key that writes, enter or the right arrow go on.",
            .keys =
                {
                    {{.name = "pages", .if_left_out = "none", .explanation = "The texts."}, &I::pages},
                },
            .home = &Protocol::instructions};
}

Section operators() {
    using O = OperatorSettings;
    const auto key = [](std::string_view name, std::string O::*member, std::string_view explanation) {
        return Key{{.name = name, .choices = key_names, .explanation = explanation}, member};
    };
    return {
        .name = "operator",
        .explanation =
            "Keys with which the operator leads a session. All but pausing ask first, and all are in the "
            "record. "
            "What is pressed during an animation is acted on after its last refresh; `abort` alone ends it. "
            "Whether a trial that was broken off and yet not skipped comes again is as for one that is "
            "rejected.",
        .keys =
            {
                key("pause", &O::pause, "Pauses, and goes on."),
                key("recalibrate", &O::recalibrate, "Calibrates the eye tracker anew."),
                key("repeat", &O::repeat, "Breaks the trial off; it comes again at once."),
                key("reject", &O::reject,
                    "Breaks the trial off; it comes again as `[repeat] rejected` says."),
                key("skip", &O::skip, "Breaks the trial off; it does not come again."),
                key("abort", &O::abort, "Ends the session; in an animation, the trial first."),
                {{.name = "yes", .choices = letter_names, .explanation = "Confirms."}, &O::yes},
                {{.name = "no", .choices = letter_names, .explanation = "Takes it back."}, &O::no},
                {{.name = "keyboard_answers",
                  .explanation =
                      "Whether the window's keyboard also answers for the observer. `false`: it is "
                      "the operator's alone, and the observer answers at a `[[button_box]]`; the "
                      "form is still filled in at the keyboard."},
                 &O::keyboard_answers},
                {{.name = "pause_text", .explanation = "What stands on the screen in a pause."},
                 &O::pause_text},
                {{.name = "skip_reasons",
                  .if_left_out = "eye lost, observer's wish, equipment, other",
                  .explanation = "Why a trial is skipped, to be chosen by a digit."},
                 &O::skip_reasons},
            },
        .home = &Protocol::operators};
}

Section answers() {
    using A = AnswerSettings;
    return {
        .name = "answers",
        .explanation =
            "Spoken answers: a WAV file for each trial that counts, from the end of the animation to the key "
            "that ends the answer, with the sample at the response screen's onset, the onset of the voice, "
            "clipping and silence in the record.",
        .keys =
            {
                {{.name = "record",
                  .explanation = "Required: no session without a sound device. Optional: a machine without "
                                 "one says so, and goes on."},
                 &A::record},
                {{.name = "device",
                  .if_left_out = "the system's default",
                  .explanation = "Part of the sound device's name, as `overt doctor` lists it."},
                 &A::device},
                {{.name = "sample_rate_hz",
                  .unit = "Hz",
                  .low = 8000,
                  .high = 192000,
                  .explanation = "Of the recording."},
                 &A::sample_rate_hz},
                {{.name = "bits", .low = 16, .high = 24, .explanation = "Of a sample: 16 or 24."}, &A::bits},
                {{.name = "meter_on_screen",
                  .explanation =
                      "A level meter below the text of the response screen, with a word when it is "
                      "too loud or no voice is heard. Off by default, for who sees it speaks to "
                      "it; the operator's terminal has a meter always. Its words are in "
                      "`[words]`."},
                 &A::meter_on_screen},
            },
        .home = &Protocol::answers};
}

Section observer_fields() {
    using F = ObserverFieldSettings;
    return {
        .name = "observer_field",
        .explanation =
            "Something to be known of the observer. The form is filled in with `--observer-field ID=VALUE`, "
            "or before the session in its window or in the terminal. Standard fields have all but their id "
            "by default: `age` (in years), `sex` (female, male, other), `vision` (normal, corrected to "
            "normal, impaired), `handedness` (left, right, ambidextrous).",
        .keys =
            {
                {{.name = "id",
                  .is_required = true,
                  .is_identifier = true,
                  .explanation = "Short name, used in tables."},
                 &F::id},
                {{.name = "title",
                  .if_left_out = "the standard field's, or the id",
                  .explanation = "What is asked."},
                 &F::title},
                {{.name = "kind",
                  .if_left_out = "the standard field's, or `\"text\"`",
                  .explanation = "What may stand there."},
                 &F::kind},
                {{.name = "choices",
                  .if_left_out = "the standard field's, or none",
                  .explanation = "Of a choice: what there is to choose from."},
                 &F::choices},
                {{.name = "min",
                  .if_left_out = "the standard field's, or no limit",
                  .explanation = "Of a number: the smallest."},
                 &F::min},
                {{.name = "max",
                  .if_left_out = "the standard field's, or no limit",
                  .explanation = "Of a number: the largest."},
                 &F::max},
                {{.name = "required",
                  .explanation = "Whether a session begins only when the field is filled in."},
                 &F::required},
                {{.name = "note",
                  .if_left_out = "none",
                  .explanation = "Shown while the field is filled in."},
                 &F::note},
            },
        .home = &Protocol::observer_fields};
}

} // namespace overt::key_rows
