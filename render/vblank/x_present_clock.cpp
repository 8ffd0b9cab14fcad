// The Present extension, version 1.0 of its protocol: a client asks to be told when the count of a window's
// screen (MSC) reaches a value, and gets that count with its time (UST, in microseconds). Who listens to a
// window is told of pictures of others, too: so the swaps of the driver are seen through a connection of our
// own.
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>
#include <poll.h>
#include <xcb/present.h>

#include "experiment/base/error.h"
#include "render/vblank/vblank_sources.h"

namespace overt {
namespace {

/// Serials of ours, far from those of drivers, which count from 1.
constexpr std::uint32_t first_serial = 0x6f760000;

/// After so many swaps of which nothing was seen, the driver does not show them through Present.
constexpr int swaps_to_look_at = 8;

struct Connection {
    xcb_connection_t* link;
    explicit Connection(const char* server) : link(xcb_connect(server, nullptr)) {}
    ~Connection() { xcb_disconnect(link); }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;
};

class XPresentClock final : public VblankClock {
  public:
    XPresentClock(const std::string& server, std::uint32_t window, const Clock& clock)
        : connection_(server.c_str()), clock_(&clock), time_(clock), window_(window) {
        xcb_connection_t* const link = connection_.link;
        if (xcb_connection_has_error(link))
            throw GraphicsError("the X server takes no second connection");
        const xcb_query_extension_reply_t* const extension = xcb_get_extension_data(link, &xcb_present_id);
        if (!extension || !extension->present)
            throw GraphicsError("the X server does not offer it");
        std::free(xcb_present_query_version_reply(link, xcb_present_query_version(link, 1, 0), nullptr));
        const std::uint32_t listener = xcb_generate_id(link);
        events_ = xcb_register_for_special_xge(link, &xcb_present_id, listener, nullptr);
        xcb_generic_error_t* const error =
            xcb_request_check(link, xcb_present_select_input_checked(link, listener, window,
                                                                     XCB_PRESENT_EVENT_MASK_COMPLETE_NOTIFY));
        if (error) {
            const int code = error->error_code;
            std::free(error);
            xcb_unregister_for_special_event(link, events_);
            throw GraphicsError(fmt::format("the X server refuses it for the window, with error {}", code));
        }
    }
    ~XPresentClock() override { xcb_unregister_for_special_event(connection_.link, events_); }

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
        xcb_present_notify_msc(connection_.link, window_, serial, count, 0, 0);
        if (xcb_flush(connection_.link) <= 0)
            return std::nullopt;
        read_until([this] { return answer_.has_value(); });
        return answer_;
    }

    template <class Done> void read_until(Done done) noexcept {
        const SessionTime end = clock_->now() + patience;
        for (;;) {
            while (xcb_generic_event_t* const event = xcb_poll_for_special_event(connection_.link, events_)) {
                take(*event);
                std::free(event);
            }
            const SessionDuration left = end - clock_->now();
            if (done() || left <= SessionDuration::zero() || xcb_connection_has_error(connection_.link))
                return;
            pollfd wait{xcb_get_file_descriptor(connection_.link), POLLIN, 0};
            ::poll(&wait, 1, 1 + static_cast<int>(left / std::chrono::milliseconds(1)));
        }
    }

    void take(const xcb_generic_event_t& event) noexcept {
        xcb_present_complete_notify_event_t complete;
        std::memcpy(&complete, &event, sizeof complete);
        if (complete.event_type != XCB_PRESENT_EVENT_COMPLETE_NOTIFY)
            return;
        const VblankStamp stamp{static_cast<std::int64_t>(complete.msc),
                                time_.of_microseconds(static_cast<std::int64_t>(complete.ust))};
        if (complete.kind == XCB_PRESENT_COMPLETE_KIND_NOTIFY_MSC) {
            if (complete.serial == serial_)
                answer_ = stamp;
        } else if (complete.mode != XCB_PRESENT_COMPLETE_MODE_SKIP) {
            swap_seen_ = stamp;
        }
    }

    Connection connection_;
    const Clock* clock_;
    MonotonicTime time_;
    std::uint32_t window_;
    xcb_special_event_t* events_ = nullptr;
    std::uint32_t serial_ = first_serial;
    std::optional<VblankStamp> answer_, swap_seen_;
    bool sees_swaps_ = false;
    int swaps_looked_at_ = 0;
};

} // namespace

std::unique_ptr<VblankClock> open_x_present(const NativeWindow& window, const Clock& clock) {
    if (window.x11_server.empty() || window.x11_window == 0)
        throw GraphicsError("the window is not one of X11");
    return std::make_unique<XPresentClock>(window.x11_server, window.x11_window, clock);
}

} // namespace overt
