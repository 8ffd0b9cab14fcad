#include "experiment/protocol/key_rows.h"

namespace overt::key_rows {

Section<Protocol> protocol() {
    using P = Protocol;
    return {.name = "protocol",
            .explanation = "What the experiment is called.",
            .keys = {
                {{.name = "name",
                  .is_required = true,
                  .is_identifier = true,
                  .explanation = "Short name, used in file names."},
                 &P::name},
                {{.name = "title", .if_left_out = "the name", .explanation = "Name for people to read."},
                 &P::title},
            }};
}

Section<ScheduleSettings> schedule() {
    using S = ScheduleSettings;
    return {
        .name = "schedule",
        .explanation = "How many observers there will be, and what the random order of their trials has "
                       "to keep to.",
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
                {{.name = "max_sculpture_run",
                  .low = 0,
                  .high = 1000,
                  .explanation = "Longest run of trials with the same sculpture; 0 for no limit. With a "
                                 "single sculpture it has no effect."},
                 &S::max_sculpture_run},
                {{.name = "max_task_run",
                  .low = 0,
                  .high = 1000,
                  .explanation = "Longest run of trials with the same task; 0 for no limit. With a single "
                                 "task it has no effect."},
                 &S::max_task_run},
            },
        .one = &Protocol::schedule};
}

Section<Task> task() {
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
                  .choices = task_coverages,
                  .explanation = "Asked for every sculpture in every material, or once per sculpture with "
                                 "the material changing from observer to observer."},
                 &T::stimuli},
                {{.name = "simulated_head_share",
                  .low = 0,
                  .high = 1,
                  .explanation = "Share of a simulated observer's fixations that go to the head."},
                 &T::simulated_head_share},
            },
        .many = &Protocol::tasks};
}

} // namespace overt::key_rows
