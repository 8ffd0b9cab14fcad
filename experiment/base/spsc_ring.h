/// A queue of fixed capacity between two threads in which neither ever waits for a lock.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace overt {

/// One thread pushes, one other thread pops; both are wait-free and allocate nothing. Items come out in the
/// order in which they went in.
template <class T>
requires std::is_trivially_copyable_v<T>
class SpscRing {
  public:
    /// Room for at least `capacity` items, allocated and touched here.
    explicit SpscRing(std::size_t capacity)
        : items_(std::bit_ceil(capacity < 2 ? std::size_t{2} : capacity)), mask_(items_.size() - 1) {}

    std::size_t capacity() const noexcept { return items_.size(); }

    /// Producer's side. False if the ring is full; nothing is pushed then.
    bool try_push(const T& item) noexcept {
        const std::size_t pushed = pushed_.load(std::memory_order_relaxed);
        if (pushed - popped_seen_ == items_.size()) {
            popped_seen_ = popped_.load(std::memory_order_acquire);
            if (pushed - popped_seen_ == items_.size())
                return false;
        }
        items_[pushed & mask_] = item;
        pushed_.store(pushed + 1, std::memory_order_release);
        return true;
    }

    /// Producer's side: sleeps while the ring is full.
    void wait_for_room() const noexcept {
        for (;;) {
            const std::size_t popped = popped_.load(std::memory_order_acquire);
            if (pushed_.load(std::memory_order_relaxed) - popped < items_.size())
                return;
            popped_.wait(popped, std::memory_order_acquire);
        }
    }

    /// Consumer's side. False if the ring is empty.
    bool try_pop(T& item) noexcept {
        const std::size_t popped = popped_.load(std::memory_order_relaxed);
        if (popped == pushed_.load(std::memory_order_acquire))
            return false;
        item = items_[popped & mask_];
        popped_.store(popped + 1, std::memory_order_release);
        return true;
    }

    /// Consumer's side: wakes a producer that waits for room.
    void announce_room() noexcept { popped_.notify_one(); }

    /// How many items wait. May be called from both sides: a lower bound for the consumer, an upper one for
    /// the producer.
    std::size_t size() const noexcept {
        return pushed_.load(std::memory_order_acquire) - popped_.load(std::memory_order_acquire);
    }

  private:
    // Each thread's counter on a cache line of its own, so that they do not slow each other down.
    static constexpr std::size_t cache_line = 64;
    std::vector<T> items_;
    std::size_t mask_;
    alignas(cache_line) std::atomic<std::size_t> pushed_{0};
    std::size_t popped_seen_ = 0; ///< the producer's last look at popped_
    alignas(cache_line) std::atomic<std::size_t> popped_{0};
};

} // namespace overt
