/// The table of all keys that a protocol file may have: one row for each key. The reader, the reference in
/// docs/protocols.md, the schema, and the names suggested for misspelt words all come from it.
#pragma once

#include "experiment/keys/key_table.h"
#include "experiment/protocol/protocol.h"

namespace overt {

/// Its structs lie in a Protocol. Made once; safe from any thread.
const KeyTable& protocol_keys();

} // namespace overt
