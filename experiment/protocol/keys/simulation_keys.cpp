#include "experiment/protocol/keys/key_rows.h"

namespace overt::key_rows {

std::vector<Key> simulated_observers() {
    using S = SimulatedObserverSettings;
    return {{"head_share_sd", &S::head_share_sd, range(0, 5),
             "Standard deviation, over simulated observers, of the logit of their shares of fixations on the "
             "head, and on each other area that has a share; 0: all have the task's."}};
}

std::vector<Key> simulated_effect() {
    using E = SimulatedEffect;
    std::vector<Key> keys{
        {"task", &E::task, identifier().left_out("any"), "Id of the task."},
        {"where", &E::where, left_out("any"), "Levels of columns of the entries: `{gloss=\"high\"}`."},
        {"head_odds", &E::head_odds, range(0.001, 1000),
         "How many times the odds of the task's `simulated_head_share` those of a fixation on the head are; "
         "1: the same."},
        {"area", &E::area, identifier().left_out("see `head_odds`"), "The area that `area_odds` is of."},
        {"area_odds", &E::area_odds, range(0.001, 1000),
         "How many times the odds of the task's share of the area (`simulated_area_shares`) those of a "
         "fixation "
         "on it are; what the area gains all else loses in proportion."},
        {"spot_share", &E::spot_share, range(0, 1),
         "Share of the fixations that go to one spot of each object, the effect's own and the same for "
         "all observers, instead of to its areas or elsewhere."},
        {"spread", &E::spread, range(-4, 1.2),
         "How widely the fixations that go to no spot lie, and so their WSS: places at r times the usual "
         "distance from the object's middle are looked at exp(spread * r^2) times as often as their area "
         "says; 0: by area alone. `overt power --effect wss:…` tells which spread makes a ratio of WSS."},
        {"answer", &E::answer, identifier().left_out("none"),
         "Id of the answer that `answer_shift`, `answer_slope` and `answer_odds` are of."},
        {"answer_shift", &E::answer_shift, range(-1e6, 1e6),
         "What is on top of the judgement of such a stimulus: of choices by a factor in standard deviations "
         "of the judgement, so that a threshold moves by -answer_shift / slope; of scales and numbers in "
         "their own units. Among slots that show such stimuli all alike it changes nothing."},
        {"answer_slope", &E::answer_slope, range(0.001, 1000),
         "How many times the `slope`, or the `gain`, of `simulated` in trials that show such stimuli only."},
        {"answer_odds", &E::answer_odds, range(0.001, 1000),
         "How many times the odds of `share_correct` in trials that show such stimuli only."},
    };
    add_entry_keys(keys, &E::entries, "any");
    return keys;
}

} // namespace overt::key_rows
