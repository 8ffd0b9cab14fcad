#include "app/watch/terminal_watch.h"

#include <array>
#include <cstdio>

#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "app/cli/interruption.h"
#include "app/cli/terminal_output.h"
#include "app/watch/watched_session.h"
#include "experiment/base/safe_text.h"
#include "experiment/watch/view_text.h"

namespace overt {

namespace {

constexpr std::chrono::milliseconds between_screens{100};

/// What the operator types, line by line, without waiting for it.
class TypedLines {
  public:
    std::optional<std::string> next() {
        pollfd wait{STDIN_FILENO, POLLIN, 0};
        if (!is_at_end_ && ::poll(&wait, 1, 0) > 0) {
            std::array<char, 512> bytes{};
            const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
            is_at_end_ = count <= 0;
            typed_.append(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
        }
        const std::size_t end = typed_.find('\n');
        if (end == std::string::npos)
            return std::nullopt;
        std::string line = typed_.substr(0, end);
        typed_.erase(0, end + 1);
        return line;
    }

  private:
    std::string typed_;
    bool is_at_end_ = false;
};

/// Takes typed commands and asks before they are sent.
class Commands {
  public:
    explicit Commands(OperatorClient& client) : client_(client) {}

    /// False if the operator leaves. `says`: what stands below the view.
    bool take(const std::string& line) {
        if (asked_) {
            const bool is_sure = line == "y" || line == "yes";
            says = is_sure && client_.send(*asked_) ? words_of(*asked_) + ": sent"
                                                    : words_of(*asked_) + ": not sent";
            asked_.reset();
            return true;
        }
        if (line == "leave")
            return false;
        const std::optional<OperatorCommand> command = operator_command(line);
        if (!command)
            says = line.empty()
                       ? ""
                       : fmt::format("\"{}\" is no command. There are: {}; leave", line, known_commands());
        else if (command->kind != OperatorCommand::Kind::key || command->key == ResponsePress::Key::pause)
            says = client_.send(*command) ? words_of(*command) + ": sent" : "the session is gone";
        else if (command->reason > static_cast<int>(client_.facts().skip_reasons.size()))
            says = fmt::format("the protocol has {} reasons", client_.facts().skip_reasons.size());
        else {
            asked_ = command;
            says = fmt::format("{}: are you sure? y or n", words_of(*command));
        }
        return true;
    }
    std::string says;

  private:
    OperatorClient& client_;
    std::optional<OperatorCommand> asked_;
};

winsize terminal_size() {
    winsize size{};
    if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 20 || size.ws_row < 10)
        size = {30, 100, 0, 0};
    return size;
}

/// Clears the terminal and has what is typed stand in its last row.
void begin_screen() {
    const OwnControls own;
    fmt::print("\x1b[2J\x1b[{};1H> ", terminal_size().ws_row);
}

/// Draws all rows but the last, and leaves the cursor where the operator types.
void draw(const ViewText& text, const std::string& says) {
    const winsize size = terminal_size();
    const OwnControls own;
    const std::string screen = printable_text(screen_of(text, size.ws_col, size.ws_row));
    std::string out = "\x1b"
                      "7\x1b[H";
    int rows = 0;
    for (std::size_t begin = 0; begin < screen.size() && rows < size.ws_row - 2; ++rows) {
        const std::size_t end = screen.find('\n', begin);
        out += screen.substr(begin, end - begin) + "\x1b[K\r\n";
        begin = end + 1;
    }
    for (; rows < size.ws_row - 2; ++rows)
        out += "\x1b[K\r\n";
    out += fmt::format("{:.{}}\x1b[K\x1b"
                       "8",
                       printable_text(says), size.ws_col - 1);
    fmt::print("{}", out);
    std::fflush(stdout);
}

} // namespace

int watch_in_terminal(OperatorClient& client) {
    const Interruption interruption;
    const bool draws = ::isatty(STDOUT_FILENO) != 0;
    WatchedSession watched(client);
    TypedLines typed;
    Commands commands(client);
    std::string last;
    if (draws)
        begin_screen();
    for (bool goes_on = true; goes_on && !Interruption::requested() && !output_reader_has_gone();) {
        goes_on = watched.read(between_screens);
        while (const std::optional<std::string> line = typed.next()) {
            if (!commands.take(*line))
                return 0;
            if (!draws && !commands.says.empty())
                fmt::print("{}\n", commands.says);
            if (draws)
                begin_screen();
        }
        if (draws) {
            draw(watched.text(), commands.says);
            continue;
        }
        for (const ViewedEvent& event : watched.news())
            fmt::print("{:.1f} s: {}{}{}\n", event.at_s, event.kind, event.detail.empty() ? "" : ": ",
                       event.detail);
        const SessionView& view = client.view();
        const std::string now = fmt::format("{} {} {} {}", view.trial, view.phase, view.done, view.asks);
        if (now != last || !goes_on)
            fmt::print("{}", summary_of(watched.text()));
        last = now;
        std::fflush(stdout);
    }
    if (!client.view().is_over && !Interruption::requested())
        fmt::print(stderr, "the session is gone without having said that it is over\n");
    return client.view().is_over || Interruption::requested() ? 0 : 1;
}

void print_once(OperatorClient& client) {
    WatchedSession watched(client);
    // The state comes within half a second after the greeting.
    const auto latest = std::chrono::steady_clock::now() + std::chrono::seconds(2);
    while (client.view().phase.empty() && watched.read(std::chrono::milliseconds(20)) &&
           std::chrono::steady_clock::now() < latest) {
    }
    for (const std::string& line : figures_of(watched.text()))
        fmt::print("{}\n", line);
}

} // namespace overt
