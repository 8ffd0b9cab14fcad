/// A function of a library whose place a test program has taken by one of the same name.
#pragma once

#include <dlfcn.h>

namespace overt::test {

/// The library's own function of this name. What takes the place of a function of the C library is called
/// before the thread sanitizer stands, so that neither it nor this may be watched by it.
template <class Function> [[gnu::no_sanitize("thread")]] Function* next_function(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

} // namespace overt::test
