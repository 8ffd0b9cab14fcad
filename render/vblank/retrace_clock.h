/// Vertical blanks by the return of a call that waits for one, which needs a thread of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "render/vblank/vblank_clock.h"

namespace overt {

/// A call that returns when a vertical blank has begun. Made on any thread, used on one.
class RetraceWait {
  public:
    virtual ~RetraceWait() = default;

    /// Before the first wait. Throws GraphicsError with the reason if it cannot be used.
    virtual void begin() = 0;

    /// Waits for the next vertical blank: its number, which may begin again after 2^32; nothing if there will
    /// be no more. A dark screen may keep it waiting for ever.
    virtual std::optional<std::uint32_t> next() noexcept = 0;
};

/// Waits on a thread of its own and stamps each return with `clock`, which must be one that goes by itself
/// and outlive the process's threads. A stamp lies after its blank by as long as the thread took to wake up.
/// Throws what begin() throws. A wait that does not return within `patience` of the clock's end is left to
/// itself.
std::unique_ptr<VblankClock> watch_retraces(VblankSource source, std::shared_ptr<RetraceWait> wait,
                                            const Clock& clock);

} // namespace overt
