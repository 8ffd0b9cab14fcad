/// Memory for large tables that are read here and there: in large pages, where the system has them.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

#include <sys/mman.h>

namespace overt {

/// Asks Linux for pages of 2 MiB for what fills at least one. With pages of 4 KiB nearly each access at
/// random to a hundred megabytes must first find out where its page is, which costs more than the access
/// itself. If there are none to be had, ordinary memory serves as well.
template <class T> struct LargePageAllocator {
    using value_type = T;

    LargePageAllocator() = default;
    template <class Other> LargePageAllocator(const LargePageAllocator<Other>&) {}

    T* allocate(std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        if (bytes < page_bytes)
            return static_cast<T*>(::operator new(bytes, std::align_val_t(least_alignment)));
        const std::size_t whole_pages = (bytes + page_bytes - 1) / page_bytes * page_bytes;
        void* const memory = std::aligned_alloc(page_bytes, whole_pages);
        if (!memory)
            throw std::bad_alloc();
        ::madvise(memory, bytes / page_bytes * page_bytes, MADV_HUGEPAGE);
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t count) {
        if (count * sizeof(T) < page_bytes) {
            ::operator delete(memory, std::align_val_t(least_alignment));
        } else {
            std::free(memory);
        }
    }

    template <class Other> bool operator==(const LargePageAllocator<Other>&) const { return true; }

  private:
    static constexpr std::size_t page_bytes = std::size_t{2} << 20;
    static constexpr std::size_t least_alignment = 64; // a cache line
};

template <class T> using LargePageVector = std::vector<T, LargePageAllocator<T>>;

} // namespace overt
