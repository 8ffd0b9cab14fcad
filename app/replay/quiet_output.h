/// What a command that is run inside of another would say goes into a file.
#pragma once

#include <filesystem>

namespace overt {

/// While one lives, standard output and standard error are that file. One at a time.
class QuietOutput {
  public:
    /// Throws RecordError if the file cannot be made.
    explicit QuietOutput(const std::filesystem::path& file);
    ~QuietOutput();
    QuietOutput(const QuietOutput&) = delete;
    QuietOutput& operator=(const QuietOutput&) = delete;

    /// Says something where the terminal is, in between.
    template <class Say> void aside(const Say& say) {
        leave();
        say();
        enter();
    }

  private:
    void enter() const;
    void leave() const;
    int file_ = -1, out_ = -1, err_ = -1;
};

} // namespace overt
