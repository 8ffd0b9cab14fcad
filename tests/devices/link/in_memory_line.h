/// Lines to devices that are made of memory and virtual time: what is written is answered at once by a
/// function, and the answer arrives after a delay, cut into pieces at will.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <string>

#include "devices/host/clocks.h"
#include "devices/link/byte_transport.h"
#include "tests/devices/display_box/bits_box_model.h"

namespace overt::test {

using namespace std::chrono_literals;

/// The far end of a line. Lives as long as the test, while the transport belongs to what is tested.
struct FarEnd {
    explicit FarEnd(VirtualClock& session_clock) : clock(session_clock) {}

    VirtualClock& clock;
    std::string port = "/dev/ttyACM0";
    SessionDuration delay = 2ms;
    bool unplugged = false, takes_bytes = true;
    std::function<std::string(std::string_view)> answer; ///< to bytes written
    std::function<std::size_t()> piece; ///< length of the next piece that a read gives; empty: all
    std::function<void(SessionTime)>
        before_read; ///< until when a read may wait: the time to put more into `arriving`

    struct Arrival {
        SessionTime at;
        std::string bytes;
    };
    std::deque<Arrival> arriving; ///< by time

    void send(SessionTime at, std::string bytes) {
        if (bytes.empty())
            return;
        const auto later = std::ranges::upper_bound(arriving, at, {}, &Arrival::at);
        arriving.insert(later, {at, std::move(bytes)});
    }
};

class InMemoryLine final : public ByteTransport {
  public:
    explicit InMemoryLine(FarEnd& far_end) : far_(far_end) {}

    const std::string& name() const noexcept override { return far_.port; }

    bool write(std::string_view bytes, SessionTime deadline) noexcept override {
        if (far_.unplugged)
            return false;
        if (!far_.takes_bytes) {
            far_.clock.wait_until(deadline);
            return false;
        }
        if (far_.answer)
            far_.send(far_.clock.now() + far_.delay, far_.answer(bytes));
        return true;
    }

    std::size_t read(std::span<char> into, SessionTime deadline) noexcept override {
        far_.clock.wait_until(far_.clock.now() + 5us); // no read is free, or a chatty device could stop time
        if (far_.before_read)
            far_.before_read(std::max(deadline, far_.clock.now()));
        if (far_.unplugged || into.empty())
            return 0;
        if (far_.arriving.empty() || far_.arriving.front().at > std::max(deadline, far_.clock.now())) {
            far_.clock.wait_until(deadline);
            return 0;
        }
        far_.clock.wait_until(far_.arriving.front().at);
        std::size_t room = into.size();
        if (far_.piece)
            room = std::clamp<std::size_t>(far_.piece(), 1, room);
        std::size_t count = 0;
        while (count < room && !far_.arriving.empty() && far_.arriving.front().at <= far_.clock.now()) {
            std::string& bytes = far_.arriving.front().bytes;
            const std::size_t part = std::min(room - count, bytes.size());
            std::copy_n(bytes.begin(), part, into.begin() + static_cast<std::ptrdiff_t>(count));
            bytes.erase(0, part);
            count += part;
            if (bytes.empty())
                far_.arriving.pop_front();
        }
        return count;
    }

    bool lost() const noexcept override { return far_.unplugged; }
    std::string loss() const override { return far_.unplugged ? "unplugged by the test" : ""; }

  private:
    FarEnd& far_;
};

/// A Display++ in memory, with a clock of its own and a status stream.
class InMemoryBitsBox {
  public:
    explicit InMemoryBitsBox(VirtualClock& clock) : far(clock), clock_(clock) {
        far.answer = [this](std::string_view bytes) {
            const bool streamed = model.streaming;
            std::string reply = model.receive(bytes, to_seconds(clock_.now()));
            if (!streamed && model.streaming)
                next_sample_at_ = clock_.now() + far.delay / 2;
            return mutate ? mutate(std::move(reply)) : reply;
        };
        far.before_read = [this](SessionTime until) { stream_until(until); };
    }

    BitsBoxModel model;
    FarEnd far;
    SessionTime clock_zero; ///< when the box's clock showed 0
    double drift_ppm = 0.0; ///< a second of the box's clock lasts this much longer
    SessionDuration sample_period = 714us;
    std::function<std::string(std::string)> mutate; ///< what becomes of a reply on its way

    std::unique_ptr<ByteTransport> line() { return std::make_unique<InMemoryLine>(far); }

    double box_s(SessionTime at) const { return to_seconds(at - clock_zero) / (1.0 + 1e-6 * drift_ppm); }

    /// A stream that ran before anybody came.
    void stream_from_now() {
        model.streaming = true;
        next_sample_at_ = clock_.now();
    }

  private:
    void stream_until(SessionTime until) {
        // A box makes its lines as time goes by; not all those of a long wait at once.
        const SessionTime last = std::min(until, clock_.now() + 20ms);
        while (model.streaming && next_sample_at_ <= last) {
            std::string line = model.status_line(box_s(next_sample_at_));
            far.send(next_sample_at_ + far.delay / 2, mutate ? mutate(std::move(line)) : std::move(line));
            next_sample_at_ += sample_period;
        }
    }

    VirtualClock& clock_;
    SessionTime next_sample_at_;
};

} // namespace overt::test
