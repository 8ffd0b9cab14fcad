/// What an observer will read, as pictures.
#pragma once

#include <filesystem>

#include "experiment/protocol/protocol.h"

namespace overt {

/// Writes a PNG of every screen that sessions of the protocol can show, besides stimuli, into a folder that
/// is made if need be: in the greys of the protocol as sRGB, at the display's resolution. Gives their number.
/// Throws RecordError, and InputError for a text that cannot be set.
int write_screen_pictures(const Protocol& protocol, const std::filesystem::path& folder);

} // namespace overt
