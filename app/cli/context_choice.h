/// Which OpenGL context a command draws in.
#pragma once

#include <optional>

#include "render/gl/gl_context.h"

namespace overt {

/// Nothing: the best one there is.
using ContextChoice = std::optional<ContextKind>;

} // namespace overt
