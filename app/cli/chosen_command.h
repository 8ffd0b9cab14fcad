/// How a command on the line comes to be run.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace overt {

/// What is to be run once the whole line has been read; gives the exit code. The command on the line puts
/// itself there, so it must outlive parsing.
using ChosenCommand = std::function<int()>;

} // namespace overt
