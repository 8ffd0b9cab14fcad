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
    /// The same, for those who are given std::ref of it.
    void operator()(std::string_view what, int done, int total, double share) {
        update(what, done, total, share);
    }

    /// What stands behind the bar on a terminal, as far as there is room; drawn at once.
    void remark(std::string text);

    /// Ends the line that stands, so that something else can be printed; the bar goes on below, with its
    /// time.
    void make_room();

    /// Ends the bar that stands.
    void finish();

  private:
    void draw_line();

    using SteadyTime = std::chrono::steady_clock::time_point;
    bool on_terminal_;
    std::string what_;
    std::string remark_;
    std::string left_; ///< the time that is left, as it was last said
    int done_ = 0, total_ = 0;
    double share_ = 0.0;
    bool stands_ = false; ///< a line on the terminal is unfinished
    SteadyTime started_{};
    SteadyTime drawn_{};
};

} // namespace overt
