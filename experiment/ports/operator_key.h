/// The keys that lead a session.
#pragma once

#include <string_view>

#include "experiment/ports/ports.h"

namespace overt {

/// An operator's key as [operator] and the record call it; empty for the observer's.
std::string_view name_of(ResponsePress::Key key) noexcept;

} // namespace overt
