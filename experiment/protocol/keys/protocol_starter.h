/// A protocol to begin with.
#pragma once

#include <string>
#include <string_view>

namespace overt {

/// A sound protocol of that name, small enough to run at once, in which every key stands with its
/// explanation: those that one has to decide on with a value, the others as comments with their defaults.
/// Made from the table of keys. `name` must be an identifier.
std::string protocol_starter(std::string_view name);

/// The same experiment in as few lines as it needs.
std::string short_protocol_starter(std::string_view name);

} // namespace overt
