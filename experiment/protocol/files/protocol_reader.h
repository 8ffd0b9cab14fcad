/// From the text of a protocol to the values of its keys, each judged by itself.
#pragma once

#include <string_view>

#include "experiment/protocol/files/protocol_examination.h"
#include "experiment/protocol/protocol_sources.h"

namespace overt {

/// Reads all keys of a text, and of what it includes, into the protocol under examination, whose `file` says
/// where the text was: relative paths in it are resolved against that file's folder. What is wrong with a key
/// is found at its place. Gives whether the text could be read to its end; if not, comparing keys with each
/// other would raise false alarms. Throws nothing for bad input.
bool read_written_keys(ProtocolExamination& examination, std::string_view text, const IncludeReader& reader);

} // namespace overt
