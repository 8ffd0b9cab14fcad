/// The side of the operator's view: connects to a session's socket.
#pragma once

#include <chrono>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "experiment/watch/operator_command.h"
#include "experiment/watch/session_view.h"

namespace overt {

/// For one thread.
class OperatorClient {
  public:
    /// Greets, and waits up to five seconds for the session's facts. Throws InputError if nobody serves the
    /// socket or it is another language, and DeviceError if the session does not answer.
    explicit OperatorClient(const std::filesystem::path& socket);
    ~OperatorClient();
    OperatorClient(const OperatorClient&) = delete;
    OperatorClient& operator=(const OperatorClient&) = delete;

    const SessionFacts& facts() const { return facts_; }
    /// The newest state that has come.
    const SessionView& view() const { return view_; }

    /// Takes what has come, waiting so long for it. Gives false once the session is over or gone, and all it
    /// said has been taken.
    bool read(std::chrono::milliseconds wait);
    /// Events since it was asked last, oldest first.
    std::deque<ViewedEvent> take_events() { return std::exchange(events_, {}); }
    /// Gaze since it was asked last; of a view that asks seldom, the newest 4096 points.
    std::deque<ViewedGaze> take_gaze() { return std::exchange(gaze_, {}); }
    /// The newest image of the tracker's camera since it was asked last, if one came.
    std::optional<ViewedCamera> take_camera() { return std::exchange(camera_, std::nullopt); }
    /// How long nothing has come from the session, which speaks twice a second at least.
    std::chrono::milliseconds silence() const;

    /// False if the session is gone.
    bool send(const OperatorCommand& command);

  private:
    void understand(std::string_view line);

    int socket_ = -1;
    bool has_facts_ = false, is_gone_ = false;
    std::string received_;
    SessionFacts facts_;
    SessionView view_;
    std::deque<ViewedEvent> events_;
    std::deque<ViewedGaze> gaze_;
    std::optional<ViewedCamera> camera_;
    std::chrono::steady_clock::time_point heard_;
};

/// Whether a session serves this socket now.
bool is_served(const std::filesystem::path& socket);

} // namespace overt
