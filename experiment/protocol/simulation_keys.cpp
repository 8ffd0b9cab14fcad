#include "experiment/protocol/key_rows.h"

namespace overt::key_rows {

Section simulated_observers() {
    using S = SimulatedObserverSettings;
    return {.name = "simulated_observers",
            .explanation = "How simulated observers differ from one another, as people do.",
            .keys = {{{.name = "head_share_sd",
                       .low = 0,
                       .high = 5,
                       .explanation =
                           "Standard deviation, over simulated observers, of the logit of their shares of "
                           "fixations on the head; 0: all have the task's."},
                      &S::head_share_sd}},
            .home = &Protocol::simulated_observers};
}

Section simulated_effect() {
    using E = SimulatedEffect;
    return {
        .name = "simulated_effect",
        .explanation = "What the gaze of simulated observers depends on besides the task: effects of known "
                       "size for a study to "
                       "find. Each holds in the trials with its task, sculpture and material; several can "
                       "hold in one trial.",
        .keys =
            {
                {{.name = "task",
                  .is_identifier = true,
                  .if_left_out = "any",
                  .explanation = "Id of the task."},
                 &E::task},
                {{.name = "sculpture",
                  .is_identifier = true,
                  .if_left_out = "any",
                  .explanation = "Id of the sculpture."},
                 &E::sculpture},
                {{.name = "material",
                  .is_identifier = true,
                  .if_left_out = "any",
                  .explanation = "Id of the material."},
                 &E::material},
                {{.name = "head_odds",
                  .low = 0.001,
                  .high = 1000,
                  .explanation =
                      "How many times the odds of the task's `simulated_head_share` those of a fixation on "
                      "the head are; 1: the same."},
                 &E::head_odds},
                {{.name = "spot_share",
                  .low = 0,
                  .high = 1,
                  .explanation = "Share of the fixations that go to one spot of each sculpture, the effect's "
                                 "own and the "
                                 "same for all observers, instead of to its head or elsewhere."},
                 &E::spot_share},
                {{.name = "spread",
                  .low = -4,
                  .high = 1.2,
                  .explanation =
                      "How widely the fixations that go to no spot lie, and so their WSS: places at r times "
                      "the "
                      "usual distance from the sculpture's middle are looked at exp(spread * r^2) times as "
                      "often as their area says; 0: by area alone. `overt power --effect wss:…` tells which "
                      "spread makes a ratio of WSS."},
                 &E::spread},
            },
        .home = &Protocol::simulated_effects};
}

} // namespace overt::key_rows
