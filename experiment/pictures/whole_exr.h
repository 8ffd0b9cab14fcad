/// Whether a file of OpenEXR is all there: one that was cut off still has its header and its size.
#pragma once

#include <filesystem>

namespace overt {

/// By the header, the table of offsets and the last block of pixels, without decoding one (OpenEXR File
/// Layout, openexr.com). False for what is no OpenEXR or cannot be read; files in tiles, of several parts and
/// deep ones are taken as they are. From any thread.
bool is_whole_exr(const std::filesystem::path& file);

} // namespace overt
