/// The contexts that rendering tests run in.
#pragma once

#include <memory>
#include <vector>

#include "render/gl/headless_context.h"
#include "render/gl/gl_context.h"

namespace overt::test {

/// The headless contexts that this machine offers; OSMesa is always among them.
inline std::vector<ContextKind> headless_kinds() {
    std::vector<ContextKind> kinds{ContextKind::osmesa};
    try {
        make_headless_context(ContextKind::egl);
        kinds.push_back(ContextKind::egl);
    } catch (const std::exception&) {
    }
    return kinds;
}

} // namespace overt::test
