/// The stimuli that a protocol's lists make, what they are called, and the poses that they are shown in.
#pragma once

#include <string>
#include <vector>

#include "experiment/protocol/protocol.h"

namespace overt {

/// Each entry of each list with each of the others, in the order of `stimulus_lists`, the last changing
/// fastest.
std::vector<Stimulus> all_stimuli(const Protocol& protocol);

/// The same as slots of each size show them to each eye (Protocol::in_slot), those of the first slot's size
/// first: what frames and maps are made of.
std::vector<Stimulus> stimuli_in_slots(const Protocol& protocol);

/// One of all_stimuli() as slots of each size show it to each eye.
std::vector<Stimulus> at_all_sizes(const Protocol& protocol, const Stimulus& stimulus);

/// The stimulus that ready-made frames of the protocol show.
Stimulus stimulus_of(const Protocol& protocol, const FrameSequenceSettings& frames);

/// The turns of the objects in all motions.
PoseTable poses_of(const Protocol& protocol);

/// How each motion goes through them on the display, by motion. Throws InputError as make_page_cycle does.
std::vector<PageCycle> page_cycles(const Protocol& protocol);

/// All objects in all views, at each size that slots have, before each eye.
std::vector<ViewedObject> all_viewed_objects(const Protocol& protocol);

/// Whether a stimulus's name has the id of its entry of a list, by an index into `stimulus_lists`: always of
/// object and material, else where the list has several entries.
bool is_named(std::size_t list, std::size_t entries);

/// OBJECT/MATERIAL, and the ids of what else there is a choice of: "muse/gold/hall/turn"; last, where slots
/// have several sizes and it is not that of the first, the first slot of its size, and with [stereo] the eye.
std::string stimulus_name(const Protocol& protocol, const Stimulus& stimulus, char between = '/');

/// The same for sentences: "muse, gold".
std::string stimulus_in_words(const Protocol& protocol, const Stimulus& stimulus);

/// The same with titles.
std::string stimulus_title(const Protocol& protocol, const Stimulus& stimulus);

/// "[view]", or "[[view]] ID" where there are several: for messages.
std::string section_of_view(const Protocol& protocol, int view);

/// OBJECT, and with several views OBJECT/VIEW.
std::string viewed_name(const Protocol& protocol, const ViewedObject& viewed, char between = '/');

} // namespace overt
