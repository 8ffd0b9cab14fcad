/// When vertical blanks began, as the best source on this machine says: what a time stamp of the flip ledger
/// rests on.
#pragma once

#include <chrono>
#include <cstdint>
#include <ctime>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiment/flip_report.h"
#include "experiment/ports/clock.h"

namespace overt {

class WindowContext;

/// Between two questions to a source that has to be asked; a hundredth of a refresh at 60 Hz.
inline constexpr timespec between_questions{0, 150'000};

/// A vertical blank: its number by the source's own count, and when it began.
struct VblankStamp {
    std::int64_t count = 0;
    SessionTime at;
    friend bool operator==(const VblankStamp&, const VblankStamp&) = default;
};

/// A source of time stamps. What it says may end at any time (a screen is unplugged, a server goes): nothing
/// is thrown then, there is just no stamp. To be used by the thread of its window.
class VblankClock {
  public:
    /// A source that keeps still for this long is given up: a screen slower than 10 Hz is none.
    static constexpr SessionDuration patience = std::chrono::milliseconds(250);

    virtual ~VblankClock() = default;

    /// Which kind of source; what is known of swaps may better it after the first few.
    virtual VblankSource source() const noexcept = 0;

    /// The last that has begun.
    virtual std::optional<VblankStamp> last() noexcept = 0;

    /// Waits for the first whose count is at least `count`, `patience` long.
    virtual std::optional<VblankStamp> await(std::int64_t count) noexcept = 0;

    /// The one at which the picture is lit that was swapped in after `before`, the last one at that time;
    /// waits for it. A source that only counts says the next after `before`, which is right while swaps wait
    /// for the vertical blank.
    virtual std::optional<VblankStamp> after_swap(const VblankStamp& before) noexcept {
        return await(before.count + 1);
    }
};

/// From microseconds since boot, as servers and kernels stamp (CLOCK_MONOTONIC, the clock of
/// std::chrono::steady_clock here), to the session's clock, which must be one that goes by itself.
class MonotonicTime {
  public:
    /// Reads both clocks, several times, and keeps the closest pair: right to less than a microsecond.
    explicit MonotonicTime(const Clock& clock);
    SessionTime of_microseconds(std::int64_t since_boot) const noexcept {
        return SessionTime(std::chrono::microseconds(since_boot) + offset_);
    }
    SessionTime of_nanoseconds(std::int64_t since_boot) const noexcept {
        return SessionTime(std::chrono::nanoseconds(since_boot) + offset_);
    }

  private:
    SessionDuration offset_{};
};

/// What speaks against a source after some refreshes of trying: no stamps, a count that does not go on, or
/// times of another clock than the session's; empty if it fits.
std::string why_unfit(VblankClock& source, const Clock& clock);

/// Whether a vertical blank keeps its time when it is asked for twice. Where there is no real one, servers
/// tell the time of the asking.
bool stamps_stand_still(VblankClock& source, Clock& clock);

/// A source to be tried. `open` throws GraphicsError saying why it is not there.
struct VblankCandidate {
    VblankSource source;
    std::function<std::unique_ptr<VblankClock>()> open;
};

/// The first that fits and is a real one, or else the first that fits; and why others do not.
struct VblankChoice {
    std::unique_ptr<VblankClock> clock; ///< null: nobody knows; flips are stamped when their swap returns
    bool is_real = false;               ///< see stamps_stand_still()
    std::vector<std::string> refused;   ///< "DRM: no card may be opened"
};
VblankChoice choose_vblank_clock(const std::vector<VblankCandidate>& candidates, Clock& clock);

/// All sources for a window, best first.
std::vector<VblankCandidate> vblank_candidates(const WindowContext& window, const Clock& clock);

} // namespace overt
