/// GLFW's keys as ours.
#pragma once

#include "render/window/window_context.h"

namespace overt {

/// The key of GLFW's number; `modifiers` as GLFW has them.
WindowKey window_key_of(int key, int modifiers) noexcept;

} // namespace overt
