#include "devices/operator/operator_server.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "devices/operator/operator_client.h"
#include "devices/operator/operator_socket.h"
#include "experiment/base/error.h"
#include "experiment/base/utf8_text.h"

namespace overt {

namespace {

/// With more on its way to a view, gaze is not sent.
constexpr std::size_t most_waiting_for_gaze = 16384;

using SteadyClock = std::chrono::steady_clock;

constexpr std::size_t most_views = 4;
constexpr int longest_queue = 16; ///< of views that are not taken in yet
constexpr std::size_t most_recent = 100;
/// Lines that wait for a view that does not read: beyond this, events are left out.
constexpr std::size_t most_waiting_bytes = 262144;
constexpr std::chrono::milliseconds between_states{33}, longest_rest{15}, longest_farewell{1000},
    between_cameras{100};
/// Even where nothing changes, so that a view can tell a session that stands from one that is gone.
constexpr std::chrono::milliseconds longest_silence{500};
/// A view greets as soon as it is connected; who has not by then is none.
constexpr std::chrono::seconds longest_until_greeting{3};

} // namespace

void check_socket_place(const std::filesystem::path& socket) { const SocketAddress address(socket); }

namespace {

/// Refuses a place that is taken; a socket that nobody serves is not.
void check_is_free(const std::filesystem::path& file) {
    struct stat there {};
    if (::lstat(file.c_str(), &there) != 0)
        return;
    const char* const taken = !S_ISSOCK(there.st_mode) ? "there is a file that is no socket"
                              : is_served(file)        ? "another session serves this socket"
                                                       : nullptr;
    if (taken)
        throw InputError(fmt::format("{}: {}: name another with --operator-socket", file.string(), taken));
}

/// A socket in the file system.
struct OwnedSocket {
    int descriptor = -1;
    dev_t device = 0; ///< with the inode, by which the file is known again
    ino_t inode = 0;
};

/// Whether the file is this very socket: what else lies there by now is not ours.
bool is_still(const std::filesystem::path& file, dev_t device, ino_t inode) {
    struct stat there {};
    return ::lstat(file.c_str(), &there) == 0 && S_ISSOCK(there.st_mode) && there.st_dev == device &&
           there.st_ino == inode;
}

/// Takes away a socket that nobody serves, as killed sessions leave them, and nothing else.
void remove_unserved(const std::filesystem::path& file) {
    struct stat there {};
    if (::lstat(file.c_str(), &there) == 0 && S_ISSOCK(there.st_mode) && !is_served(file))
        ::unlink(file.c_str());
}

/// Whoever finds the file can connect: it gets its name when all is ready. Nothing that lies there is
/// replaced.
OwnedSocket open_listener(const std::filesystem::path& file) {
    check_socket_place(file);
    check_is_free(file);
    static std::atomic<int> number{0};
    const std::filesystem::path unready =
        file.parent_path() / fmt::format(".operator.{}-{}", ::getpid(), number++);
    const SocketAddress address(unready);
    OwnedSocket opened{::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)};
    struct stat made {};
    bool is_bound = false;
    const auto open = [&] {
        is_bound =
            opened.descriptor != -1 && ::bind(opened.descriptor, address.address(), address.size()) == 0;
        return is_bound && ::chmod(unready.c_str(), S_IRUSR | S_IWUSR) == 0 &&
               ::lstat(unready.c_str(), &made) == 0 && ::listen(opened.descriptor, longest_queue) == 0;
    };
    bool is_open = open();
    if (is_open) {
        remove_unserved(file);
        is_open = ::renameat2(AT_FDCWD, unready.c_str(), AT_FDCWD, file.c_str(), RENAME_NOREPLACE) == 0;
    }
    if (!is_open) {
        const std::string why = std::strerror(errno);
        if (is_bound)
            ::unlink(unready.c_str());
        if (opened.descriptor != -1)
            ::close(opened.descriptor);
        throw DeviceError(fmt::format("{}: the operator's socket cannot be opened: {}", file.string(), why));
    }
    opened.device = made.st_dev;
    opened.inode = made.st_ino;
    return opened;
}

/// Whether the program at the other end runs for this user, or for the system's.
bool is_of_this_user(int socket) {
    ucred peer{};
    socklen_t size = sizeof peer;
    return ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 &&
           (peer.uid == ::geteuid() || peer.uid == 0);
}

/// An event counter that never blocks.
int open_counter() {
    const int counter = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    if (counter == -1)
        throw DeviceError(
            fmt::format("the operator's view: no event counter can be had: {}", std::strerror(errno)));
    return counter;
}

/// With every n-th pixel in each direction.
ViewedCamera made_small(const CameraImage& image) {
    const int step =
        std::max({1, (image.width_px + ViewedCamera::most_width_px - 1) / ViewedCamera::most_width_px,
                  (image.height_px + ViewedCamera::most_height_px - 1) / ViewedCamera::most_height_px});
    ViewedCamera small{
        (image.width_px + step - 1) / step, (image.height_px + step - 1) / step, {}, image.title};
    for (int y = 0; y < image.height_px; y += step)
        for (int x = 0; x < image.width_px; x += step) {
            const auto pixel = image.rgba.begin() + 4 * (std::ptrdiff_t{y} * image.width_px + x);
            small.rgb.insert(small.rgb.end(), pixel, pixel + 3);
        }
    return small;
}

} // namespace

