/// A desk with an operator's monitor and the observer's: an Xorg server whose card is a dummy, with RandR,
/// GLX, Present and gamma tables, and two monitors of 1920 x 1080 pixels.
#pragma once

#include <cstdlib>
#include <memory>
#include <string>

#include "tests/support/temporary_folder.h"
#include "tests/support/x_server.h"

namespace overt::test {

class TwoMonitors {
  public:
    /// Monitor 1 (DUMMY0) at 59.93 Hz, and right of it monitor 2 (DUMMY1) at 119.98 Hz; both also have the
    /// other's mode. Null where there is no such server (packages.txt), or Xorg may not be started.
    static std::unique_ptr<TwoMonitors> start() {
        std::unique_ptr<TwoMonitors> desk(new TwoMonitors);
        return desk->server_.is_running() && desk->arrange() ? std::move(desk) : nullptr;
    }

    /// `arguments` as for xrandr; whether it could be done.
    static bool xrandr(const std::string& arguments) {
        return std::system(("xrandr " + arguments + " >/dev/null 2>&1").c_str()) == 0;
    }

  private:
    TwoMonitors()
        : server_("Xorg", {"-config", written_configuration(), "-logfile", (folder_.path() / "log").string(),
                           "-noreset", "-nolisten", "tcp", "-novtswitch", "-sharevts"}) {}

    std::string written_configuration() {
        return folder_
            .file("xorg.conf", R"(
Section "Device"
  Identifier "card"
  Driver "dummy"
  VideoRam 256000
EndSection
Section "Screen"
  Identifier "screen"
  Device "card"
  DefaultDepth 24
  SubSection "Display"
    Depth 24
    Modes "1024x768"
    Virtual 4096 2160
  EndSubSection
EndSection
Section "ServerFlags"
  Option "AutoAddDevices" "false"
  Option "AllowMouseOpenFail" "true"
EndSection
)")
            .string();
    }

    /// Both modes are those that `cvt -r 1920 1080` writes, the faster one with a clock for 120 Hz.
    /// Only a query makes the server see that the second output is connected now.
    static bool arrange() {
        return xrandr("--newmode slow 138.50 1920 1968 2000 2080 1080 1083 1088 1111 +hsync -vsync") &&
               xrandr("--newmode fast 285.50 1920 1968 2000 2080 1080 1083 1088 1144 +hsync -vsync") &&
               xrandr("--addmode DUMMY0 slow") && xrandr("--addmode DUMMY0 fast") &&
               xrandr("--addmode DUMMY1 slow") && xrandr("--addmode DUMMY1 fast") &&
               xrandr(
                   "--output DUMMY0 --primary --mode slow --output DUMMY1 --mode fast --right-of DUMMY0") &&
               xrandr("--query");
    }

    TemporaryFolder folder_;
    XServer server_;
};

} // namespace overt::test
