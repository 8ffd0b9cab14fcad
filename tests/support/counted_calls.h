/// Counts what a thread asks of the system that may make it wait: memory, locks, files, exceptions. Replaces
/// these functions of the C and C++ libraries in the whole program, libraries included. To be included by one
/// file of a program only. Sanitizers bring functions of their own: with them nothing is counted.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define OVERT_CALLS_ARE_COUNTED 0
#else
#define OVERT_CALLS_ARE_COUNTED 1
#endif

#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>

#include <fcntl.h>
#include <pthread.h>

#include "tests/support/next_function.h"

namespace overt::test {

/// By the calling thread so far.
struct Calls {
    long allocations = 0; ///< and what gives memory back
    long locks = 0;
    long opened_files = 0;
    long exceptions = 0;
    friend bool operator==(const Calls&, const Calls&) = default;
};
inline constinit thread_local Calls calls;

inline Calls operator-(const Calls& a, const Calls& b) {
    return {a.allocations - b.allocations, a.locks - b.locks, a.opened_files - b.opened_files,
            a.exceptions - b.exceptions};
}

} // namespace overt::test

#if OVERT_CALLS_ARE_COUNTED
// NOLINTBEGIN(misc-definitions-in-headers,bugprone-reserved-identifier,readability-identifier-naming): one
// file of a program includes this, which replaces functions of the C library. Their parameters are called as
// in its headers. operator new and operator delete of libstdc++ call malloc and free.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) noexcept {
    ++overt::test::calls.allocations;
    return __libc_malloc(size);
}
void* calloc(std::size_t nmemb, std::size_t size) noexcept {
    ++overt::test::calls.allocations;
    return __libc_calloc(nmemb, size);
}
void* realloc(void* ptr, std::size_t size) noexcept {
    ++overt::test::calls.allocations;
    return __libc_realloc(ptr, size);
}
void free(void* ptr) noexcept {
    overt::test::calls.allocations += ptr != nullptr;
    __libc_free(ptr);
}
void* memalign(std::size_t alignment, std::size_t size) noexcept {
    ++overt::test::calls.allocations;
    return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept { return memalign(alignment, size); }
int posix_memalign(void** memptr, std::size_t alignment, std::size_t size) noexcept {
    *memptr = memalign(alignment, size);
    return *memptr ? 0 : ENOMEM;
}

int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
    static auto* const next = overt::test::next_function<int(pthread_mutex_t*)>("pthread_mutex_lock");
    ++overt::test::calls.locks;
    return next(mutex);
}

std::FILE* fopen(const char* name, const char* modes) {
    static auto* const next = overt::test::next_function<std::FILE*(const char*, const char*)>("fopen");
    ++overt::test::calls.opened_files;
    return next(name, modes);
}
std::FILE* fopen64(const char* name, const char* modes) {
    static auto* const next = overt::test::next_function<std::FILE*(const char*, const char*)>("fopen64");
    ++overt::test::calls.opened_files;
    return next(name, modes);
}
int open(const char* file, int oflag, ...) {
    static auto* const next = overt::test::next_function<int(const char*, int, ...)>("open");
    std::va_list rest;
    va_start(rest, oflag);
    const mode_t mode = va_arg(rest, mode_t);
    va_end(rest);
    ++overt::test::calls.opened_files;
    return next(file, oflag, mode);
}
int open64(const char* file, int oflag, ...) {
    static auto* const next = overt::test::next_function<int(const char*, int, ...)>("open64");
    std::va_list rest;
    va_start(rest, oflag);
    const mode_t mode = va_arg(rest, mode_t);
    va_end(rest);
    ++overt::test::calls.opened_files;
    return next(file, oflag, mode);
}

[[noreturn]] void __cxa_throw(void* thrown, void* type, void (*destroy)(void*)) {
    static auto* const next = overt::test::next_function<void(void*, void*, void (*)(void*))>("__cxa_throw");
    ++overt::test::calls.exceptions;
    next(thrown, type, destroy);
    __builtin_unreachable();
}
}
#endif
// NOLINTEND(misc-definitions-in-headers,bugprone-reserved-identifier,readability-identifier-naming)
