/// A function compiled once for each kind of processor; the loader takes the best that is there.
#pragma once

// The loader chooses before a sanitizer is ready for that; other compilers and processors have the one
// version.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) &&                \
    !defined(__clang__)
#define OVERT_PROCESSOR_CLONES(...) __attribute__((target_clones("default", __VA_ARGS__)))
#else
#define OVERT_PROCESSOR_CLONES(...)
#endif
