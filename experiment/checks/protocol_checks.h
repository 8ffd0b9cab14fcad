/// What has to hold between the keys of a protocol, each of which is in order by itself.
#pragma once

#include <span>
#include <string_view>

#include "experiment/protocol/files/protocol_examination.h"

namespace overt {

// The rig: screen, image, animation, texts, schedule.
void check_image_fits(ProtocolExamination& examination);
/// Lengths that nobody means in millimetres.
void check_sizes(ProtocolExamination& examination);
/// What the video signal can carry, and where on the screen.
void check_output(ProtocolExamination& examination);
/// Two eyes' fields, and what cannot be shown in them.
void check_stereo(ProtocolExamination& examination);
void check_motions(ProtocolExamination& examination);
void check_motion_kinds(ProtocolExamination& examination); ///< what each kind asks of its keys
void check_screens(ProtocolExamination& examination);
void check_schedule(ProtocolExamination& examination);
/// Limits that are written in [schedule] and do not hold in a block, because of its order.
void check_dropped_limits(ProtocolExamination& examination);

/// Blocks and groups: what they name, and what belongs together in one.
void check_blocks(ProtocolExamination& examination);
void check_groups(ProtocolExamination& examination);
/// Rules and tables of trials: after check_slots().
void check_trials(ProtocolExamination& examination);
/// What chooses levels: after check_trials().
void check_procedures(ProtocolExamination& examination);
void check_practice(ProtocolExamination& examination);
void check_simulated_effects(ProtocolExamination& examination);
void check_breaks(ProtocolExamination& examination);
/// Consent, form, the operator's keys and spoken answers.
void check_sitting(ProtocolExamination& examination);
/// Response boxes and outputs of markers, and who answers at which.
void check_devices(ProtocolExamination& examination);

/// Reads the characterisation of the display, if the protocol names one and `look_at_files`, and finds what
/// in the protocol contradicts it or asks for it. Turns luminances into linear light.
void take_characterisation(ProtocolExamination& examination, bool look_at_files);

// The lists: ids, references, and what belongs together in one entry.
void check_ids(ProtocolExamination& examination);
void check_objects(ProtocolExamination& examination, std::span<const std::string_view> shipped_sculptures);
void check_materials(ProtocolExamination& examination);
/// Suns, lamps and sums of lights. After the protocol is complete.
void check_lights(ProtocolExamination& examination);
/// What stands behind objects.
void check_backgrounds(ProtocolExamination& examination);
void check_frames(ProtocolExamination& examination);
/// What the stimuli of a trial take of the frame store together. Of a protocol that is sound otherwise.
void check_slot_memory(ProtocolExamination& examination);
/// What a trial of each task does.
void check_steps(ProtocolExamination& examination);
/// What is answered in it, and how.
void check_answers(ProtocolExamination& examination);
/// What is set to match in a task, along what, and with which keys.
void check_matches(ProtocolExamination& examination);
/// Whether there are levels to be set, and room for them. Of a protocol that is sound otherwise.
void check_match_levels(ProtocolExamination& examination);
/// Objects that the observer turns.
void check_turning(ProtocolExamination& examination);
/// Motions that show again how observers of earlier sessions turned objects.
void check_recorded_motions(ProtocolExamination& examination);
/// Whether each trial finds what it is to show again. Of a protocol that is sound otherwise.
void check_yoked_trials(ProtocolExamination& examination);
/// Places on the screen, and in which of them each task shows its stimuli.
void check_slots(ProtocolExamination& examination);
/// Lists of places on surfaces, and probes there; after check_slots(), before trials are put together.
void check_points(ProtocolExamination& examination);
/// Whether the objects that are shown have the places. Of a protocol that is sound otherwise.
void check_points_on_objects(ProtocolExamination& examination);
/// After take_characterisation().
void check_bake(ProtocolExamination& examination);

/// Whether meshes, probe and frames are there. Looks at the file system.
void check_files(ProtocolExamination& examination);

// What several of them look for.

/// Reports at `path` the first two of these slots (indices into the protocol's) that share pixels, or one
/// that is there twice.
void check_slots_apart(ProtocolExamination& examination, const std::string& path,
                       std::span<const int> shown_at_once);
/// The same at a place of the protocol's file.
void check_slots_apart(ProtocolExamination& examination, Place place, std::span<const int> shown_at_once);

/// Reports each entry of a list whose id an earlier one has already. Empty ids are reported elsewhere.
void check_ids_differ(ProtocolExamination& examination, std::string_view list,
                      const std::vector<std::string_view>& ids);
/// Whether an id is known; if not, reports that "there is no NOUN "ID"".
bool is_known(ProtocolExamination& examination, const std::string& path, std::string_view noun,
              std::string_view id, const std::vector<std::string_view>& known);

} // namespace overt
