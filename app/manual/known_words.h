/// What can be said on a command line after a file that is named there: for the completion of shells.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/manual/command_table.h"

namespace overt {

/// The words that may stand for `kind` on a line with these words, as a shell has them, from the protocol or
/// the session among them; none where there is none, or none that can be read. Files are not checked and
/// nothing is drawn, so that it takes a moment only.
std::vector<std::string> known_words(WordKind kind, std::span<const std::string> line);

/// Answers a shell that asks for them by `overt completion-words KIND WORD…`, one a line. `words` as of a
/// command line, the program left out. False if it is another command.
bool answer_shell(std::span<const std::string> words);

} // namespace overt
