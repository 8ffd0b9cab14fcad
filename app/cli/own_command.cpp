#include "app/cli/own_command.h"

#include <cerrno>
#include <cstring>

#include <csignal>
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

int code_of(int status) { return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status); }

} // namespace

OwnCommand::OwnCommand(const std::vector<std::string>& arguments, const std::filesystem::path& said) {
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, said.c_str(), O_WRONLY | O_CREAT | O_APPEND,
                                     0644);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    const int error = posix_spawn(&process_, program.c_str(), &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
        throw Error(fmt::format("a second process of overt cannot be started: {}", std::strerror(error)));
}

OwnCommand::~OwnCommand() {
    if (exit_code())
        return;
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
}

std::optional<int> OwnCommand::exit_code() {
    int status = 0;
    if (!code_ && waitpid(process_, &status, WNOHANG) == process_)
        code_ = code_of(status);
    return code_;
}

CommandCost OwnCommand::wait() {
    if (code_)
        return {};
    int status = 0;
    rusage usage{};
    while (wait4(process_, &status, 0, &usage) < 0 && errno == EINTR) {
    }
    code_ = code_of(status);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return {seconds(usage.ru_utime) + seconds(usage.ru_stime),
            1024e-6 * static_cast<double>(usage.ru_maxrss)};
}

} // namespace overt
