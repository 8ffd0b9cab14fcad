/// A Display++ at the end of a virtual screen's cable and of a pseudo-terminal: it answers as a box does,
/// gives back the video it really receives, and its clock restarts when a clock reset line is on the screen.
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "render/signal/signal_decoder.h"
#include "tests/devices/display_box/bits_box_model.h"
#include "tests/devices/link/terminal_device.h"
#include "tests/support/seen_screen.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/virtual_screen.h"

namespace overt::test {

class ScreenBox {
  public:
    /// A screen of this size with a box behind it.
    static std::unique_ptr<ScreenBox> start(int width, int height, double rate_hz) {
        auto folder = std::make_unique<TemporaryFolder>();
        auto screen = VirtualScreen::start(width, height, 24, folder->path().string());
        return std::unique_ptr<ScreenBox>(new ScreenBox(std::move(folder), std::move(screen), rate_hz));
    }

    const std::string& port() const { return terminal_.path(); }

    std::string mode() const {
        const std::lock_guard lock(mutex_);
        return model_.mode;
    }
    std::string gamma_table() const {
        const std::lock_guard lock(mutex_);
        return model_.gamma_table;
    }
    std::vector<std::string> commands() const {
        const std::lock_guard lock(mutex_);
        return model_.commands;
    }
    bool was_told(const std::string& command) const {
        const auto all = commands();
        return std::ranges::find(all, command) != all.end();
    }
    int clock_resets() const { return clock_resets_; }

    /// As switching it off and on does.
    void restart() {
        const std::lock_guard lock(mutex_);
        model_.mode = "BitsPlusPlus";
        zero_s_ = now_s_;
    }

    /// What becomes of the picture between the graphics card's memory and the box.
    void distort(std::function<RgbBytes(const SeenScreen&, int x, int y)> cable) {
        const std::lock_guard lock(mutex_);
        cable_ = std::move(cable);
    }

  private:
    ScreenBox(std::unique_ptr<TemporaryFolder> folder, std::unique_ptr<VirtualScreen> screen, double rate_hz)
        : folder_(std::move(folder)), screen_(std::move(screen)), seen_(folder_->path()) {
        model_.rate_hz = rate_hz;
        model_.mode_change_s = 0.1;
        model_.video = [this](int line, int pixel) { return cable_(seen_, pixel, line - 1); };
        device_ = std::make_unique<TerminalDevice>(
            terminal_.master(),
            [this](std::string_view bytes, double now_s) {
                const std::lock_guard lock(mutex_);
                return model_.receive(bytes, now_s);
            },
            [this](double now_s) { return tick(now_s); });
    }

    std::string tick(double now_s) {
        const std::lock_guard lock(mutex_);
        now_s_ = now_s;
        if (model_.mode.ends_with("PlusPlus") && shows_clock_reset()) {
            zero_s_ = now_s;
            ++clock_resets_;
        }
        return model_.streaming ? model_.status_line(now_s - zero_s_) : "";
    }

    bool shows_clock_reset() const {
        constexpr int rows = 3, first_of_key = 69;
        if (cable_(seen_, 0, 1)[0] != first_of_key)
            return false;
        const std::vector<std::byte> bytes = seen_.top_rows(rows);
        const ReceivedMessages messages = receive_messages({{seen_.width(), rows}, bytes});
        return std::ranges::any_of(messages.packets,
                                   [](const ReceivedPacket& packet) { return packet.command == 12; });
    }

    std::unique_ptr<TemporaryFolder> folder_;
    std::unique_ptr<VirtualScreen> screen_;
    SeenScreen seen_;
    Terminal terminal_;
    mutable std::mutex mutex_;
    BitsBoxModel model_;
    std::function<RgbBytes(const SeenScreen&, int, int)> cable_ = [](const SeenScreen& seen, int x, int y) {
        return RgbBytes(seen.at(x, y));
    };
    double now_s_ = 0.0, zero_s_ = -1000.0; ///< it has been on for a while
    std::atomic<int> clock_resets_{0};
    std::unique_ptr<TerminalDevice> device_; ///< last: its thread uses all of the above
};

} // namespace overt::test
