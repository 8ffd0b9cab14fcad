#include "experiment/protocol/keys/key_rows.h"

namespace overt::key_rows {

namespace {

/// All but that of the objects, for each of which the task is asked.
constexpr auto lists_to_rotate = [] {
    std::array<std::string_view, stimulus_lists.size() - 1> names{};
    for (std::size_t list = 0; list < names.size(); ++list)
        names[list] = stimulus_lists[list + 1].name;
    return names;
}();
static_assert(stimulus_lists[0].index == &Stimulus::object);

} // namespace

std::vector<Key> protocol() {
    using P = Protocol;
    return {
        {"name", &P::name, identifier().required(), "Short name, used in file names."},
        {"title", &P::title, left_out("the name"), "Name for people to read."},
    };
}

std::vector<Key> schedule() {
    using S = ScheduleSettings;
    return {
        {"observers", &S::observers, range(1, 10000),
         "Planned number of observers; each stimulus is seen equally often under every task if it is a "
         "multiple of the number of materials."},
        {"seed", &S::seed, at_least(0).left_out("drawn anew for each session, and recorded"),
         "Start of all random numbers."},
        {"max_task_run", &S::max_task_run, range(0, 1000),
         "Longest run of trials with the same task; 0 for no limit. With a single task it has no effect."},
        {"max_object_run", &S::max_object_run, range(0, 1000),
         "Longest run of trials with the same object; 0 for no limit. With a single object it has no "
         "effect."},
        {"max_material_run", &S::max_material_run, range(0, 1000),
         "Longest run of trials with the same material; 0 for no limit. With a single material it has no "
         "effect."},
        {"max_stimulus_run", &S::max_stimulus_run, range(0, 1000),
         "Longest run of trials with the same stimulus (object and material); 0 for no limit. With a "
         "single stimulus it has no effect."},
        {"min_task_distance", &S::min_task_distance, range(0, 1000),
         "Least distance of trials with the same task, in trials: 2 is never twice in a row, 3 leaves two "
         "others between them; 0 for no limit."},
        {"min_object_distance", &S::min_object_distance, range(0, 1000),
         "Least distance of trials with the same object, in trials: 2 is never twice in a row, 3 leaves "
         "two others between them; 0 for no limit."},
        {"min_material_distance", &S::min_material_distance, range(0, 1000),
         "Least distance of trials with the same material, in trials: 2 is never twice in a row, 3 leaves "
         "two others between them; 0 for no limit."},
        {"min_stimulus_distance", &S::min_stimulus_distance, range(0, 1000),
         "Least distance of trials with the same stimulus, in trials: 2 is never twice in a row, 3 leaves "
         "two others between them; 0 for no limit."},
        {"max_run", &S::max_run, range(0, 1000).left_out("no further limits"),
         "Longest run of trials with the same level, for any factors: `{gloss=3, light=2}`; 0 for no "
         "limit. Factors are the task, the lists that stimuli are made of, the columns of their entries, "
         "and the stimulus."},
        {"min_distance", &S::min_distance, range(0, 1000).left_out("no further limits"),
         "Least distance of trials with the same level, for any factors: `{gloss=2}`; 0 for no limit."},
        {"rotated_list", &S::rotated_list, one_of(lists_to_rotate),
         "Which list goes round over the observers in tasks that are asked once per object; of the others "
         "each entry is shown."},
        {"material_rotation", &S::material_rotation,
         "How the materials, or the entries of `rotated_list`, go round over the observers: shifted "
         "by one from observer to observer; by the rows of a balanced (Williams) square, in which each "
         "material also follows each other one equally often; or by random squares, a new one for each round "
         "of observers. A balanced square of an odd number of materials takes twice as many observers."},
        {"block_order", &S::block_order,
         "Order of the blocks: random for each session; fixed, as they stand in the file; or by the rows of "
         "a Latin square over the observers, as for `material_rotation`."},
        {"rotation_seed", &S::rotation_seed, range(0, 2147483647),
         "Start of the random squares. All observers of an experiment share them, so they do not depend on "
         "`seed`."},
    };
}

std::vector<Key> task() {
    using T = Task;
    return {
        {"id", &T::id, identifier().left_out("`task`; of several tasks `task-1`, `task-2`, …"),
         "Short name, used in file names and tables."},
        {"question", &T::question, required(), "What the observer reads before the animation."},
        {"stimuli", &T::stimuli,
         "Asked for every object in every material, or once per object with the material changing from "
         "observer to observer."},
        {"steps", &T::steps,
         left_out("the question until a key is pressed, the drift check, the stimulus for the motion's "
                  "duration, the spoken answer"),
         "What a trial does, one step after another, such as `[{fixation=0.5}, {show=\"centre\"}, "
         "{answer=\"spoken\"}]`; see [design.md](design.md)."},
        {"slots", &T::slots, identifier().left_out("the only slot there is"),
         "Ids of the `[[slot]]`s in which the task's stimuli are shown, all at once; of a circle or a grid, "
         "all its places. Each shows the stimulus that the trial has for it."},
        {"trials", &T::trials_file, left_out("every stimulus"),
         "Which trials the task has: a rule, or the path of a table (CSV, TSV) with a row for each; see "
         "[design.md](design.md)."},
        {"repetitions", &T::repetitions, range(1, 1000), "How often each of its trials comes."},
        {"draw_points", &T::draw_points, range(1, 100000).left_out("all"),
         "Of a task with `[[task.probe]]`s: so many of the places, or pairs of places, are drawn for each "
         "observer, the same in all of their stimuli."},
        {"simulated_head_share", &T::simulated_head_share,
         range(0, 1).left_out("0.4; 0 with `simulated_area_shares`"),
         "Share of a simulated observer's fixations that go to the head."},
        {"simulated_area_shares", &T::simulated_area_shares,
         range(0, 1).left_out("none but the head has one"),
         "Shares that go to other areas, by their names: what they leave goes to the rest of the "
         "surface. Areas that have shares must not overlap."},
    };
}

} // namespace overt::key_rows
