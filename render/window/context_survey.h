/// What each way to OpenGL offers on this machine.
#pragma once

#include <vector>

#include "render/gl/headless_context.h"

namespace overt {

/// Tries each kind of context, windows included. Never throws; a context that was made is destroyed again.
/// Main thread only.
std::vector<ContextAttempt> survey_contexts();

} // namespace overt
