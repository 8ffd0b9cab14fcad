/// A device at the far end of a terminal line of the kernel, answered by a thread.
#pragma once

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <termios.h>
#include <unistd.h>

namespace overt::test {

/// Reads what is written to the line and writes what `answer` makes of it, on a thread of its own, until it
/// is destroyed. The descriptor (a master side) stays the caller's.
class TerminalDevice {
  public:
    /// From bytes written and seconds since this was made to bytes said.
    using Answer = std::function<std::string(std::string_view bytes, double now_s)>;

    /// `stream`, if given, is asked each millisecond for something to say without being asked.
    TerminalDevice(int master, Answer answer, std::function<std::string(double now_s)> stream = {})
        : thread_([master = non_blocking(master), answer = std::move(answer),
                   stream = std::move(stream)](const std::stop_token& stop) {
              // A device answers also while the machine is busy. Where that is refused it is as good
              // without, most of the time.
              setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), -10);
              const auto begun = std::chrono::steady_clock::now();
              while (!stop.stop_requested()) {
                  pollfd waiting{master, POLLIN, 0};
                  const bool ready =
                      poll(&waiting, 1, stream ? 1 : 20) > 0 && (waiting.revents & POLLIN) != 0;
                  const double now_s =
                      std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
                  char bytes[512];
                  const ssize_t count = ready ? read(master, bytes, sizeof bytes) : 0;
                  std::string said;
                  if (count > 0)
                      said = answer({bytes, static_cast<std::size_t>(count)}, now_s);
                  if (stream)
                      said += stream(now_s);
                  // Never waits in write(): nobody may be there to read.
                  for (std::string_view left = said; !left.empty() && !stop.stop_requested();) {
                      const ssize_t written = write(master, left.data(), left.size());
                      if (written > 0)
                          left.remove_prefix(static_cast<std::size_t>(written));
                      else if (errno == EAGAIN)
                          std::this_thread::sleep_for(std::chrono::milliseconds(1));
                      else
                          break;
                  }
                  if (!ready &&
                      (waiting.revents & POLLHUP) != 0) // nobody has the other side open at the moment
                      std::this_thread::sleep_for(std::chrono::milliseconds(1));
              }
          }) {}

  private:
    static int non_blocking(int descriptor) {
        fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) | O_NONBLOCK);
        return descriptor;
    }

    std::jthread thread_;
};

/// A pseudo-terminal: path() is the tty that is opened, master() the device.
class Terminal {
  public:
    /// Not inherited: a program that is started would keep the line up.
    Terminal() : master_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
        char name[128];
        if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0 ||
            ptsname_r(master_, name, sizeof name) != 0)
            throw std::runtime_error("no pseudo-terminal can be made");
        path_ = name;
    }
    ~Terminal() { hang_up(); }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    int master() const { return master_; }
    const std::string& path() const { return path_; }

    /// As unplugging does to a tty.
    void hang_up() {
        if (master_ >= 0)
            close(master_);
        master_ = -1;
    }

  private:
    int master_;
    std::string path_;
};

} // namespace overt::test
