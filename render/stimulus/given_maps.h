/// Coordinate-encoded maps that another program made of its own frames: the protocol's key `lut`. They have
/// the numbers of a motion's frames, in one view: a protocol with such maps has one motion and one view.
#pragma once

#include <functional>

#include "experiment/maps/coordinate_image_file.h"
#include "experiment/protocol/protocol.h"

namespace overt {

/// Reads the map of an animation frame, with what the protocol knows of it, and labels its areas.
/// Throws InputError as read_coordinate_image does, for another size than the view's, and for a map that says
/// it was made at another angle than the frame's.
CoordinateImageFile read_given_map(const Protocol& protocol, int object, AnimationFrameIndex frame);

/// Of all that read_given_map makes it from. Throws InputError if the file cannot be read.
ContentHash hash_of_given_map(const Protocol& protocol, int object, AnimationFrameIndex frame);

/// Reads the maps of all poses, on all processors, and gives remarks on them for the experimenter. Throws
/// InputError as read_given_map does, and if an area is described that no map shows.
std::vector<std::string> check_given_maps(const Protocol& protocol, int object);

/// The first frame of the only motion that shows a pose.
AnimationFrameIndex first_frame_of(const PoseTable& poses, PoseIndex pose);

} // namespace overt
