/// Standard output and standard error that cannot end the program.
#pragma once

namespace overt {

/// Puts streams in the place of stdout and stderr that take whatever is written, also where the terminal is
/// gone, the reader of a pipe has ended or the disk is full: an experiment must not end because its output is
/// not read along. A stream that was closed by the caller is opened to nowhere, so that no file of ours takes
/// its number. Call once, first of all.
void keep_output_from_failing();

/// Writes out what is buffered; whether all of standard output has arrived so far. Standard error does not
/// count; neither does what comes after a pipe's reader has ended, which has read all that it wanted.
bool all_output_arrived();

/// While one lives, what is printed may move the cursor and clear lines. At all other times control
/// characters become visible (printable_text), whatever text they came with; so who prints within puts texts
/// that are not its own through printable_text().
class OwnControls {
  public:
    OwnControls();
    ~OwnControls();
    OwnControls(const OwnControls&) = delete;
    OwnControls& operator=(const OwnControls&) = delete;
};

/// Whether it has: for commands that print on and on, which have nobody to print for then.
bool output_reader_has_gone();

/// What the running command prints is not what it was called for: a session is on disk. Then
/// all_output_arrived() is true whatever happens.
void output_is_only_told();

} // namespace overt
