#include "app/cli/terminal_output.h"
#include "experiment/base/safe_text.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <unistd.h>

namespace overt {

namespace {

std::atomic<bool> is_output_lost = false, is_only_told = false, has_reader_gone = false;
std::atomic<int> own_controls = 0; ///< how many OwnControls there are

/// The write function of a stream on the file descriptor that `cookie` points to: all is taken, and what does
/// not arrive is remembered if it was standard output.
ssize_t write_or_forget(void* cookie, const char* bytes, std::size_t count) {
    const int descriptor = *static_cast<const int*>(cookie);
    const std::string_view given(bytes, count);
    // Texts of protocols and sessions come by here, and a terminal would take some of them for commands.
    const std::string text = own_controls > 0 ? std::string(given) : printable_text(given);
    for (std::size_t written = 0; written < text.size();) {
        const ssize_t now = ::write(descriptor, text.data() + written, text.size() - written);
        if (now > 0) {
            written += static_cast<std::size_t>(now);
        } else if (errno != EINTR) {
            // A reader that has read enough, such as head, has not lost anything.
            if (descriptor == STDOUT_FILENO)
                (errno == EPIPE ? has_reader_gone : is_output_lost) = true;
            break;
        }
    }
    return static_cast<ssize_t>(count);
}

/// The descriptor must outlive the stream.
std::FILE* stream_on(int& descriptor, int buffering) {
    if (::fcntl(descriptor, F_GETFD) == -1 && errno == EBADF) {
        const int nowhere = ::open("/dev/null", O_WRONLY); // the lowest free number, which may be another
        if (nowhere != descriptor) {
            ::dup2(nowhere, descriptor);
            ::close(nowhere);
        }
    }
    cookie_io_functions_t functions{};
    functions.write = write_or_forget;
    std::FILE* const stream = ::fopencookie(&descriptor, "w", functions);
    if (stream)
        std::setvbuf(stream, nullptr, buffering, BUFSIZ);
    return stream;
}

} // namespace

void keep_output_from_failing() {
    std::signal(SIGPIPE, SIG_IGN);
    // What is said comes line by line, also through a pipe, and in order with the progress on standard error.
    static int output_descriptor = STDOUT_FILENO, error_descriptor = STDERR_FILENO;
    if (std::FILE* const output = stream_on(output_descriptor, _IOLBF))
        stdout = output;
    if (std::FILE* const errors = stream_on(error_descriptor, _IONBF))
        stderr = errors;
}

bool all_output_arrived() {
    std::fflush(stdout);
    std::fflush(stderr);
    return is_only_told || !is_output_lost;
}

OwnControls::OwnControls() {
    std::fflush(stdout);
    ++own_controls;
}

OwnControls::~OwnControls() {
    std::fflush(stdout);
    --own_controls;
}

bool output_reader_has_gone() { return has_reader_gone; }

void output_is_only_told() { is_only_told = true; }

} // namespace overt
