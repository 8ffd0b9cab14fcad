/// Which trial of an earlier session each trial with a motion of kind "recorded" shows again.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "experiment/protocol/protocol.h"
#include "experiment/trial.h"

namespace overt {

/// The factor of a trial's own whose level is the name of what it shows again (RecordedCourse::name). A table
/// of trials may have it as a column, and says which then.
inline constexpr std::string_view yoked_to = "yoked_to";

/// Whether a trial shows any motion of kind "recorded".
bool is_yoked(const Protocol& protocol, const Trial& trial);

/// Gives each trial of an observer, in their order, the level `yoked_to`, where it has none and shows a
/// motion of kind "recorded". Observers have those whose courses there are in turn, by their numbers. Among
/// the trials of that session it is the one with the trial's own number, or, by the stimulus, those in which
/// each slot with such a motion had the same: in their order, and from the first again where trials are more.
/// Gives what is wrong: the first trial that finds none. A trial of practice has no number; what has not its
/// like in the recording has the first with its slot.
std::optional<std::string> yoke(const Protocol& protocol, int observer_number, std::span<Trial> trials,
                                bool is_practice = false);

/// What the place of a trial shows in its `show`-th show in which it moves, from 0; more shows than were
/// recorded have the last. Null: it has no level `yoked_to`, or none of that name is in its slot.
const RecordedCourse* course_of(const Protocol& protocol, const Trial& trial, std::size_t place, int show);

} // namespace overt
