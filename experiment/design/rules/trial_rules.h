/// The rules by which trials are made, as a table: to add one is a file here and a row below.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

#include "experiment/base/kind_table.h"
#include "experiment/design/rules/trial_rule.h"

namespace overt {

using MakeTrialRule = std::unique_ptr<TrialRule>(const RuleRequest& request);

// A file each.
MakeTrialRule every_rule, pairs_rule, triads_rule, quadruples_rule, standard_rule, tuples_rule, search_rule,
    match_rule, stream_rule, procedure_rule;

struct TrialRuleRow {
    std::string_view name;
    std::string_view explanation; ///< for the reference of protocols; follows the name and a colon
    /// What one trial shows, for `overt check`: {of}, {standard}, {target}, {distractors}, {sizes}, {size},
    /// {sample}, {among}, {length} and {back} are what the protocol says.
    std::string_view words;
    MakeTrialRule* make;
    /// The keys that it looks at besides `rule`, `of`, `same` and `per`; empty behind the last.
    std::array<std::string_view, 8> keys;
    bool keeps_order = false;                     ///< its trials come in the order that it gives them
    std::array<std::string_view, 2> answers = {}; ///< that are correct; those of a match are slots
    bool asks_for_differences = false; ///< which two stimuli differ more, and not which has more of something

    constexpr bool has_key(std::string_view key) const { return std::ranges::find(keys, key) != keys.end(); }
};

enum class TrialRuleKind : std::uint8_t {};

template <>
inline constexpr auto kinds_of<TrialRuleKind> = std::to_array<TrialRuleRow>({
    {"every",
     "each stimulus, with all combinations of the levels of `of`, in one slot",
     "each combination of {of}",
     every_rule,
     {"in", "draw"}},
    {"pairs",
     "each pair of stimuli that differ in all of `of`; `ordered` both ways round, `identical` also each with "
     "itself",
     "a pair that differs in {of}",
     pairs_rule,
     {"any", "differs", "ordered", "identical", "side", "draw"}},
    {"triads",
     "each three levels a < b < c of one factor, b in the middle slot, for difference scaling",
     "three levels of {of}, the middle one in the middle slot",
     triads_rule,
     {"any", "side", "draw"},
     false,
     {},
     true},
    {"quadruples",
     "each four levels a < b < c < d of one factor, a pair (a, b) and a pair (c, d) that do not overlap, in "
     "the first two slots and the last two, for difference scaling",
     "two pairs of {of} that do not overlap, in the first two slots and the last two",
     quadruples_rule,
     {"any", "side", "draw"},
     false,
     {},
     true},
    {"standard",
     "each level of one factor against `standard`",
     "{standard} against another level of {of}",
     standard_rule,
     {"any", "differs", "standard", "identical", "side", "draw"}},
    {"tuples",
     "each set of `size` stimuli that differ in all of `of` from each other",
     "{size} stimuli that all differ in {of}",
     tuples_rule,
     {"any", "differs", "size", "side", "draw"}},
    {"search",
     "a target among distractors, or distractors alone: each target and set size, in slots that are drawn",
     "{target} among {distractors}, {sizes} at once, or not there",
     search_rule,
     {"target", "distractors", "set_sizes", "absent", "side", "draw"},
     false,
     {"present", "absent"}},
    {"match",
     "a sample, and slots of which one shows what has its levels of `of` while it differs in `differs`",
     "a sample in {sample}, and what has its {of} in one of {among}",
     match_rule,
     {"any", "differs", "sample", "among", "side", "draw"}},
    {"stream",
     "one stimulus after the other, of which a share repeats what came `back` trials before",
     "one of a stream of {length} that differ in {of}, some repeating what came {back} before",
     stream_rule,
     {"length", "back", "repeats", "lures"},
     true,
     {"repeat", "new"}},
    {"procedure",
     "a level of one factor that a `[[procedure]]` chooses when the trial comes, alone or against `standard`",
     "a level of {of} that is chosen by the answers so far",
     procedure_rule,
     {"procedure", "standard", "in", "side", "any"}},
});

} // namespace overt
