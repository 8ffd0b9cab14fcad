/// Swaps of a window's buffers, each with the refresh at which it is lit.
#pragma once

#include <memory>

#include "experiment/timing/refresh_count.h"
#include "render/vblank/vblank_clock.h"
#include "render/window/window_context.h"

namespace overt {

/// Counts refreshes for the ledger by the stamps of a source, as long as there are any and they make sense;
/// where they do not, by time. Allocates and throws nothing.
class FlipCount {
  public:
    explicit FlipCount(double nominal_hz) : nominal_hz_(nominal_hz), by_time_(nominal_hz) {}

    /// Fills in the refresh of a report whose times and source stand. `count`: the source's
    /// own number of the refresh; nothing if it has none. A count that the time between the stamps
    /// contradicts (a mode was set, the window changed screens) is not believed, and is followed from there.
    void number(FlipReport& report, std::optional<std::int64_t> count) noexcept;

  private:
    double nominal_hz_;
    RefreshCount by_time_;
    std::int64_t last_by_time_ = 0;
    std::optional<std::int64_t> last_count_;
    SessionTime last_blank_;
    std::int64_t refresh_ = 0;
};

class WindowFlips {
  public:
    /// The references must outlive this; `source` may be null. `uncertainty`: of the source's stamps.
    WindowFlips(WindowContext& window, Clock& clock, double nominal_hz, std::unique_ptr<VblankClock> source,
                SessionDuration uncertainty)
        : window_(&window), clock_(&clock), refresh_(from_seconds(1.0 / nominal_hz)), count_(nominal_hz),
          source_(std::move(source)), uncertainty_(uncertainty) {}

    /// Which source stamps now.
    VblankSource source() const noexcept {
        return source_ && !is_silent_ ? source_->source() : VblankSource::swap_return;
    }

    /// To be called before anything is drawn: where the display stands.
    void begin() noexcept;

    /// Swaps what has been drawn and waits for its refresh. A source that falls silent is given up for good,
    /// from this very flip on. Without one a pixel is drawn into the next picture and waited for: drivers
    /// give out the buffer for it when the swap is done, or a refresh later if they keep more than two; so
    /// the blank is known to a refresh at best, and the report says no less. That pixel is never shown: each
    /// picture covers the whole window.
    FlipReport swap(SessionTime requested) noexcept;

  private:
    void draw_a_pixel() const noexcept;

    WindowContext* window_;
    Clock* clock_;
    SessionDuration refresh_; ///< nominal
    FlipCount count_;
    std::unique_ptr<VblankClock> source_;
    SessionDuration uncertainty_;
    std::optional<VblankStamp> before_;
    bool is_silent_ = false;
};

} // namespace overt
