/// Coordinate-encoded maps as files that any program for pictures can read: OpenEXR with the coordinates
/// themselves, and PNG with 16-bit codes as in the paper.
#pragma once

#include <filesystem>

#include "experiment/maps/coordinate_image.h"
#include "experiment/maps/map_description.h"

namespace overt {

/// Writes OpenEXR with the 32-bit float channels X, Y, Z (object coordinates) and A (coverage, 0 or 1),
/// losslessly compressed; if the parts are known, their indices are a fifth channel, "part".
/// The description goes into the header: "overt:bounds_min", "overt:bounds_max",
/// "overt:camera_position" and "overt:camera_target" as three doubles, "overt:camera_vertical_fov_deg" and
/// "overt:angle_deg" as double, "overt:frame" as int, "overt:object", "overt:mesh_sha256" and
/// "overt:unit" as text. At once or not at all, in place of a file that is there. Throws RecordError.
void write_coordinate_exr(const std::filesystem::path& file, const CoordinateImage& image,
                          const MapDescription& description);

/// Writes a PNG of 16 bits with the codes as red, green and blue and the coverage as alpha (0 or 65535), and
/// beside it the sidecar with scale and bounds, without which codes mean nothing. `description` must have
/// both. Nothing in the PNG asks a reader for a gamma or a colour space. Each file at once or not at all.
/// Throws RecordError.
void write_coordinate_png(const std::filesystem::path& file, const CoordinateImage& image,
                          const MapDescription& description);

struct CoordinateImageFile {
    CoordinateImage image;
    MapDescription description;
    /// Pixels neither on the object nor off it: the map was filtered. They are taken as off the object, for
    /// their coordinates mix surfaces.
    int mixed_px = 0;
};

/// What a map's own header says of it, without its pixels; its sidecar is not looked at. Throws InputError if
/// the file cannot be read.
MapDescription read_map_description(const std::filesystem::path& file);

/// Reads a map that write_coordinate_exr or write_coordinate_png wrote, or one made elsewhere:
///  - OpenEXR, 32-bit float, channels X, Y, Z: object coordinates as they stand;
///  - OpenEXR, 32-bit float, channels R, G, B: shares of the bounds, 0 … 1;
///  - PNG or TIFF, 16 bits, red, green, blue: codes, which need bounds and scale.
/// Coverage is the channel A; without one, all pixels are covered that are not 0 in all three channels.
///
/// Bounds, scale and the rest of the description come from the file's header, from its sidecar, and from
/// `known`. Throws InputError naming the file: if it cannot be read, is of another kind, lacks bounds or
/// scale, if the sources contradict one another, if a value is not finite or a share is not within 0 … 1,
/// and if no pixel is covered.
CoordinateImageFile read_coordinate_image(const std::filesystem::path& file,
                                          const MapDescription& known = {});

} // namespace overt