struct OperatorServer::View {
    int socket = -1;
    bool is_greeted = false;
    std::string received, waiting;
    std::int64_t left_out = 0; ///< lines of events
    bool is_gone = false;
    SteadyClock::time_point state_told{};
    SteadyClock::time_point came = SteadyClock::now();
};

OperatorServer::OperatorServer(Options options)
    : options_(std::move(options)), woken_(open_counter()), news_(options_.ring_capacity),
      builder_(std::move(options_.trials), options_.completed, options_.facts.slots) {
    OwnedSocket opened;
    try {
        opened = open_listener(options_.socket);
    } catch (...) {
        ::close(woken_);
        throw;
    }
    listener_ = opened.descriptor;
    device_ = opened.device;
    inode_ = opened.inode;
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

OperatorServer::~OperatorServer() {
    thread_.request_stop();
    thread_.join();
    for (const View& view : views_)
        ::close(view.socket);
    ::close(listener_);
    ::close(woken_);
    if (is_still(options_.socket, device_, inode_))
        ::unlink(options_.socket.c_str());
}

void OperatorServer::push_gaze(const GazeNews& gaze) noexcept {
    if (!gaze_.try_push(gaze))
        dropped_.fetch_add(1, std::memory_order_relaxed);
    constexpr std::uint64_t one = 1;
    if (is_watched_.load(std::memory_order_relaxed))
        // A counter that is full has woken the thread already.
        [[maybe_unused]]
        const ssize_t written = ::write(woken_, &one, sizeof one);
}

void OperatorServer::show_camera(const CameraImage& image) {
    const auto now = std::chrono::steady_clock::now();
    if (!is_watched_ || image.width_px < 1 || image.height_px < 1 || now - camera_told_ < between_cameras)
        return;
    camera_told_ = now;
    ViewedCamera small = made_small(image);
    const std::lock_guard lock(camera_lock_);
    camera_ = std::move(small);
}

void OperatorServer::serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        wait_for_views();
        take_news();
        tell_state(false);
        take_gaze();
        take_camera();
        for (View& view : views_) {
            send_waiting(view);
            if (!view.is_greeted && !view.is_gone && SteadyClock::now() - view.came > longest_until_greeting)
                cut_off(view, "has not greeted");
        }
        std::erase_if(views_, [](const View& view) {
            if (view.is_gone)
                ::close(view.socket);
            return view.is_gone;
        });
    }
    // A view that came just now may have greeted.
    for (View& view : views_)
        receive(view);
    take_news();
    builder_.set_over();
    tell_state(true);
    const auto latest = SteadyClock::now() + longest_farewell;
    const auto has_more = [](const View& view) { return !view.is_gone && !view.waiting.empty(); };
    while (std::any_of(views_.begin(), views_.end(), has_more) && SteadyClock::now() < latest) {
        for (View& view : views_)
            send_waiting(view);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

void OperatorServer::take_news() {
    for (ViewNews news; news_.try_pop(news);) {
        is_new_ = true;
        is_other_trial_ = is_other_trial_ || news.kind == ViewNews::Kind::phase ||
                          news.kind == ViewNews::Kind::trial_started;
        const std::optional<ViewedEvent> event = builder_.apply(news);
        if (!event)
            continue;
        std::string line = line_of(*event);
        for (View& view : views_) {
            if (!view.is_greeted)
                continue;
            if (view.waiting.size() + line.size() > most_waiting_bytes)
                ++view.left_out;
            else
                view.waiting += line;
        }
        recent_.push_back(std::move(line));
        if (recent_.size() > most_recent)
            recent_.pop_front();
    }
}

void OperatorServer::take_gaze() {
    std::array<GazeNews, longest_gaze> taken;
    std::array<ViewedGaze, longest_gaze> points;
    for (std::size_t count = points.size(); count == points.size();) {
        count = 0;
        while (count < taken.size() && gaze_.try_pop(taken[count]))
            ++count;
        if (count == 0)
            return;
        // What was told before this gaze is there by now, such as its trial; it may not have been a moment
        // ago.
        take_news();
        tell_state(false);
        for (std::size_t i = 0; i < count; ++i)
            points[i] = builder_.placed(taken[i]);
        std::string line;
        for (View& view : views_) {
            // Gaze that cannot be sent now would be old.
            if (!view.is_greeted || view.waiting.size() > most_waiting_for_gaze)
                continue;
            if (line.empty())
                line = line_of(std::span(points).first(count));
            view.waiting += line;
        }
    }
}

void OperatorServer::take_camera() {
    std::optional<ViewedCamera> camera;
    {
        const std::lock_guard lock(camera_lock_);
        camera.swap(camera_);
    }
    if (!camera)
        return;
    const std::string line = line_of(*camera);
    for (View& view : views_)
        if (view.is_greeted && view.waiting.empty())
            view.waiting += line;
}

void OperatorServer::wait_for_views() {
    std::array<pollfd, most_views + 2> waits{};
    const auto reading = [](int descriptor) {
        return pollfd{.fd = descriptor, .events = POLLIN, .revents = {}};
    };
    waits[0] = reading(listener_);
    waits[1] = reading(woken_);
    for (std::size_t i = 0; i < views_.size(); ++i)
        waits[i + 2] = reading(views_[i].socket);
    const std::size_t count = views_.size();
    if (::poll(waits.data(), count + 2, static_cast<int>(longest_rest.count())) <= 0)
        return;
    for (std::size_t i = 0; i < count; ++i)
        if (waits[i + 2].revents != 0)
            receive(views_[i]);
    if (waits[1].revents != 0) {
        std::uint64_t times = 0;
        [[maybe_unused]] const ssize_t count_read = ::read(woken_, &times, sizeof times);
    }
    if (waits[0].revents != 0)
        accept_view();
    is_watched_.store(!views_.empty(), std::memory_order_relaxed);
}

void OperatorServer::accept_view() {
    const int socket = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (socket == -1)
        return;
    if (!is_of_this_user(socket)) {
        ::close(socket);
        if (options_.tell)
            options_.tell("operator's view: a program of another user was turned away");
        return;
    }
    // Who has not greeted makes room for who may.
    if (views_.size() == most_views) {
        const auto silent = std::ranges::find(views_, false, &View::is_greeted);
        if (silent != views_.end()) {
            ::close(silent->socket);
            views_.erase(silent);
        }
    }
    if (views_.size() == most_views) {
        ::close(socket);
        if (options_.tell)
            options_.tell(
                fmt::format("operator's view: {} are open, and another was turned away", most_views));
        return;
    }
    views_.push_back({});
    views_.back().socket = socket;
    views_.back().waiting = line_of(options_.facts);
}

void OperatorServer::receive(View& view) {
    std::array<char, 4096> bytes{};
    // What is sent faster waits: a view cannot keep the thread.
    const ssize_t count = ::recv(view.socket, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (count == 0 || (count == -1 && errno != EAGAIN && errno != EINTR)) {
        view.is_gone = true;
        return;
    }
    if (count == -1)
        return;
    view.received.append(bytes.data(), static_cast<std::size_t>(count));
    for (std::size_t end = 0; !view.is_gone && (end = view.received.find('\n')) != std::string::npos;) {
        const std::string line = view.received.substr(0, end);
        view.received.erase(0, end + 1);
        understand(view, line);
    }
    if (!view.is_gone && view.received.size() > longest_command_line)
        cut_off(view, "sent a line without an end");
}

void OperatorServer::understand(View& view, std::string_view line) {
    const CommandLine read = line.size() <= longest_command_line ? read_command_line(line) : CommandLine();
    if (read.greeting && *read.greeting == view_version) {
        if (!view.is_greeted)
            for (const std::string& recent : recent_)
                view.waiting += recent;
        view.is_greeted = true;
        return;
    }
    if (read.greeting)
        return cut_off(view, fmt::format("speaks version {} of the language, this session version {}",
                                         *read.greeting, view_version));
    if (!read.command || !view.is_greeted)
        return cut_off(view, fmt::format("sent \"{}\", which is no command",
                                         ascii_of(line.substr(0, std::min<std::size_t>(line.size(), 60)))));
    if (!commands_.try_push(*read.command))
        view.waiting += line_of(
            ViewedEvent{builder_.view().time_s, -1, "operator's view",
                        fmt::format("{}: was not taken: too many commands wait", words_of(*read.command))});
}

void OperatorServer::cut_off(View& view, const std::string& why) const {
    view.is_gone = true;
    if (options_.tell)
        options_.tell(
            fmt::format("operator's view: a program {}: it was cut off, and the session goes on", why));
}

void OperatorServer::tell_state(bool even_if_old) {
    const auto now = SteadyClock::now();
    std::string line;
    for (View& view : views_) {
        if (!view.is_greeted || view.is_gone)
            continue;
        const auto since = now - view.state_told;
        // A state replaces the one before: none is put behind lines that wait.
        // Of another trial before its gaze.
        const bool is_due =
            view.waiting.empty() &&
            (is_other_trial_ || (is_new_ && since >= between_states) || since >= longest_silence);
        if (!is_due && !even_if_old)
            continue;
        if (line.empty()) {
            builder_.set_dropped(dropped());
            line = line_of(builder_.view());
        }
        if (view.left_out > 0)
            view.waiting +=
                line_of(ViewedEvent{builder_.view().time_s, -1, "operator's view",
                                    fmt::format("{} messages were left out here: this view did not "
                                                "read them; the record has them all",
                                                view.left_out)});
        view.left_out = 0;
        view.waiting += line;
        view.state_told = now;
    }
    if (line.empty())
        return;
    is_new_ = is_other_trial_ = false;
}

void OperatorServer::send_waiting(View& view) {
    while (!view.waiting.empty() && !view.is_gone) {
        const ssize_t sent =
            ::send(view.socket, view.waiting.data(), view.waiting.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent == -1) {
            view.is_gone = errno != EAGAIN && errno != EINTR;
            return;
        }
        view.waiting.erase(0, static_cast<std::size_t>(sent));
    }
}

} // namespace overt
