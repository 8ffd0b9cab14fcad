/// The kinds of answers, as a table: to add one is a file here and a row below.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

#include "experiment/answers/answering.h"
#include "experiment/base/kind_table.h"
#include "experiment/ports/given_answer.h"

namespace overt {

using MakeAnswering = std::unique_ptr<Answering>(const AnswerForm& form);

// A file each, or two that are alike.
MakeAnswering key_answering, choice_answering, scale_answering, number_answering, text_answering,
    point_answering, gauge_answering, match_answering;

struct AnswerKindRow {
    std::string_view name;
    std::string_view explanation; ///< for the reference of protocols; follows the name and a colon
    MakeAnswering* make;          ///< null: it is not given by inputs
    /// The keys of [[task.answer]] that it has besides those of all kinds; empty behind the last.
    std::array<std::string_view, 18> keys;
    bool accepts_by_key;  ///< unless the protocol says otherwise
    bool is_given_unseen; ///< also while the stimulus is on the screen and nothing else

    constexpr bool has_key(std::string_view key) const { return std::ranges::find(keys, key) != keys.end(); }
};

template <>
inline constexpr auto kinds_of<AnswerKind> = std::to_array<AnswerKindRow>({
    {"choice",
     "one of `choices`, each with a key, or chosen with the mouse",
     choice_answering,
     {"choices", "labels", "keys", "with", "beside_up_deg", "accept", "accept_key", "mapping"},
     false,
     true},
    {odd_one_out_kind,
     "the one of three `choices` or more, all of them slots, that does not belong; given like a choice. How "
     "often two stay together is their likeness, which the analysis tells",
     choice_answering,
     {"choices", "labels", "keys", "with", "beside_up_deg", "accept", "accept_key", "mapping"},
     false,
     true},
    {"key",
     "one of `keys`, of which the screen says nothing but the question",
     key_answering,
     {"choices", "keys", "beside_up_deg", "mapping"},
     false,
     true},
    {"scale",
     "a place on a scale: of `steps`, or a line from `min` to `max`; the marker is not there until the first "
     "press",
     scale_answering,
     {"steps", "min", "max", "step", "labels", "keys", "ends", "of", "order", "per_screen", "ticks", "with",
      "accept", "accept_key", "direction", "shows_value", "beside_up_deg", "mapping"},
     true,
     false},
    {"number",
     "a number that is typed",
     number_answering,
     {"min", "max", "step", "unit", "accept_key"},
     true,
     false},
    {"text", "words that are typed", text_answering, {"longest", "accept_key"}, true, false},
    {"point",
     "a place of the stimulus while it is shown, pointed at with the mouse, or looked at when a key is "
     "pressed; tables tell the place on the object's surface",
     point_answering,
     {"by", "keys", "beside_up_deg"},
     false,
     true},
    {"gauge",
     "a circle with a rod at the place of a probe, turned until it lies on the surface while that is shown; "
     "tables have its slant and tilt beside the surface's own",
     gauge_answering,
     {"probe", "size_deg", "slant_per_px_deg", "key_step_deg", "undo_key", "accept_key"},
     true,
     true},
    {"match",
     "what is shown in `slot`, set along a column of numbers while it is shown, until the observer accepts "
     "it",
     match_answering,
     {"slot", "along", "shows", "start", "keys", "coarse_keys", "coarse_steps", "undo_key", "with",
      "beside_up_deg", "accept_key"},
     true,
     true},
    {"spoken", "spoken, and recorded as `[answers]` says; a key goes on", nullptr, {}, false, false},
});

} // namespace overt
