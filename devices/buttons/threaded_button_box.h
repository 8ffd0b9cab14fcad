/// Reads a response box, on a thread of its own where that can be, and looks for it again when it is gone.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "experiment/base/spsc_ring.h"
#include "experiment/ports/button_box.h"
#include "experiment/ports/clock.h"

namespace overt {

/// What became of a box.
struct BoxNews {
    SessionTime at;
    bool is_lost = false; ///< else it was found again
    std::string words;
};

/// All but the thread's own work is the session's thread's. A box that is lost stays so until it is found
/// again; what was pressed meanwhile is not known.
class ThreadedButtonBox {
  public:
    enum class ReadOn : std::uint8_t {
        own_thread,
        /// For a box that shares its line with what else the session asks there: its poll() is called within
        /// this poll(). It is not looked for again.
        sessions_thread
    };
    /// Finds and opens the box. Throws DeviceError.
    using Opener = std::function<std::unique_ptr<ButtonBox>()>;

    /// Opens the box at once. `clock` must go by itself and outlive this. Throws DeviceError.
    ThreadedButtonBox(Opener open, Clock& clock, ReadOn read_on = ReadOn::own_thread,
                      SessionDuration look_again_after = std::chrono::seconds(2));
    ~ThreadedButtonBox();
    ThreadedButtonBox(const ThreadedButtonBox&) = delete;
    ThreadedButtonBox& operator=(const ThreadedButtonBox&) = delete;

    /// Of the box as it was found last.
    const ButtonBoxDescription& description() const noexcept { return description_; }
    /// Waits for the thread for a millisecond at most, while the box is there.
    std::string button_name(int button) const;

    /// Both clocks are read, see ButtonBox::begin(): soon, or by a box on the session's thread now. Changes
    /// that come meanwhile are forgotten.
    void begin() noexcept;

    /// The next change. Allocates and waits for nothing.
    bool poll(ButtonChange& into) noexcept;

    bool lost() const noexcept { return is_lost_; }
    bool has_news() const noexcept { return has_news_; }
    std::vector<BoxNews> take_news();
    /// Changes for which there was no room.
    std::int64_t forgotten() const noexcept { return forgotten_; }

  private:
    void serve(const std::stop_token& stop) noexcept;
    void read() noexcept;
    void begin_now() noexcept;
    void tell(bool is_lost, std::string words) noexcept;
    void look_for_it(const std::stop_token& stop) noexcept;

    Opener open_;
    Clock& clock_;
    SessionDuration look_again_after_;
    std::unique_ptr<ButtonBox> box_;
    ButtonBoxDescription description_;
    mutable std::mutex box_mutex_, news_mutex_;
    std::vector<BoxNews> news_;
    std::optional<SessionTime> lost_at_; ///< on the session's thread, and not told yet
    SpscRing<ButtonChange> changes_{1024};
    std::atomic<bool> begins_{false}, is_lost_{false}, has_news_{false};
    std::atomic<std::int64_t> forgotten_{0};
    std::jthread thread_;
};

} // namespace overt
