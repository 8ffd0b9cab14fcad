/// What stands between a window and its screen on a desktop: a compositor of X11, and Wayland's with
/// Xwayland.
#pragma once

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"

namespace overt::test {

/// A program that is started, and ended with its object.
class Neighbour {
  public:
    Neighbour(std::vector<std::string> words, const std::string& said) {
        std::vector<char*> pointers;
        for (std::string& word : words)
            pointers.push_back(word.data());
        pointers.push_back(nullptr);
        pid_ = fork();
        if (pid_ != 0)
            return;
        const int file = open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
        dup2(file, 1);
        dup2(file, 2);
        execvp(pointers.front(), pointers.data());
        _exit(127);
    }
    ~Neighbour() {
        kill(pid_, SIGTERM);
        waitpid(pid_, nullptr, 0);
    }
    Neighbour(const Neighbour&) = delete;
    Neighbour& operator=(const Neighbour&) = delete;

    /// Waits until it is ready; false: it is not there, or does not get there.
    bool comes_up(const std::function<bool()>& is_ready) const {
        for (int i = 0; i < 500; ++i) {
            if (is_ready())
                return true;
            siginfo_t ended{};
            if (waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
                ended.si_pid == pid_)
                return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        return false;
    }

  private:
    pid_t pid_ = -1;
};

/// picom on the server that DISPLAY names.
class Picom {
  public:
    /// Null where it is not installed. `is_ready`: whether a compositor is seen.
    static std::unique_ptr<Picom> start(const std::function<bool()>& is_ready) {
        std::unique_ptr<Picom> picom(new Picom);
        return picom->program_.comes_up(is_ready) ? std::move(picom) : nullptr;
    }

  private:
    Picom() : program_({"picom", "--backend", "xrender", "--config", "/dev/null"}, "/dev/null") {}
    Neighbour program_;
};

/// Weston without a screen, and its Xwayland, to which DISPLAY then points.
class WaylandDesktop {
  public:
    /// Null where one of them is not installed.
    static std::unique_ptr<WaylandDesktop> start() {
        std::unique_ptr<WaylandDesktop> desktop(new WaylandDesktop);
        const auto is_ready = [&] { return desktop->take_display(); };
        return desktop->program_.comes_up(is_ready) ? std::move(desktop) : nullptr;
    }
    ~WaylandDesktop() { unsetenv("DISPLAY"); }

  private:
    WaylandDesktop()
        : program_({"env", "XDG_RUNTIME_DIR=" + private_folder(), "weston", "--backend=headless-backend.so",
                    "--xwayland", "--no-config", "--socket=desk", "--width=1280", "--height=720"},
                   said()) {}

    std::string private_folder() const {
        chmod(folder_.path().c_str(), 0700);
        return folder_.path().string();
    }
    std::string said() const { return (folder_.path() / "said").string(); }

    /// Weston says where its X server listens; that server itself starts with its first client.
    bool take_display() const {
        const std::string words = "xserver listening on display ";
        std::ifstream file(said());
        for (std::string line; std::getline(file, line);)
            if (const auto at = line.find(words); at != std::string::npos) {
                setenv("DISPLAY", line.substr(at + words.size()).c_str(), 1);
                return true;
            }
        return false;
    }

    TemporaryFolder folder_;
    Neighbour program_;
};

} // namespace overt::test
