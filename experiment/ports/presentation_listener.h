/// The port of those that follow what is shown: a simulated observer, live maps, a simulated display.
#pragma once

#include "experiment/flip_report.h"
#include "experiment/ports/presenter.h"
#include "experiment/trial.h"

namespace overt {

/// Is told of each flip and each screen on the session's thread, also between a presentation's first and last
/// flip: allocates and throws nothing.
class PresentationListener {
  public:
    virtual ~PresentationListener() = default;
    /// A show of this trial begins with the next flip, and `lit` is what it lights of the trial: no more, and
    /// in the trial's order. `show`: which of the attempt's it is, from 0.
    virtual void presentation_begins(const Trial& lit, int show) noexcept = 0;
    /// Of the first that is lit.
    virtual void flipped(const FlipRecord& flip) noexcept = 0;
    /// Of the others, after the flip that it belongs to; places are those of `lit`.
    virtual void slot_flipped(const SlotFlip& /*flip*/) noexcept {}
    virtual void screen_shown(const Screen& screen, SessionTime onset) noexcept = 0;
};

} // namespace overt
