/// Sockets of ZeroMQ, with deadlines. Those of one program share a context, which has a thread of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/ports/clock.h"

namespace overt {

class ZmqContext {
  public:
    ZmqContext();
    ~ZmqContext();
    ZmqContext(const ZmqContext&) = delete;
    ZmqContext& operator=(const ZmqContext&) = delete;
    void* handle() const noexcept { return handle_; }

  private:
    void* handle_;
};

/// One thread at a time. Connects in the background, and again by itself whenever the other end was gone:
/// that nobody is there shows by silence only.
class ZmqSocket {
  public:
    enum class Kind : std::uint8_t { request, subscribe, publish };
    /// Frames beyond this are dropped by ZeroMQ with their connection: no message that a session takes part
    /// in comes near.
    static constexpr std::int64_t longest_frame = std::int64_t{4} << 20;

    /// `endpoint` such as "tcp://127.0.0.1:50020". Throws DeviceError if it is none. The context and the
    /// clock must outlive the socket.
    ZmqSocket(const ZmqContext& context, Kind kind, const std::string& endpoint, const Clock& clock);
    ~ZmqSocket();
    ZmqSocket(const ZmqSocket&) = delete;
    ZmqSocket& operator=(const ZmqSocket&) = delete;

    /// Messages whose first frame begins so, from a moment after this on.
    void subscribe(const std::string& prefix) noexcept;
    void unsubscribe(const std::string& prefix) noexcept;

    /// All frames or none. False if they could not be handed over by the deadline.
    bool send(std::span<const std::string_view> frames, SessionTime deadline) noexcept;

    /// The next message. False if none came by the deadline; one that is past means: do not wait. The strings
    /// keep their memory from one message to the next. Frames beyond `most_frames` are dropped.
    bool receive(std::vector<std::string>& frames, SessionTime deadline) noexcept;
    static constexpr std::size_t most_frames = 16;

  private:
    bool wait_for(short events, SessionTime deadline) noexcept;

    void* handle_;
    const Clock& clock_;
};

} // namespace overt
