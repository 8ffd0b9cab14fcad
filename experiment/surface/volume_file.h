/// A voxel map as files for other programs.
#pragma once

#include <filesystem>
#include <string_view>

#include "experiment/surface/voxel_density.h"

namespace overt {

/// Writes the voxels as NRRD with 32-bit floats: a header of text that says size, spacing, origin and unit,
/// then the numbers, little-endian, x fastest. 3D Slicer, ITK, ParaView and MeshLab's kin, pynrrd and MATLAB
/// read it; NIfTI would ask for a patient's axes that an object does not have. `unit` is that of the
/// voxels' lengths ("mm"), `meaning` what a number says ("fixations per mm^3"). Throws RecordError.
void write_nrrd(const std::filesystem::path& path, const VoxelDensity& voxels, std::string_view unit,
                std::string_view meaning);

/// Writes the paper's second form of a map: a look-up table from an object coordinate to a colour, as .cube
/// (Adobe's, read by colour tools, video players and render engines). Its domain 0 … 1 on each axis is
/// `bounds`, as in the coordinate-encoded pictures, so that such a picture sent through the table shows the
/// map on the object in that pose. The value is that of the map over `most`, 0 … 1, in all three channels:
/// grey that any colour map can be laid over. `meaning`: what `most` is of
/// ("fixations per mm^3"). `side`: 2 … 256 entries along each axis. Throws RecordError.
void write_cube_table(const std::filesystem::path& path, const VoxelDensity& voxels, const Bounds& bounds,
                      double most, int side, std::string_view title, std::string_view meaning);

} // namespace overt
