/// Bytes of a glTF file that are packed by meshoptimizer (EXT_meshopt_compression).
#pragma once

#include <string>
#include <string_view>

#include "experiment/scene/files/gltf_json.h"

namespace overt {

/// The names of the extension under which such bytes are known.
bool is_meshopt_extension(std::string_view name);

/// Unpacks what `packed` says of `bytes`, the extension of a buffer view. What it claims to be is held
/// against what so many bytes can be before anything is allocated. Throws InputError at the place.
std::string unpacked_by_meshopt(const GltfValue& packed, std::string_view bytes);

} // namespace overt
