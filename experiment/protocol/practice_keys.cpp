#include "experiment/protocol/key_rows.h"

namespace overt::key_rows {

Section practice() {
    using P = PracticeSettings;
    return {
        .name = "practice",
        .explanation =
            "A trial before the trials that count, to learn the task by. They come in the order of the file. "
            "Of a practice trial the session notes that it was, and what was answered; no flips, no samples.",
        .keys =
            {
                {{.name = "task",
                  .is_required = true,
                  .is_identifier = true,
                  .explanation = "Id of the task."},
                 &P::task},
                {{.name = "sculpture",
                  .is_required = true,
                  .is_identifier = true,
                  .explanation = "Id of the sculpture."},
                 &P::sculpture},
                {{.name = "material",
                  .is_required = true,
                  .is_identifier = true,
                  .explanation = "Id of the material."},
                 &P::material},
                {{.name = "block",
                  .is_identifier = true,
                  .if_left_out = "the first of the session",
                  .explanation = "Id of the block that it comes before."},
                 &P::block},
                {{.name = "feedback",
                  .if_left_out = "none",
                  .explanation = "What the observer reads after the answer, until a key is pressed."},
                 &P::feedback},
            },
        .home = &Protocol::practice};
}

Section breaks() {
    using B = BreakSettings;
    return {.name = "breaks",
            .explanation = "Rests between trials; never before the first or after the last.",
            .keys =
                {
                    {{.name = "every_trials",
                      .low = 0,
                      .high = 2000,
                      .explanation =
                          "A break after so many trials since the last one, repeated ones counted; 0 for "
                          "none."},
                     &B::every_trials},
                    {{.name = "between_blocks", .explanation = "A break before each block but the first."},
                     &B::between_blocks},
                    {{.name = "pace",
                      .explanation =
                          "Self: a key goes on, after `min_s` at the earliest. Timed: goes on by itself "
                          "after `duration_s`."},
                     &B::pace},
                    {{.name = "duration_s",
                      .unit = "s",
                      .low = 0,
                      .high = 3600,
                      .explanation =
                          "Length of a timed break; of a self-paced one, what `overt check` reckons with."},
                     &B::duration_s},
                    {{.name = "min_s",
                      .unit = "s",
                      .low = 0,
                      .high = 3600,
                      .explanation = "Before a key ends a self-paced break."},
                     &B::min_s},
                    {{.name = "text", .explanation = "What stands on the screen meanwhile."}, &B::text},
                },
            .home = &Protocol::breaks};
}

Section repeat() {
    using R = RepeatSettings;
    return {
        .name = "repeat",
        .explanation = "What becomes of a trial that failed: it comes again now, or at the end of its block, "
                       "or never. An "
                       "attempt that is repeated stays in the record as aborted, beside the one that counts. "
                       "Limits on the "
                       "order do not look at repeated trials.",
        .keys =
            {
                {{.name = "missed_refreshes",
                  .explanation = "When a trial comes again that missed more than `missed_refreshes_limit`."},
                 &R::missed_refreshes},
                {{.name = "missed_refreshes_limit",
                  .low = 0,
                  .high = 100000,
                  .explanation = "Most missed refreshes of a presentation that counts."},
                 &R::missed_refreshes_limit},
                {{.name = "gaze_lost",
                  .explanation = "When a trial comes again in which the eye was lost for longer than "
                                 "`gaze_lost_limit`."},
                 &R::gaze_lost},
                {{.name = "gaze_lost_limit",
                  .low = 0,
                  .high = 1,
                  .explanation = "Largest share of a presentation's samples without gaze (blinks among them) "
                                 "with which it counts."},
                 &R::gaze_lost_limit},
                {{.name = "rejected", .explanation = "When a trial comes again that the operator rejected."},
                 &R::rejected},
                {{.name = "most_attempts",
                  .low = 1,
                  .high = 100,
                  .explanation =
                      "At one trial. The last one counts however it went, unless it was rejected."},
                 &R::most_attempts},
            },
        .home = &Protocol::repeat};
}

} // namespace overt::key_rows
