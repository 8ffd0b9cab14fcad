/// Progress on the terminal, for anything that takes longer than a second.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace overt {

/// A bar that is redrawn in place on a terminal; elsewhere one line when a piece of work is done, and every
/// five minutes until then. Written to standard error.
class ProgressBar {
  public:
    ProgressBar();
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// `done` of `total` pieces of `what` are finished. A new `what` begins a new bar.
    void update(std::string_view what, int done, int total);

    /// The same for pieces that take unequal times: `share` of all the time is over, 0 … 1.
    void update(std::string_view what, int done, int total, double share);

    /// Ends the bar that stands, so that something else can be printed.
    void finish();

  private:
    using SteadyTime = std::chrono::steady_clock::time_point;
    bool on_terminal_;
    std::string what_;
    SteadyTime started_{};
    SteadyTime drawn_{};
};

} // namespace overt
