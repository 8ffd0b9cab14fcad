/// Whether the program was asked to end: long work deep below asks here, and knows nothing of signals.
#pragma once

#include <atomic>

namespace overt {

/// Says whether to stop; called from any thread, and must not wait. Null, as at first: nothing ever asks.
using StopCheck = bool (*)() noexcept;

inline std::atomic<StopCheck>& stop_check() noexcept {
    static std::atomic<StopCheck> check{nullptr};
    return check;
}

/// From any thread.
inline bool stop_is_requested() noexcept {
    const StopCheck check = stop_check().load(std::memory_order_relaxed);
    return check && check();
}

} // namespace overt
