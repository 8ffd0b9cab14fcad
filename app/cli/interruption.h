/// Ctrl-C, a hang-up or a request to end, taken note of instead of ending the program at once: a display box
/// has to be switched back, and the trial's rows have to reach the disk.
#pragma once

#include <array>
#include <atomic>
#include <csignal>
#include <string_view>

namespace overt {

/// While one lives, the first SIGINT, SIGTERM or SIGHUP only sets a flag; the second ends the program as it
/// would have. A signal that is ignored (nohup) stays so. One at a time.
class Interruption {
  public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    /// Set once a signal came, by its handler.
    static const std::atomic<bool>& requested() noexcept;

    /// Throws Error if a signal came: "`what` was interrupted: nothing was written."
    static void check(std::string_view what);

  private:
    std::array<struct sigaction, 3> before_{};
};

} // namespace overt
