/// The reference of all keys, written from the table of keys.
#pragma once

#include <string>

namespace overt {

/// docs/protocols.md: what a protocol file is, and each section with its keys, values, defaults and meanings.
std::string protocol_reference_markdown();

} // namespace overt
