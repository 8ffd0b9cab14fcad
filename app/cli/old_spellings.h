/// Options that had another name once: scripts that use it go on working.
#pragma once

#include <string>
#include <vector>

namespace overt {

/// The words of a command line, the program's name left out, with the names that options have now. The old
/// ones stand in no help and no completion.
std::vector<std::string> with_new_spellings(std::vector<std::string> words);

} // namespace overt
