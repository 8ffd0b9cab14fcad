/// An X server of a test's own, ended with its object.
#pragma once

#include <csignal>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <dlfcn.h>
#include <fcntl.h>
#include <glob.h>
#include <sys/wait.h>
#include <unistd.h>

namespace overt::test {

class XServer {
  public:
    /// Starts the program of that name and points DISPLAY to it; is_running() says whether it came up. It
    /// must know -displayfd.
    explicit XServer(std::string program, std::vector<std::string> arguments) {
        int ends[2];
        if (pipe(ends) != 0)
            return;
        arguments.insert(arguments.begin(), {std::move(program), "-displayfd", std::to_string(ends[1])});
        std::vector<char*> words;
        for (std::string& argument : arguments)
            words.push_back(argument.data());
        words.push_back(nullptr);
        pid_ = fork();
        if (pid_ == 0) {
            close(ends[0]);
            const int nowhere = open("/dev/null", O_WRONLY);
            dup2(nowhere, 1);
            dup2(nowhere, 2);
            execvp(words.front(), words.data());
            _exit(127);
        }
        close(ends[1]);
        // The server writes its number once it is ready; without a server the pipe ends.
        for (char digit = 0; read(ends[0], &digit, 1) == 1 && digit != '\n';)
            number_ += digit;
        close(ends[0]);
        keep_driver_loaded();
        if (is_running())
            setenv("DISPLAY", (":" + number_).c_str(), 1);
    }
    ~XServer() {
        if (pid_ > 0) {
            kill(pid_, SIGTERM);
            waitpid(pid_, nullptr, 0);
        }
        unsetenv("DISPLAY");
    }
    XServer(const XServer&) = delete;
    XServer& operator=(const XServer&) = delete;

    bool is_running() const { return !number_.empty(); }

  private:
    /// Mesa's driver for software rendering keeps memory for good. A leak check sees that something still
    /// points to it only as long as the library is there.
    static void keep_driver_loaded() {
        glob_t found{};
        if (glob("/usr/lib/*/dri/swrast_dri.so", 0, nullptr, &found) == 0)
            dlopen(found.gl_pathv[0], RTLD_NOW | RTLD_NODELETE);
        globfree(&found);
    }

    pid_t pid_ = -1;
    std::string number_;
};

} // namespace overt::test
