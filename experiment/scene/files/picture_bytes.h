/// The pictures of mesh files: PNG, JPEG and WebP, told by their first bytes.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "experiment/scene/surface_appearance.h"

namespace overt {

/// What format the bytes are of: "png", "jpeg" or "webp"; of others that are known "KTX2", "TIFF" and the
/// like; empty.
std::string_view format_of_picture(std::string_view bytes);

/// Reads a PNG, JPEG or WebP picture by its own reader alone; WebP only without alpha, by which its reader
/// multiplies colours. Codes stay as they are stored: what they mean is for
/// the material to say, so what the file says of its colours and of how a camera was held counts for nothing;
/// sixteen bits become eight. Throws InputError that begins with `name`, with the remedy for a format that is
/// not read. `file`: see SurfacePicture::file.
std::shared_ptr<const SurfacePicture> read_surface_picture(std::string_view bytes, const std::string& name,
                                                           std::string file);

} // namespace overt
