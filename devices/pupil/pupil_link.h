/// The way to Pupil Capture: questions to Pupil Remote, what it publishes, and what is published to it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "devices/link/tcp_line.h"
#include "devices/pupil/zmq_socket.h"
#include "experiment/clock_pair.h"

namespace overt {

/// A message that was published; valid until the next is received.
struct PupilMessage {
    std::string_view topic, content;
};

/// One thread at a time.
class PupilLink {
  public:
    /// Finds the ports by asking Pupil Remote, the plugin of Pupil Capture that answers questions. Throws
    /// DeviceError if nobody answers within `patience`, or not as Pupil Remote does. `clock` must outlive it.
    PupilLink(const NetworkAddress& remote, const Clock& clock, SessionDuration patience);

    const std::string& name() const noexcept { return name_; }

    /// What Pupil Remote answers to a command, such as "v"; nothing if it does not by the deadline.
    std::optional<std::string> ask(std::string_view command, SessionTime deadline) noexcept;

    /// Tells all plugins something: `content` is a map in MessagePack with the key "subject".
    bool notify(std::string_view subject, std::string_view content, SessionTime deadline) noexcept;

    /// Pupil Capture's clock, read between two readings of ours.
    std::optional<ClockPair> read_clocks(SessionTime deadline) noexcept;

    void subscribe(const std::string& topic) noexcept { published_->subscribe(topic); }
    void unsubscribe(const std::string& topic) noexcept { published_->unsubscribe(topic); }
    /// The next message that was published. False if none came by the deadline.
    bool receive(PupilMessage& message, SessionTime deadline) noexcept;
    void publish(std::string_view topic, std::string_view content, SessionTime deadline) noexcept;

  private:
    void open_questions();
    int port_of(std::string_view command, SessionDuration patience);
    std::optional<std::string> await_answer(SessionTime deadline) noexcept;

    std::string name_, endpoint_;
    const Clock& clock_;
    ZmqContext context_;
    std::unique_ptr<ZmqSocket> questions_, published_, publisher_;
    std::vector<std::string> frames_;
};

} // namespace overt
