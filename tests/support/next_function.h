/// A function of a library whose place a test program has taken by one of the same name.
#pragma once

#include <dlfcn.h>

namespace overt::test {

/// The library's own function of this name.
template <class Function> Function* next_function(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

} // namespace overt::test
