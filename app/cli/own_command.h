/// This program again, as a process of its own: for commands that have many others run at once.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace overt {

/// What a command took from its beginning to its end, all its threads together.
struct CommandCost {
    double processor_s = 0.0, peak_mb = 0.0;
};

/// A command that runs. Ctrl-C on the terminal reaches it, too.
class OwnCommand {
  public:
    /// Starts `overt arguments…`; what it says goes into a file. Throws Error if no process can be started.
    OwnCommand(const std::vector<std::string>& arguments, const std::filesystem::path& said);
    /// Asks a command that still runs to end, and waits until it has.
    ~OwnCommand();
    OwnCommand(const OwnCommand&) = delete;
    OwnCommand& operator=(const OwnCommand&) = delete;

    /// Nothing while it runs; 128 and the signal's number if a signal ended it.
    std::optional<int> exit_code();
    /// Waits until it has ended; exit_code() tells how. Of a command that had ended before, nothing is known.
    CommandCost wait();

  private:
    pid_t process_ = -1;
    std::optional<int> code_;
};

} // namespace overt
