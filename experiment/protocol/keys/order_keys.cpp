#include "experiment/protocol/keys/key_rows.h"

namespace overt::key_rows {

namespace {

/// A key for each list, that chooses of it. `words`: what it does, the list being {}.
template <class Struct>
void add_list_keys(std::vector<Key>& keys, ChosenEntries Struct::*chosen, std::string_view words) {
    static const auto explanations = [&] {
        std::array<std::string, stimulus_lists.size()> all;
        for (std::size_t list = 0; list < all.size(); ++list)
            all[list] = fmt::format(fmt::runtime(words), stimulus_lists[list].plural);
        return all;
    }();
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
        keys.emplace_back(stimulus_lists[list].plural, chosen, list, identifier().left_out("all"),
                          explanations[list]);
}

} // namespace

std::vector<Key> criterion() {
    using C = CriterionSettings;
    return {
        {"correct", &C::correct, range(1, 1000).required(), "How many have to be correct."},
        {"of_last", &C::of_last, range(0, 1000), "Of how many that came last; 0: of as many."},
        {"at_least", &C::at_least, range(0, 2000), "How many trials come at least."},
    };
}

std::vector<Key> block() {
    using B = BlockSettings;
    constexpr KeyLimits limit = range(0, 1000).left_out("as in `[schedule]`");
    std::vector<Key> keys{
        {"id", &B::id, identifier().required(), "Short name, used in tables."},
        {"tasks", &B::tasks, identifier().left_out("all"),
         "Which tasks are asked, by their ids. Their order is that of a sequential block."},
        {"stimuli", &B::stimuli, left_out("as each task says"),
         "Which stimuli the tasks are asked for in this block."},
        {"order", &B::order,
         "Random: every order that keeps to the limits is equally probable. Sequential: task by task, "
         "object by object, material by material, as listed. Blocked: all trials of one level of the "
         "factor `by`, then all of the next; random within a level. Weighted: the levels of `by` come more "
         "or less often, by `weights`."},
        {"by", &B::by,
         "Factor by whose levels a blocked or weighted order goes: `task`, a list (`object`, `material`, "
         "`light`, `motion`, `view`, `background`), `stimulus`, or a column of entries."},
        {"levels", &B::levels,
         "Order of the levels of a blocked order: random for each session, fixed as listed, or by the rows "
         "of a Latin square over the observers."},
        {"weights", &B::weights, range(0, 10000).left_out("all 1"),
         "Of a weighted order, a number for each level of `by`: how often each of its trials comes, which "
         "must be whole numbers; with `draws`, in proportion to which the levels are drawn."},
        {"draws", &B::draws, range(1, 2000).left_out("none: the weights are counts"),
         "Of a weighted order: so many trials are drawn with replacement, a level by its weight and one of "
         "its trials evenly."},
        {"repetitions", &B::repetitions, range(1, 1000), "How often the block's trials come."},
        {"repetition_order", &B::repetition_order,
         "One repetition is over before the next begins, or all are mixed."},
        {"instructions", &B::instructions, left_out("none"),
         "What the observer reads before the block, until a key is pressed."},
        {"feedback", &B::feedback, left_out("none"),
         "What the observer reads after the block, until a key is pressed: `{percent_correct}`, `{correct}`, "
         "`{answered}`, `{missed}`, `{trials}` and `{median_s}`, the median response time, stand for "
         "numbers."},
        {"practice", &B::practice,
         "Its trials are practice: all is recorded of them as of others, and marked, and no result is of "
         "them. Practice of which nothing is recorded is `[[practice]]`."},
        {"continues", &B::continues,
         "The limits count the trials of the block before, too, and both are drawn together; otherwise each "
         "block begins afresh, and its order does not depend on any other block."},
        {"max_run", &B::max_run, limit,
         "Longest run of trials with the same level of a factor in this block, for any factors: "
         "`{gloss=3}`; 0 for no limit."},
        {"min_distance", &B::min_distance, limit,
         "Least distance of trials with the same level of a factor in this block, for any factors: "
         "`{gloss=2}`; 0 for no limit."},
        {"max_task_run", &B::max_task_run, limit,
         "Longest run of trials with the same task in this block; 0 for no limit."},
        {"max_object_run", &B::max_object_run, limit,
         "Longest run of trials with the same object in this block; 0 for no limit."},
        {"max_material_run", &B::max_material_run, limit,
         "Longest run of trials with the same material in this block; 0 for no limit."},
        {"max_stimulus_run", &B::max_stimulus_run, limit,
         "Longest run of trials with the same stimulus in this block; 0 for no limit."},
        {"min_task_distance", &B::min_task_distance, limit,
         "Least distance of trials with the same task in this block; 0 for no limit."},
        {"min_object_distance", &B::min_object_distance, limit,
         "Least distance of trials with the same object in this block; 0 for no limit."},
        {"min_material_distance", &B::min_material_distance, limit,
         "Least distance of trials with the same material in this block; 0 for no limit."},
        {"min_stimulus_distance", &B::min_stimulus_distance, limit,
         "Least distance of trials with the same stimulus in this block; 0 for no limit."},
    };
    add_list_keys(keys, &B::chosen, "Which {} are shown, by their ids.");
    return keys;
}

std::vector<Key> group() {
    using G = GroupSettings;
    std::vector<Key> keys{
        {"id", &G::id, identifier().required(), "Short name, used in tables."},
        {"cap", &G::cap, range(0, 10000),
         "Most observers in the group; 0 for no limit. An observer whose number is beyond all caps is "
         "refused."},
        {"blocks", &G::blocks, identifier().left_out("all"),
         "Which blocks these observers do, by their ids."},
        {"tasks", &G::tasks, identifier().left_out("all"), "Which tasks they are asked."},
    };
    add_list_keys(keys, &G::chosen, "Which {} they see, by their ids.");
    return keys;
}

} // namespace overt::key_rows
