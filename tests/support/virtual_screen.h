/// A screen for windows where there is none: an Xvfb server of one's own, ended with its object.
#pragma once

#include <csignal>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

#include <dlfcn.h>
#include <fcntl.h>
#include <glob.h>
#include <sys/wait.h>
#include <unistd.h>

namespace overt::test {

class VirtualScreen {
  public:
    /// Starts a server and points DISPLAY to it. Throws if there is no Xvfb: ./test installs it.
    /// With a folder the server keeps its framebuffer there, for SeenScreen.
    static std::unique_ptr<VirtualScreen> start(int width, int height, int depth,
                                                const std::string& framebuffer_folder = {}) {
        int ends[2];
        if (pipe(ends) != 0)
            throw std::runtime_error("no pipe to Xvfb");
        const std::string screen =
            std::to_string(width) + "x" + std::to_string(height) + "x" + std::to_string(depth);
        const std::string fd = std::to_string(ends[1]);
        const pid_t pid = fork();
        if (pid == 0) {
            close(ends[0]);
            const int nowhere = open("/dev/null", O_WRONLY);
            dup2(nowhere, 1);
            dup2(nowhere, 2);
            const char* const end = nullptr;
            // Without -noreset it begins anew, and answers nobody for a moment, whenever its last client
            // leaves.
            execlp("Xvfb", "Xvfb", "-displayfd", fd.c_str(), "-screen", "0", screen.c_str(), "-nolisten",
                   "tcp", "-noreset", framebuffer_folder.empty() ? end : "-fbdir", framebuffer_folder.c_str(),
                   end);
            _exit(127);
        }
        close(ends[1]);
        // The server writes its number once it is ready; without a server the pipe ends.
        std::string number;
        for (char digit = 0; read(ends[0], &digit, 1) == 1 && digit != '\n';)
            number += digit;
        close(ends[0]);
        keep_driver_loaded();
        std::unique_ptr<VirtualScreen> started(new VirtualScreen(pid));
        if (number.empty())
            throw std::runtime_error("Xvfb did not start; is it installed (packages.txt)?");
        setenv("DISPLAY", (":" + number).c_str(), 1);
        return started;
    }
    ~VirtualScreen() {
        kill(pid_, SIGTERM);
        waitpid(pid_, nullptr, 0);
        unsetenv("DISPLAY");
    }
    VirtualScreen(const VirtualScreen&) = delete;
    VirtualScreen& operator=(const VirtualScreen&) = delete;

  private:
    /// Mesa's driver for software rendering keeps memory for good. A leak check sees that something still
    /// points to it only as long as the library is there.
    static void keep_driver_loaded() {
        glob_t found{};
        if (glob("/usr/lib/*/dri/swrast_dri.so", 0, nullptr, &found) == 0)
            dlopen(found.gl_pathv[0], RTLD_NOW | RTLD_NODELETE);
        globfree(&found);
    }

    explicit VirtualScreen(pid_t pid) : pid_(pid) {}
    pid_t pid_;
};

} // namespace overt::test
