#include "devices/pupil/zmq_socket.h"

#include <algorithm>
#include <cerrno>

#include <fmt/format.h>
#include <zmq.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

constexpr int kind_numbers[] = {ZMQ_REQ, ZMQ_SUB, ZMQ_PUB};

/// Some seconds of everything that is subscribed to.
constexpr int queued_messages = 10'000;

template <class Value> void set(void* socket, int option, Value value) {
    static_cast<void>(zmq_setsockopt(socket, option, &value, sizeof value));
}

} // namespace

ZmqContext::ZmqContext() : handle_(zmq_ctx_new()) { OVERT_EXPECTS(handle_); }
ZmqContext::~ZmqContext() { zmq_ctx_term(handle_); }

ZmqSocket::ZmqSocket(const ZmqContext& context, Kind kind, const std::string& endpoint, const Clock& clock)
    : handle_(zmq_socket(context.handle(), kind_numbers[static_cast<int>(kind)])), clock_(clock) {
    if (!handle_)
        throw DeviceError(fmt::format("{} cannot be connected: {}.", endpoint, zmq_strerror(errno)));
    set(handle_, ZMQ_LINGER, 0);
    set(handle_, ZMQ_RCVHWM, queued_messages);
    set(handle_, ZMQ_MAXMSGSIZE, longest_frame);
    if (zmq_connect(handle_, endpoint.c_str()) != 0) {
        const std::string why = zmq_strerror(errno);
        zmq_close(handle_);
        throw DeviceError(fmt::format("{} cannot be connected: {}; name a host and a port.", endpoint, why));
    }
}

ZmqSocket::~ZmqSocket() { zmq_close(handle_); }

void ZmqSocket::subscribe(const std::string& prefix) noexcept {
    static_cast<void>(zmq_setsockopt(handle_, ZMQ_SUBSCRIBE, prefix.data(), prefix.size()));
}
void ZmqSocket::unsubscribe(const std::string& prefix) noexcept {
    static_cast<void>(zmq_setsockopt(handle_, ZMQ_UNSUBSCRIBE, prefix.data(), prefix.size()));
}

bool ZmqSocket::wait_for(short events, SessionTime deadline) noexcept {
    for (;;) {
        // Whole milliseconds are what ZeroMQ counts in; the last part of one is waited for in full.
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(std::clamp(
            deadline - clock_.now(), SessionDuration::zero(), SessionDuration(std::chrono::hours(1))));
        zmq_pollitem_t item{.socket = handle_, .fd = {}, .events = events, .revents = {}};
        const int ready = zmq_poll(&item, 1, static_cast<long>(left.count()));
        if (ready != -1 || errno != EINTR)
            return ready > 0;
    }
}

bool ZmqSocket::send(std::span<const std::string_view> frames, SessionTime deadline) noexcept {
    if (!wait_for(ZMQ_POLLOUT, deadline))
        return false;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const int flags = ZMQ_DONTWAIT | (i + 1 < frames.size() ? ZMQ_SNDMORE : 0);
        if (zmq_send(handle_, frames[i].data(), frames[i].size(), flags) == -1)
            return false;
    }
    return true;
}

bool ZmqSocket::receive(std::vector<std::string>& frames, SessionTime deadline) noexcept {
    if (!wait_for(ZMQ_POLLIN, deadline))
        return false;
    std::size_t count = 0;
    for (bool more = true; more;) {
        zmq_msg_t frame;
        zmq_msg_init(&frame);
        if (zmq_msg_recv(&frame, handle_, ZMQ_DONTWAIT) == -1) {
            zmq_msg_close(&frame);
            return false;
        }
        if (count < most_frames) {
            if (frames.size() <= count)
                frames.emplace_back();
            frames[count++].assign(static_cast<const char*>(zmq_msg_data(&frame)), zmq_msg_size(&frame));
        }
        more = zmq_msg_more(&frame) != 0;
        zmq_msg_close(&frame);
    }
    frames.resize(count);
    return true;
}

} // namespace overt
