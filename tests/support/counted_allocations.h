/// Counts what is allocated by operator new, by replacing it in the whole test program. To be included by one
/// file of a program only.
#pragma once

#include <cstdlib>
#include <new>

namespace overt::test {

/// Allocations of this thread so far.
inline thread_local long allocations = 0;

inline void* counted_allocation(std::size_t size) noexcept {
    ++allocations;
    return std::malloc(size > 0 ? size : 1);
}

inline void* counted_allocation_or_throw(std::size_t size) {
    if (void* memory = counted_allocation(size))
        return memory;
    throw std::bad_alloc();
}

} // namespace overt::test

// NOLINTBEGIN(misc-definitions-in-headers): one file of a program includes this, which replaces the allocator
void* operator new(std::size_t size) { return overt::test::counted_allocation_or_throw(size); }
void* operator new[](std::size_t size) { return overt::test::counted_allocation_or_throw(size); }
// Sanitizers bring these two of their own, which would not go with the operator delete below.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return overt::test::counted_allocation(size);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    return overt::test::counted_allocation(size);
}
// The compiler sees malloc inlined into new and free into delete, and takes them for a mismatch.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
// NOLINTEND(misc-definitions-in-headers)
