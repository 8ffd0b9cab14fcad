#include "experiment/protocol/keys/key_rows.h"

namespace overt::key_rows {

std::vector<Key> practice() {
    using P = PracticeSettings;
    std::vector<Key> keys{
        {"task", &P::task, identifier().required(), "Id of the task."},
        {"block", &P::block, identifier().left_out("the first of the session"),
         "Id of the block that it comes before."},
        {"feedback", &P::feedback, left_out("none"),
         "What the observer reads after the answer, until a key is pressed."},
    };
    add_entry_keys(keys, &P::entries, "the first");
    return keys;
}

std::vector<Key> breaks() {
    using B = BreakSettings;
    return {
        {"every_trials", &B::every_trials, range(0, 2000),
         "A break after so many trials since the last one, repeated ones counted; 0 for none."},
        {"between_blocks", &B::between_blocks, "A break before each block but the first."},
        {"pace", &B::pace,
         "Self: a key goes on, after `min_s` at the earliest. Timed: goes on by itself after `duration_s`."},
        {"duration_s", &B::duration_s, range(0, 3600, "s"),
         "Length of a timed break; of a self-paced one, what `overt check` reckons with."},
        {"min_s", &B::min_s, range(0, 3600, "s"), "Before a key ends a self-paced break."},
        {"text", &B::text, "What stands on the screen meanwhile."},
    };
}

std::vector<Key> repeat() {
    using R = RepeatSettings;
    return {
        {"missed_refreshes", &R::missed_refreshes,
         "When a trial comes again that missed more than `missed_refreshes_limit`."},
        {"missed_refreshes_limit", &R::missed_refreshes_limit, range(0, 100000),
         "Most missed refreshes of a presentation that counts."},
        {"gaze_lost", &R::gaze_lost,
         "When a trial comes again in which the eye was lost for longer than `gaze_lost_limit`."},
        {"gaze_lost_limit", &R::gaze_lost_limit, range(0, 1),
         "Largest share of a presentation's samples without gaze (blinks among them) with which it counts."},
        {"rejected", &R::rejected,
         "When a trial comes again that the operator rejected or broke off, or in which the eye tracker was "
         "lost or its clock jumped."},
        {"most_attempts", &R::most_attempts, range(1, 100),
         "At one trial. The last one counts however it went, unless it was rejected."},
    };
}

} // namespace overt::key_rows
