// The Present extension, version 1.0 of its protocol: a client asks to be told when the count of a window's
// screen (MSC) reaches a value, and gets that count with its time (UST, in microseconds).
#include <poll.h>

#include "render/vblank/present_listener.h"
#include "render/vblank/vblank_sources.h"

namespace overt {
namespace {

/// Serials of ours, far from those of drivers, which count from 1.
constexpr std::uint32_t first_serial = 0x6f760000;

/// After so many swaps of which nothing was seen, the driver does not show them through Present.
constexpr int swaps_to_look_at = 8;

class XPresentClock final : public VblankClock {
  public:
    XPresentClock(const NativeWindow& window, const Clock& clock)
        : listener_(window), clock_(&clock), time_(clock), window_(window.x11_window) {}

    VblankSource source() const noexcept override {
        return sees_swaps_ ? VblankSource::present_swap : VblankSource::present_count;
    }

    std::optional<VblankStamp> last() noexcept override {
        const std::optional<VblankStamp> stamp = ask(0);
        swap_seen_.reset(); // whatever was lit before is not the next swap
        return stamp;
    }

    std::optional<VblankStamp> await(std::int64_t count) noexcept override {
        return ask(static_cast<std::uint64_t>(count));
    }

    std::optional<VblankStamp> after_swap(const VblankStamp& before) noexcept override {
        if (sees_swaps_) {
            read_until([this] { return swap_seen_.has_value(); });
            return swap_seen_;
        }
        const std::optional<VblankStamp> next = await(before.count + 1);
        if (swaps_looked_at_ < swaps_to_look_at) {
            ++swaps_looked_at_;
            sees_swaps_ = swap_seen_.has_value();
        }
        return sees_swaps_ ? swap_seen_ : next;
    }

  private:
    /// A count that has gone by already is answered at once, with the present one.
    std::optional<VblankStamp> ask(std::uint64_t count) noexcept {
        const std::uint32_t serial = ++serial_;
        answer_.reset();
        xcb_present_notify_msc(listener_.link(), window_, serial, count, 0, 0);
        if (xcb_flush(listener_.link()) <= 0)
            return std::nullopt;
        read_until([this] { return answer_.has_value(); });
        return answer_;
    }

    template <class Done> void read_until(Done done) noexcept {
        const SessionTime end = clock_->now() + patience;
        for (;;) {
            for (xcb_present_complete_notify_event_t completion; listener_.next(completion);)
                take(completion);
            const SessionDuration left = end - clock_->now();
            if (done() || left <= SessionDuration::zero() || xcb_connection_has_error(listener_.link()))
                return;
            pollfd wait{xcb_get_file_descriptor(listener_.link()), POLLIN, 0};
            ::poll(&wait, 1, 1 + static_cast<int>(left / std::chrono::milliseconds(1)));
        }
    }

    void take(const xcb_present_complete_notify_event_t& complete) noexcept {
        const VblankStamp stamp{static_cast<std::int64_t>(complete.msc),
                                time_.of_microseconds(static_cast<std::int64_t>(complete.ust))};
        if (complete.kind == XCB_PRESENT_COMPLETE_KIND_NOTIFY_MSC) {
            if (complete.serial == serial_)
                answer_ = stamp;
        } else if (complete.mode != XCB_PRESENT_COMPLETE_MODE_SKIP) {
            swap_seen_ = stamp;
        }
    }

    PresentListener listener_;
    const Clock* clock_;
    MonotonicTime time_;
    std::uint32_t window_;
    std::uint32_t serial_ = first_serial;
    std::optional<VblankStamp> answer_, swap_seen_;
    bool sees_swaps_ = false;
    int swaps_looked_at_ = 0;
};

} // namespace

std::unique_ptr<VblankClock> open_x_present(const NativeWindow& window, const Clock& clock) {
    return std::make_unique<XPresentClock>(window, clock);
}

} // namespace overt
