/// The socket beside a running session to which an operator's view connects, and the thread that serves it.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <sys/types.h>

#include "experiment/base/spsc_ring.h"
#include "experiment/ports/setup_screen.h"
#include "experiment/watch/operator_command.h"
#include "experiment/watch/view_news.h"

namespace overt {

/// In a session's folder.
inline constexpr std::string_view operator_socket_name = "operator.sock";

/// Refuses, before a session begins, a place where no socket can be: throws InputError.
void check_socket_place(const std::filesystem::path& socket);

/// Serves up to four views on a thread of its own. The session's thread only pushes news and takes commands:
/// it never waits for a view, nor for the thread. What finds no room in the ring is dropped and counted; a
/// view that does not read misses lines and is told how many. A view that sends what is not understood is cut
/// off.
class OperatorServer {
  public:
    struct Options {
        std::filesystem::path socket;
        SessionFacts facts;
        std::vector<ViewedTrial> trials; ///< by their index
        int completed = 0;               ///< of them, before this sitting
        std::size_t ring_capacity = 8192;
        /// Told on the server's thread what the operator should know; may be empty.
        std::function<void(const std::string&)> tell = {};
    };

    /// Opens the socket, for programs of this user alone. One that nobody serves any more is replaced, and
    /// nothing else that lies there ever is. Throws InputError if another session serves it, and DeviceError
    /// if it cannot be opened.
    explicit OperatorServer(Options options);
    /// Tells the views what is left and that it is over, for at most a second, and removes the
    /// socket.
    ~OperatorServer();
    OperatorServer(const OperatorServer&) = delete;
    OperatorServer& operator=(const OperatorServer&) = delete;

    /// On the session's thread. Neither waits nor allocates.
    void push(const ViewNews& news) noexcept {
        if (!news_.try_push(news))
            dropped_.fetch_add(1, std::memory_order_relaxed);
    }
    /// On the thread that reads the tracker, or on the session's; on one of them only while a trial runs.
    /// Neither waits nor allocates; with a view open the server's thread is woken.
    void push_gaze(const GazeNews& gaze) noexcept;
    /// On the session's thread while the tracker is set up: the views get up to ten images a second.
    void show_camera(const CameraImage& image);
    bool next_command(OperatorCommand& into) noexcept { return commands_.try_pop(into); }

    const std::filesystem::path& socket() const { return options_.socket; }
    std::int64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

  private:
    struct View;
    void serve(const std::stop_token& stop);
    void take_news();
    void take_gaze();
    void take_camera();
    void wait_for_views();
    void accept_view();
    void receive(View& view);
    void understand(View& view, std::string_view line);
    void cut_off(View& view, const std::string& why) const;
    void tell_state(bool even_if_old);
    void send_waiting(View& view);

    Options options_;
    int listener_ = -1;
    dev_t device_ = 0; ///< with the inode, of the socket's file
    ino_t inode_ = 0;
    int woken_ = -1; ///< an event counter
    SpscRing<ViewNews> news_;
    SpscRing<GazeNews> gaze_{4096};
    std::mutex camera_lock_;
    std::optional<ViewedCamera> camera_; ///< not yet taken
    SpscRing<OperatorCommand> commands_{64};
    std::atomic<std::int64_t> dropped_{0};
    std::atomic<bool> is_watched_{false};
    // Of the thread.
    ViewBuilder builder_;
    std::vector<View> views_;
    std::deque<std::string> recent_; ///< lines of events, for a view that comes later
    bool is_new_ = true, is_other_trial_ = false;
    std::chrono::steady_clock::time_point camera_told_{};
    std::jthread thread_;
};

} // namespace overt
