#include "experiment/protocol/key_rows.h"

namespace overt::key_rows {

Section block() {
    using B = BlockSettings;
    return {
        .name = "block",
        .explanation =
            "A part of the session with an order of its own. Without any block, all trials are one, in "
            "random "
            "order. The limits of `[schedule]` hold in each block that does not set them itself, but for two "
            "cases, in which they would contradict what the block says: a sequential order has only limits "
            "of "
            "its own, and one blocked by a factor has none from there on this factor (by stimulus: none on "
            "stimulus, "
            "sculpture and material).",
        .keys =
            {
                {{.name = "id",
                  .is_required = true,
                  .is_identifier = true,
                  .explanation = "Short name, used in tables."},
                 &B::id},
                {{.name = "tasks",
                  .is_identifier = true,
                  .if_left_out = "all",
                  .explanation =
                      "Which tasks are asked, by their ids. Their order is that of a sequential block."},
                 &B::tasks},
                {{.name = "sculptures",
                  .is_identifier = true,
                  .if_left_out = "all",
                  .explanation = "Which sculptures are shown, by their ids."},
                 &B::sculptures},
                {{.name = "materials",
                  .is_identifier = true,
                  .if_left_out = "all",
                  .explanation = "Which materials they have, by their ids."},
                 &B::materials},
                {{.name = "stimuli",
                  .if_left_out = "as each task says",
                  .explanation = "Which stimuli the tasks are asked for in this block."},
                 &B::stimuli},
                {{.name = "order",
                  .explanation =
                      "Random: every order that keeps to the limits is equally probable. Sequential: task by "
                      "task, sculpture by sculpture, material by material, as listed. Blocked: all trials of "
                      "one "
                      "level of the factor `by`, then all of the next; random within a level. Weighted: the "
                      "levels of `by` come more or less often, by `weights`."},
                 &B::order},
                {{.name = "by", .explanation = "Factor by whose levels a blocked or weighted order goes."},
                 &B::by},
                {{.name = "levels",
                  .explanation = "Order of the levels of a blocked order: random for each session, fixed as "
                                 "listed, or by "
                                 "the rows of a Latin square over the observers."},
                 &B::levels},
                {{.name = "weights",
                  .low = 0,
                  .high = 10000,
                  .if_left_out = "all 1",
                  .explanation = "Of a weighted order, a number for each level of `by`: how often each of "
                                 "its trials comes, "
                                 "which must be whole numbers; with `draws`, in proportion to which the "
                                 "levels are drawn."},
                 &B::weights},
                {{.name = "draws",
                  .low = 1,
                  .high = 2000,
                  .if_left_out = "none: the weights are counts",
                  .explanation =
                      "Of a weighted order: so many trials are drawn with replacement, a level by its weight "
                      "and one of its trials evenly."},
                 &B::draws},
                {{.name = "repetitions",
                  .low = 1,
                  .high = 1000,
                  .explanation = "How often the block's trials come."},
                 &B::repetitions},
                {{.name = "repetition_order",
                  .explanation = "One repetition is over before the next begins, or all are mixed."},
                 &B::repetition_order},
                {{.name = "instructions",
                  .if_left_out = "none",
                  .explanation = "What the observer reads before the block, until a key is pressed."},
                 &B::instructions},
                {{.name = "continues",
                  .explanation =
                      "The limits count the trials of the block before, too, and both are drawn "
                      "together; otherwise each block begins afresh, and its order does not depend "
                      "on any other block."},
                 &B::continues},
                {{.name = "max_task_run",
                  .low = 0,
                  .high = 1000,
                  .if_left_out = "as in `[schedule]`",
                  .explanation = "Longest run of trials with the same task in this block; 0 for no limit."},
                 &B::max_task_run},
                {{.name = "max_sculpture_run",
                  .low = 0,
                  .high = 1000,
                  .if_left_out = "as in `[schedule]`",
                  .explanation =
                      "Longest run of trials with the same sculpture in this block; 0 for no limit."},
                 &B::max_sculpture_run},
                {{.name = "max_material_run",
                  .low = 0,
                  .high = 1000,
                  .if_left_out = "as in `[schedule]`",
                  .explanation =
                      "Longest run of trials with the same material in this block; 0 for no limit."},
                 &B::max_material_run},
                {{.name = "max_stimulus_run",
                  .low = 0,
                  .high = 1000,
                  .if_left_out = "as in `[schedule]`",
                  .explanation =
                      "Longest run of trials with the same stimulus in this block; 0 for no limit."},
                 &B::max_stimulus_run},
                {{.name = "min_task_distance",
                  .low = 0,
                  .high = 1000,
                  .if_left_out = "as in `[schedule]`",
                  .explanation =
                      "Least distance of trials with the same task in this block; 0 for no limit."},
                 &B::min_task_distance},
                {{.name = "min_sculpture_distance",
                  .low = 0,
                  .high = 1000,
                  .if_left_out = "as in `[schedule]`",
                  .explanation =
                      "Least distance of trials with the same sculpture in this block; 0 for no limit."},
                 &B::min_sculpture_distance},
                {{.name = "min_material_distance",
                  .low = 0,
                  .high = 1000,
                  .if_left_out = "as in `[schedule]`",
                  .explanation =
                      "Least distance of trials with the same material in this block; 0 for no limit."},
                 &B::min_material_distance},
                {{.name = "min_stimulus_distance",
                  .low = 0,
                  .high = 1000,
                  .if_left_out = "as in `[schedule]`",
                  .explanation =
                      "Least distance of trials with the same stimulus in this block; 0 for no limit."},
                 &B::min_stimulus_distance},
            },
        .home = &Protocol::blocks};
}

Section group() {
    using G = GroupSettings;
    return {.name = "group",
            .explanation = "A group of observers, for what differs between observers. Observers are assigned "
                           "by their number: "
                           "in turn, first to the first group, a group that is full being passed over. "
                           "Squares and rotations "
                           "go round within each group. Without any group, all observers see the same.",
            .keys =
                {
                    {{.name = "id",
                      .is_required = true,
                      .is_identifier = true,
                      .explanation = "Short name, used in tables."},
                     &G::id},
                    {{.name = "cap",
                      .low = 0,
                      .high = 10000,
                      .explanation =
                          "Most observers in the group; 0 for no limit. An observer whose number is beyond "
                          "all caps is refused."},
                     &G::cap},
                    {{.name = "blocks",
                      .is_identifier = true,
                      .if_left_out = "all",
                      .explanation = "Which blocks these observers do, by their ids."},
                     &G::blocks},
                    {{.name = "tasks",
                      .is_identifier = true,
                      .if_left_out = "all",
                      .explanation = "Which tasks they are asked."},
                     &G::tasks},
                    {{.name = "sculptures",
                      .is_identifier = true,
                      .if_left_out = "all",
                      .explanation = "Which sculptures they see."},
                     &G::sculptures},
                    {{.name = "materials",
                      .is_identifier = true,
                      .if_left_out = "all",
                      .explanation = "Which materials they see."},
                     &G::materials},
                },
            .home = &Protocol::groups};
}

} // namespace overt::key_rows
