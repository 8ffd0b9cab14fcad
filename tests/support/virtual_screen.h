/// A screen for windows where there is none: an Xvfb server of one's own, ended with its object.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/x_server.h"

namespace overt::test {

/// The environment of a program that is to see an X server alone, whatever desktop the tests run on. The
/// libraries behind a window keep memory until the end of the process.
inline const std::vector<std::string> x_server_alone{
    "WAYLAND_DISPLAY=", "XDG_SESSION_TYPE=", "ASAN_OPTIONS=detect_leaks=0"};

class VirtualScreen {
  public:
    /// Starts a server and points DISPLAY to it. Throws if there is no Xvfb: ./test installs it.
    /// With a folder the server keeps its framebuffer there, for SeenScreen.
    static std::unique_ptr<VirtualScreen> start(int width, int height, int depth,
                                                const std::string& framebuffer_folder = {}) {
        // Without -noreset it begins anew, and answers nobody for a moment, whenever its last client leaves.
        std::vector<std::string> arguments = {
            "-screen",
            "0",
            std::to_string(width) + "x" + std::to_string(height) + "x" + std::to_string(depth),
            "-nolisten",
            "tcp",
            "-noreset"};
        if (!framebuffer_folder.empty())
            arguments.insert(arguments.end(), {"-fbdir", framebuffer_folder});
        std::unique_ptr<VirtualScreen> started(new VirtualScreen(std::move(arguments)));
        if (!started->server_.is_running())
            throw std::runtime_error("Xvfb did not start; is it installed (packages.txt)?");
        return started;
    }

  private:
    explicit VirtualScreen(std::vector<std::string> arguments) : server_("Xvfb", std::move(arguments)) {}
    XServer server_;
};

} // namespace overt::test
