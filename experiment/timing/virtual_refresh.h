/// The refreshes of a display that is not there, with all that a real one can do wrong.
#pragma once

#include <vector>

#include "experiment/base/random.h"
#include "experiment/ports/clock.h"
#include "experiment/ports/presentation_listener.h"
#include "experiment/ports/presenter.h"
#include "experiment/timing/display_faults.h"
#include "experiment/timing/refresh_count.h"

namespace overt {

/// The n-th refresh begins at n / rate of the session clock. On a virtual clock none is ever missed unless a
/// fault says so; on a real one a late caller finds that refreshes went by. Faults strike presentations only:
/// it has to be among the session's listeners to know when there is one.
///
/// After presentation_begins() nothing is allocated, and nothing throws.
class VirtualRefresh final : public PresentationListener {
  public:
    /// The clock must outlive this.
    VirtualRefresh(Clock& clock, double refresh_hz, DisplayFaults faults = {});

    /// Waits for the first refresh after now and reports it. `requested`: when the flip was asked for.
    FlipReport next(SessionTime requested) noexcept;
    FlipReport next() noexcept { return next(clock_->now()); }

    DisplayTiming timing() const noexcept;
    double refresh_hz() const noexcept { return refresh_hz_; } ///< nominal
    const DisplayFaults& faults() const noexcept { return faults_; }

    /// When a refresh truly begins, whatever its time stamp says.
    SessionTime time_of(std::int64_t refresh) const noexcept;
    /// By the display's own count, the refresh last lit, whatever was reported.
    std::int64_t last_lit() const noexcept { return last_; }

    /// Faults that struck in the last presentation.
    const std::vector<DisplayFault>& struck() const noexcept { return struck_; }

    void presentation_begins(const Trial& lit, int show) noexcept override;
    void flipped(const FlipRecord&) noexcept override {}
    void screen_shown(const Screen&, SessionTime) noexcept override { in_presentation_ = false; }

  private:
    std::int64_t first_after(SessionTime time) const noexcept;
    double amount_ms(DisplayFault::Kind kind, std::int64_t refresh) noexcept;
    void stand_still(double milliseconds) noexcept;
    void stamp(FlipReport& report) noexcept;

    Clock* clock_;
    double refresh_hz_;
    double true_hz_;
    DisplayFaults faults_;
    RandomStream jitter_;
    RefreshCount count_;
    std::int64_t last_ = 0; ///< by the display's own count
    bool in_presentation_ = false;
    std::int64_t onset_ = -1; ///< -1: the presentation's first flip is still to come
    std::vector<DisplayFault> planned_, struck_;
    std::size_t next_fault_ = 0;
};

} // namespace overt
