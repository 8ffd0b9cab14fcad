/// How a command on the line comes to be run. add_…_commands() puts commands on the line. What one does,
/// run_…(), takes its options and gives the exit code, 0 done, 1 failed; bad input is thrown as InputError,
/// which main turns into exit code 2.
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
