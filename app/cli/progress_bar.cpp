#include "app/cli/progress_bar.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace overt {

namespace {

constexpr int bar_width = 28;
/// In a log, long work says now and then that it lives.
constexpr std::chrono::minutes line_interval{5};

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
        const int filled = static_cast<int>(bar_width * std::clamp(share, 0.0, 1.0));
        fmt::print(stderr, "\r\033[K{:<32.32} [{:<{}}] {}/{}{}", what,
                   std::string(static_cast<std::size_t>(filled), '='), bar_width, done, total, left);
        std::fflush(stderr);
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

void ProgressBar::finish() {
    if (!what_.empty() && on_terminal_)
        fmt::print(stderr, "\n");
    what_.clear();
}

} // namespace overt
