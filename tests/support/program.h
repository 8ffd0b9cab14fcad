/// The program itself, run as its users run it.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <sys/wait.h>

#include "tests/support/temporary_folder.h"

namespace overt::test {

inline std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

struct ProgramRun {
    int exit_code = -1; ///< 128 and the signal's number if it was killed
    std::string out, err;
};

inline std::string quoted_for_shell(const std::string& word) {
    std::string quoted = "'";
    for (const char letter : word)
        quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return quoted + "'";
}

/// Runs `overt ARGUMENTS` and waits for its end. `environment`: NAME=VALUE; what is left out is inherited.
inline ProgramRun run_overt(const std::vector<std::string>& arguments,
                            const std::vector<std::string>& environment = {}) {
    const TemporaryFolder folder;
    std::string command = "env";
    for (const std::string& variable : environment)
        command += " " + quoted_for_shell(variable);
    command += " " + quoted_for_shell(OVERT_PROGRAM);
    for (const std::string& argument : arguments)
        command += " " + quoted_for_shell(argument);
    const std::filesystem::path out = folder.path() / "out", err = folder.path() / "err";
    command += " >" + quoted_for_shell(out.string()) + " 2>" + quoted_for_shell(err.string()) + " </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text_of(out), text_of(err)};
}

} // namespace overt::test
