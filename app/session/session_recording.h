/// What is recorded before a session's first trial: the header, the meshes and the maps.
#pragma once

#include <filesystem>

#include "experiment/record/manifest.h"
#include "experiment/record/preview_file.h"
#include "experiment/record/session_directory.h"
#include "experiment/record/session_header.h"
#include "render/stimulus/live_maps.h"
#include "render/stimulus/stimulus_library.h"

namespace overt {

/// What a session is made of, gathered for its record. The library's frames must be prepared, and its maps if
/// they are to be in it. `with_frames`: false where nothing is drawn, and the pixels of frames are not known.
/// File names are those that put_files() gives.
SessionHeader make_session_header(const Protocol& protocol, const Schedule& schedule,
                                  std::span<const Object> objects, const StimulusLibrary& library,
                                  const GlDescription& graphics, const TrackerDescription& tracker,
                                  ClockKind clock, bool with_prepared_maps, bool with_frames = true);

/// Puts the meshes, the maps and, with pictures, one of each stimulus into the directory as the header names
/// them, the header itself into a new session file, a copy of the protocol beside it, and a manifest of it
/// all. Throws RecordError.
void put_files(const SessionDirectory& directory, const SessionHeader& header,
               std::span<const Object> objects, const StimulusLibrary& library, bool with_pictures = true);

/// Makes the record of a further tracker in a session's directory whose files have been put there: they are
/// shared with it. Throws RecordError.
void put_further_record(const std::filesystem::path& session, const SessionHeader& further);

/// Brings a file of the session's directory, such as a map, into a further tracker's as well: the same file,
/// or a copy where the disk has no such thing. Throws RecordError.
void share_file(const std::filesystem::path& session, const std::filesystem::path& further,
                const std::string& name);

/// Writes maps that were made live into a published session's folder and gives what its record is to know of
/// them; those that the header has already, from before the session was resumed, stay. Throws RecordError.
std::vector<RecordedMap> record_live_maps(std::vector<LiveMap> maps, const std::filesystem::path& folder,
                                          const SessionHeader& header);

} // namespace overt
