#include "render/window/program_answer.h"

#include <array>
#include <csignal>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ; // NOLINT(readability-redundant-declaration): not every libc declares it

namespace overt {
namespace {

constexpr std::size_t longest_answer = 65536;

/// Both ends closed at the end.
struct Pipe {
    std::array<int, 2> ends{-1, -1};
    Pipe() {
        if (::pipe2(ends.data(), O_CLOEXEC) != 0)
            ends = {-1, -1};
    }
    ~Pipe() {
        close_end(0);
        close_end(1);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    void close_end(std::size_t which) {
        if (ends[which] >= 0)
            ::close(ends[which]);
        ends[which] = -1;
    }
};

/// -1: it could not be begun.
pid_t spawn(const std::vector<std::string>& arguments, int output) {
    std::vector<char*> words;
    for (const std::string& argument : arguments)
        words.push_back(const_cast<char*>(argument.c_str())); // as the call wants it; it changes nothing
    words.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions, output, 1);
    ::posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    pid_t child = -1;
    if (::posix_spawnp(&child, words.front(), &actions, nullptr, words.data(), environ) != 0)
        child = -1;
    ::posix_spawn_file_actions_destroy(&actions);
    return child;
}

/// All until its end; nothing if that does not come in time.
std::optional<std::string> read_until(int from, std::chrono::steady_clock::time_point end) {
    std::string said;
    for (std::array<char, 4096> buffer{};;) {
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
        pollfd waited{from, POLLIN, 0};
        if (left.count() <= 0 || ::poll(&waited, 1, static_cast<int>(left.count())) <= 0)
            return std::nullopt;
        const ssize_t count = ::read(from, buffer.data(), buffer.size());
        if (count < 0)
            return std::nullopt;
        if (count == 0)
            return said;
        said.append(buffer.data(), static_cast<std::size_t>(count));
        if (said.size() > longest_answer)
            return std::nullopt;
    }
}

} // namespace

std::optional<std::string> program_answer(const std::vector<std::string>& arguments,
                                          std::chrono::milliseconds limit) {
    Pipe pipe;
    if (arguments.empty() || pipe.ends[0] < 0)
        return std::nullopt;
    const pid_t child = spawn(arguments, pipe.ends[1]);
    if (child < 0)
        return std::nullopt;
    pipe.close_end(1);
    std::optional<std::string> said = read_until(pipe.ends[0], std::chrono::steady_clock::now() + limit);
    if (!said)
        ::kill(child, SIGKILL);
    int status = 0;
    if (::waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        return std::nullopt;
    return said;
}

} // namespace overt
