/// A conversation with an Open Gaze server: questions with their answers, and what the server says unasked.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "devices/link/byte_transport.h"
#include "devices/link/text_line.h"
#include "devices/opengaze/opengaze_message.h"
#include "experiment/ports/clock.h"

namespace overt {

/// How long to wait for what. PyGaze asks again after 3 s and gives up after 9 s.
struct OpenGazeTimeouts {
    SessionDuration connect = std::chrono::seconds(5);
    SessionDuration reply = std::chrono::seconds(3);
    int attempts = 3;
    /// Of a recording in which no record comes: the tracker is lost.
    SessionDuration silence = std::chrono::seconds(2);
};

/// An element of the server with memory of its own.
struct OpenGazeAnswer {
    bool is_granted = false; ///< acknowledged, and not refused
    std::string attributes;
    OpenGazeMessage message() const { return {OpenGazeMessage::Kind::other, attributes}; }
};

/// Owns the line. One thread at a time.
class OpenGazeLink {
  public:
    /// Longer than a calibration's result with 25 points.
    static constexpr std::size_t longest_line = std::size_t{1} << 14;

    /// `clock` must outlive the link.
    OpenGazeLink(std::unique_ptr<ByteTransport> line, const Clock& clock, OpenGazeTimeouts timeouts);

    const std::string& name() const noexcept { return line_->name(); }
    bool lost() const noexcept { return line_->lost(); }
    std::string loss() const { return line_->loss(); }

    /// Asks for the values of an id: <GET ID="…" />. Nothing if the server is silent however often it is
    /// asked. Throws DeviceError if the line is lost.
    std::optional<OpenGazeAnswer> get(std::string_view id);
    /// Sets values, such as STATE="1"; else as get().
    std::optional<OpenGazeAnswer> set(std::string_view id, std::string_view values);

    /// Sends a SET whose answer is not waited for. False if the line did not take it by the deadline.
    bool send_set(std::string_view id, std::string_view values, SessionTime deadline) noexcept;

    /// Takes what arrives by the deadline and returns soon after something did. Calls on_message(message) for
    /// each element and on_noise() for each line that is none.
    template <class OnMessage, class OnNoise>
    void pump(SessionTime deadline, OnMessage&& on_message, OnNoise&& on_noise) noexcept;

    /// What a calibration said while answers were waited for, and since; the oldest first.
    std::optional<OpenGazeAnswer> next_calibration_message(SessionTime deadline);

    /// Forgets a line of which the end has not come, and what a calibration said.
    void forget();

  private:
    std::optional<OpenGazeAnswer> ask(std::string_view id, const std::string& request);
    void keep_calibration(const OpenGazeMessage& message);

    std::unique_ptr<ByteTransport> line_;
    const Clock& clock_;
    OpenGazeTimeouts timeouts_;
    LineSplitter splitter_{longest_line};
    std::array<char, 4096> incoming_;
    std::deque<OpenGazeAnswer> calibration_;
};

template <class OnMessage, class OnNoise>
void OpenGazeLink::pump(SessionTime deadline, OnMessage&& on_message, OnNoise&& on_noise) noexcept {
    const std::size_t count = line_->read(incoming_, deadline);
    splitter_.feed({incoming_.data(), count}, [&](std::string_view line) {
        if (const std::optional<OpenGazeMessage> message = parse_opengaze(line))
            on_message(*message);
        else
            on_noise();
    });
}

} // namespace overt
