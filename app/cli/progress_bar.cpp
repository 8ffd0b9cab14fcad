#include "app/cli/progress_bar.h"
#include "app/cli/terminal_output.h"
#include "experiment/base/safe_text.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace overt {

namespace {

constexpr int bar_width = 28;
/// In a log, long work says now and then that it lives.
constexpr std::chrono::minutes line_interval{5};

/// As many of a text's first characters as there are columns for.
std::string first_columns(const std::string& text, std::size_t columns) {
    std::size_t shown = 0, end = 0;
    while (end < text.size() && shown < columns) {
        do
            ++end;
        while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80);
        ++shown;
    }
    return text.substr(0, end);
}

std::size_t terminal_columns() {
    winsize size{};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string time_text(double seconds) {
    return seconds < 90.0     ? fmt::format("{:.0f} s", seconds)
           : seconds < 5400.0 ? fmt::format("{:.1f} min", seconds / 60.0)
                              : fmt::format("{:.1f} h", seconds / 3600.0);
}

} // namespace

ProgressBar::ProgressBar() : on_terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() { finish(); }

void ProgressBar::update(std::string_view what, int done, int total) {
    update(what, done, total, total > 0 ? static_cast<double>(done) / total : 1.0);
}

void ProgressBar::update(std::string_view what, int done, int total, double share) {
    const auto now = std::chrono::steady_clock::now();
    if (what != what_) {
        finish();
        what_ = what;
        started_ = now;
        drawn_ = {};
    }
    const double elapsed_s = std::chrono::duration<double>(now - started_).count();
    const bool complete = done >= total;
    std::string left;
    if (!complete && share > 0.0 && elapsed_s > 1.0)
        left = fmt::format(", {} left", time_text(elapsed_s * (1.0 - share) / share));
    if (on_terminal_ && (complete || now - drawn_ > std::chrono::milliseconds(60))) {
        done_ = done;
        total_ = total;
        share_ = share;
        left_ = left;
        draw_line();
        drawn_ = now;
    }
    if (!on_terminal_ && !complete && now - std::max(drawn_, started_) > line_interval) {
        fmt::print(stderr, "{}: {} of {}{}\n", what, done, total, left);
        drawn_ = now;
    }
    if (complete) {
        if (!on_terminal_)
            fmt::print(stderr, "{}: {} done in {}\n", what, total, time_text(elapsed_s));
        finish();
    }
}

void ProgressBar::draw_line() {
    const int filled = static_cast<int>(bar_width * std::clamp(share_, 0.0, 1.0));
    std::string line =
        fmt::format("{:<{}.32} [{:<{}}] {}/{}{}", what_, remark_.empty() ? 32 : 0,
                    std::string(static_cast<std::size_t>(filled), '='), bar_width, done_, total_, left_);
    if (!remark_.empty())
        line += "  " + remark_;
    const OwnControls own;
    fmt::print(stderr, "\r\033[K{}", first_columns(printable_text(line), terminal_columns() - 1));
    std::fflush(stderr);
    stands_ = true;
}

void ProgressBar::remark(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    remark_ = std::move(text);
    if (on_terminal_ && !what_.empty())
        draw_line();
}

void ProgressBar::make_room() {
    if (stands_)
        fmt::print(stderr, "\n");
    stands_ = false;
}

void ProgressBar::finish() {
    make_room();
    what_.clear();
    remark_.clear();
}

} // namespace overt
