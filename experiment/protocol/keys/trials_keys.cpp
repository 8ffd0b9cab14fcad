#include "experiment/protocol/keys/key_rows.h"

namespace overt::key_rows {

std::vector<Key> trials() {
    using T = TrialsSettings;
    return {
        {"rule", &T::rule, required(), explanation_of_kinds<TrialRuleKind>()},
        {"of", &T::of, left_out("all lists with more than one entry"),
         "Factors by whose levels the rule goes: lists (`object`, `material`, `light`, `motion`, `view`, "
         "`background`) and "
         "columns of their entries."},
        {"same", &T::same, left_out("all lists that are not named otherwise"),
         "Factors that all stimuli of a trial have alike."},
        {"differs", &T::differs, left_out("none"), "Factors in which they differ besides `of`."},
        {"any", &T::any, left_out("none"), "Factors in which they may differ or not."},
        {"side", &T::side,
         "Which slot each stimulus of a trial takes: drawn, each way equally often to one; crossed, each way "
         "once; or fixed, in the order of the rule."},
        {"draw", &T::draw, range(1, 100000).left_out("all"),
         "So many of all combinations, without replacement."},
        {"per", &T::per, "Whether each observer has a list and sides of their own, or everyone the same."},
        {"ordered", &T::ordered, "Of pairs: each comes both ways round."},
        {"identical", &T::identical, "Of pairs and standard: a stimulus comes with itself, too."},
        {"standard", &T::standard, left_out("none"),
         "Level of `of` that all others are compared with, or several; of a procedure one."},
        {"size", &T::size, range(0, 100), "Of tuples: how many stimuli; 0 for one in each slot."},
        {"target", &T::target, left_out("none"),
         "Of a search: level of `of` that is looked for, or several, one in each trial."},
        {"distractors", &T::distractors, left_out("all that are no target"),
         "Of a search: levels of `of` among which it is looked for."},
        {"set_sizes", &T::set_sizes, range(1, 1000).left_out("all slots of the task"),
         "Of a search: how many stimuli are shown."},
        {"absent", &T::absent, range(0, 1), "Of a search: share of the trials without the target."},
        {"in", &T::in, left_out("the only slot of the task"),
         "Of every and procedure: id of the slot that the stimulus takes; the others stay empty."},
        {"sample", &T::sample, left_out("the first of the task"), "Of a match: slot of the sample."},
        {"among", &T::among, left_out("all others of the task"),
         "Of a match: slots of which one shows the match."},
        {"length", &T::length, range(0, 2000), "Of a stream: how many trials."},
        {"back", &T::back, range(1, 100), "Of a stream: how many trials before what is repeated came."},
        {"repeats", &T::repeats, range(0, 1),
         "Of a stream: share of the trials that repeat, of those that can."},
        {"lures", &T::lures, range(0, 1).left_out("as chance has it"),
         "Of a stream: share of the same trials that are lures, which came one trial earlier or later than "
         "`back` before; all others are then none. The factor `lure` says which."},
        {"procedure", &T::procedures, identifier().left_out("none"),
         "Ids of the `[[procedure]]`s that choose the level of `of` when a trial comes, in each condition "
         "that the "
         "other factors make; of several one is drawn for each trial among those that go on."},
    };
}

std::vector<Key> catch_trials() {
    using C = CatchSettings;
    return {
        {"trials", &C::trials_file, required(),
         "Path of a table with a row for each trial, as for the task itself; its column `correct` has the "
         "answer of somebody who attends."},
        {"share", &C::share, range(0, 0.9).left_out("see `count`"),
         "Share of all trials of the task in a block, to the nearest whole trial."},
        {"count", &C::count, range(1, 1000).left_out("as many as the table has rows"),
         "How many in a block, instead. Each row comes equally often, to one."},
    };
}

std::vector<Key> draw() {
    using D = DrawSettings;
    return {
        {"of", &D::of, identifier().required(),
         "List of which entries are drawn: `object`, `material`, `light`, `motion`, `view` or `background`."},
        {"count", &D::count, range(1, 100000).left_out("see `from`"), "How many entries."},
        {"from", &D::from, identifier().left_out("none"),
         "Id of an earlier block that draws of the same list: what it drew is old in this block, all else "
         "new. Trials have it as the factor `seen`, and as their correct answer."},
        {"old", &D::old_entries, range(0, 100000).left_out("all"), "How many of the old ones."},
        {"new", &D::new_entries, range(0, 100000).left_out("all"), "How many of the new ones."},
        {"per", &D::per, "Whether each observer has a list of their own, or everyone the same."},
    };
}

} // namespace overt::key_rows
