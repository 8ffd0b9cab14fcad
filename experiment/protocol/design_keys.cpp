#include "experiment/protocol/key_rows.h"

namespace overt::key_rows {

Section protocol() {
    using P = Protocol;
    return {.name = "protocol",
            .explanation = "What the experiment is called.",
            .keys =
                {
                    {{.name = "name",
                      .is_required = true,
                      .is_identifier = true,
                      .explanation = "Short name, used in file names."},
                     &P::name},
                    {{.name = "title", .if_left_out = "the name", .explanation = "Name for people to read."},
                     &P::title},
                },
            .home = SectionHome::root<Protocol>()};
}

Section schedule() {
    using S = ScheduleSettings;
    return {
        .name = "schedule",
        .explanation = "How many observers there will be, and what the order of their trials has to keep to. "
                       "The limits hold within each block.",
        .keys =
            {
                {{.name = "observers",
                  .low = 1,
                  .high = 10000,
                  .explanation = "Planned number of observers; each stimulus is seen equally often under "
                                 "every task if it is a multiple of the number of materials."},
                 &S::observers},
                {{.name = "seed",
                  .low = 0,
                  .if_left_out = "drawn anew for each session, and recorded",
                  .explanation = "Start of all random numbers."},
                 &S::seed},
                {{.name = "max_task_run",
                  .low = 0,
                  .high = 1000,
                  .explanation = "Longest run of trials with the same task; 0 for no limit. With a single "
                                 "task it has no effect."},
                 &S::max_task_run},
                {{.name = "max_sculpture_run",
                  .low = 0,
                  .high = 1000,
                  .explanation = "Longest run of trials with the same sculpture; 0 for no limit. With a "
                                 "single sculpture it has no effect."},
                 &S::max_sculpture_run},
                {{.name = "max_material_run",
                  .low = 0,
                  .high = 1000,
                  .explanation = "Longest run of trials with the same material; 0 for no limit. With a "
                                 "single material it has no effect."},
                 &S::max_material_run},
                {{.name = "max_stimulus_run",
                  .low = 0,
                  .high = 1000,
                  .explanation = "Longest run of trials with the same stimulus (sculpture and material); 0 "
                                 "for no limit. With a single stimulus it has no effect."},
                 &S::max_stimulus_run},
                {{.name = "min_task_distance",
                  .low = 0,
                  .high = 1000,
                  .explanation = "Least distance of trials with the same task, in trials: 2 is never twice "
                                 "in a row, 3 leaves two others between them; 0 for no limit."},
                 &S::min_task_distance},
                {{.name = "min_sculpture_distance",
                  .low = 0,
                  .high = 1000,
                  .explanation =
                      "Least distance of trials with the same sculpture, in trials: 2 is never twice "
                      "in a row, 3 leaves two others between them; 0 for no limit."},
                 &S::min_sculpture_distance},
                {{.name = "min_material_distance",
                  .low = 0,
                  .high = 1000,
                  .explanation =
                      "Least distance of trials with the same material, in trials: 2 is never twice "
                      "in a row, 3 leaves two others between them; 0 for no limit."},
                 &S::min_material_distance},
                {{.name = "min_stimulus_distance",
                  .low = 0,
                  .high = 1000,
                  .explanation =
                      "Least distance of trials with the same stimulus, in trials: 2 is never twice "
                      "in a row, 3 leaves two others between them; 0 for no limit."},
                 &S::min_stimulus_distance},
                {{.name = "material_rotation",
                  .explanation =
                      "How the materials of tasks that are asked once per sculpture go round over the "
                      "observers: "
                      "shifted by one from observer to observer; by the rows of a balanced (Williams) "
                      "square, in "
                      "which each material also follows each other one equally often; or by random squares, "
                      "a "
                      "new one for each round of observers. A balanced square of an odd number of materials "
                      "takes twice as many observers."},
                 &S::material_rotation},
                {{.name = "block_order",
                  .explanation =
                      "Order of the blocks: random for each session; fixed, as they stand in the file; "
                      "or by the rows of a Latin square over the observers, as for "
                      "`material_rotation`."},
                 &S::block_order},
                {{.name = "rotation_seed",
                  .low = 0,
                  .high = 2147483647,
                  .explanation = "Start of the random squares. All observers of an experiment share them, so "
                                 "they do not depend on `seed`."},
                 &S::rotation_seed},
            },
        .home = &Protocol::schedule};
}

Section task() {
    using T = Task;
    return {
        .name = "task",
        .explanation = "A question that observers are asked about what they see. At least one.",
        .keys =
            {
                {{.name = "id",
                  .is_required = true,
                  .is_identifier = true,
                  .explanation = "Short name, used in file names and tables."},
                 &T::id},
                {{.name = "question",
                  .is_required = true,
                  .explanation = "What the observer reads before the animation."},
                 &T::question},
                {{.name = "stimuli",
                  .explanation = "Asked for every sculpture in every material, or once per sculpture with "
                                 "the material changing from observer to observer."},
                 &T::stimuli},
                {{.name = "simulated_head_share",
                  .low = 0,
                  .high = 1,
                  .explanation = "Share of a simulated observer's fixations that go to the head."},
                 &T::simulated_head_share},
            },
        .home = &Protocol::tasks};
}

} // namespace overt::key_rows
