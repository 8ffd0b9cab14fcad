/// The contexts that rendering tests run in.
#pragma once

#include <array>

#include "render/gl/gl_context.h"

namespace overt::test {

/// The headless contexts: both come with the packages that ./test installs, so a test fails where one is
/// missing.
inline constexpr std::array headless_kinds{ContextKind::osmesa, ContextKind::egl};

} // namespace overt::test
