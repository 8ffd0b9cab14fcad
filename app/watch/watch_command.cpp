#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "app/watch/terminal_watch.h"
#include "app/watch/watch_commands.h"
#include "devices/operator/operator_server.h"
#include "experiment/base/error.h"
#include "experiment/record/session_schema.h"

namespace overt {

namespace {

/// Sessions lie two folders deep: by protocol, then by observer and number.
std::vector<std::filesystem::path> served_in(const std::filesystem::path& sessions) {
    std::vector<std::filesystem::path> served;
    std::error_code error;
    for (std::filesystem::recursive_directory_iterator at(sessions, error), end; !error && at != end;
         at.increment(error)) {
        if (at.depth() >= 2)
            at.disable_recursion_pending();
        if (at->path().filename() == operator_socket_name && is_served(at->path()))
            served.push_back(at->path());
    }
    return served;
}

std::vector<OperatorCommand> commands_of(const WatchOptions& options) {
    std::vector<OperatorCommand> commands;
    for (const std::string& words : options.sends) {
        const std::optional<OperatorCommand> command = operator_command(words);
        if (!command)
            throw InputError(
                fmt::format("--send \"{}\" is no command. There are: {}", words, known_commands()));
        commands.push_back(*command);
    }
    return commands;
}

bool has_display() {
    const auto is_set = [](const char* name) {
        const char* const value = std::getenv(name);
        return value && *value;
    };
    return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
}

/// The window is a program of its own, beside this one, which it replaces. Throws InputError if it is not
/// there.
[[noreturn]] void become_window(const std::filesystem::path& socket) {
    const std::filesystem::path program =
        std::filesystem::read_symlink("/proc/self/exe").parent_path() / "overt-watch-window";
    ::execl(program.c_str(), program.c_str(), socket.c_str(), static_cast<char*>(nullptr));
    throw InputError(fmt::format("{}: cannot be begun: {}: overt watch --terminal needs no window",
                                 program.string(), std::strerror(errno)));
}

} // namespace

std::filesystem::path socket_of(const WatchOptions& options) {
    if (!options.socket.empty() && !options.session.empty())
        throw InputError("SESSION and --operator-socket say the same twice: give one of them");
    if (!options.socket.empty())
        return options.socket;
    if (!options.session.empty()) {
        if (std::filesystem::is_socket(options.session))
            return options.session;
        if (!std::filesystem::is_directory(options.session))
            throw InputError(fmt::format("{}: is no session's folder: name the folder that overt run prints",
                                         options.session.string()));
        const std::filesystem::path socket = options.session / operator_socket_name;
        if (std::filesystem::exists(options.session / session_file_name) || std::filesystem::exists(socket))
            return socket;
    }
    // A folder that is no session's may hold the one that runs.
    const std::filesystem::path& folder = options.session.empty() ? options.sessions : options.session;
    const std::vector<std::filesystem::path> served = served_in(folder);
    if (served.size() == 1)
        return served.front();
    if (served.empty())
        throw InputError(
            fmt::format("{}: no session that can be watched runs there: begin one with overt run … "
                        "--operator-socket, or name its folder, or its socket with --operator-socket here",
                        folder.string()));
    throw InputError(
        fmt::format("{}: {} sessions run there: name the folder of one", folder.string(), served.size()));
}

int run_watch(const WatchOptions& options) {
    const std::vector<OperatorCommand> commands = commands_of(options);
    const std::filesystem::path socket = socket_of(options);
    if (!options.in_terminal && !options.once && commands.empty() && has_display())
        become_window(socket);
    OperatorClient client(socket);
    for (const OperatorCommand& command : commands)
        if (!client.send(command))
            throw DeviceError(fmt::format("{}: was not sent: the session is gone", words_of(command)));
    if (options.once || (!commands.empty() && !options.in_terminal)) {
        print_once(client);
        return 0;
    }
    return watch_in_terminal(client);
}

} // namespace overt
