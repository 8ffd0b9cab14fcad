#include "devices/opengaze/opengaze_link.h"

#include <utility>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

/// Two hundred points of a calibration: what goes beyond is not of a calibration.
constexpr std::size_t most_calibration_messages = 400;

std::string opengaze_set(std::string_view id, std::string_view values) {
    return fmt::format("<SET ID=\"{}\"{}{} />\r\n", id, values.empty() ? "" : " ", values);
}

} // namespace

OpenGazeLink::OpenGazeLink(std::unique_ptr<ByteTransport> line, const Clock& clock, OpenGazeTimeouts timeouts)
    : line_(std::move(line)), clock_(clock), timeouts_(timeouts), incoming_() {}

std::optional<OpenGazeAnswer> OpenGazeLink::get(std::string_view id) {
    return ask(id, fmt::format("<GET ID=\"{}\" />\r\n", id));
}

std::optional<OpenGazeAnswer> OpenGazeLink::set(std::string_view id, std::string_view values) {
    return ask(id, opengaze_set(id, values));
}

bool OpenGazeLink::send_set(std::string_view id, std::string_view values, SessionTime deadline) noexcept {
    return line_->write(opengaze_set(id, values), deadline);
}

std::optional<OpenGazeAnswer> OpenGazeLink::ask(std::string_view id, const std::string& request) {
    std::optional<OpenGazeAnswer> answer;
    // Answers are matched by their id alone: servers do not repeat the values reliably.
    const auto take = [&](const OpenGazeMessage& message) {
        const bool is_answer = message.kind == OpenGazeMessage::Kind::acknowledged ||
                               message.kind == OpenGazeMessage::Kind::refused;
        if (is_answer && !answer && message.value("ID") == id)
            answer = OpenGazeAnswer{message.kind == OpenGazeMessage::Kind::acknowledged,
                                    std::string(message.attributes)};
        keep_calibration(message);
    };
    for (int attempt = 0; attempt < timeouts_.attempts && !answer; ++attempt) {
        const SessionTime deadline = clock_.now() + timeouts_.reply;
        line_->write(request, deadline);
        while (!answer && !line_->lost() && clock_.now() < deadline)
            pump(deadline, take, [] {});
        if (!answer && line_->lost())
            throw DeviceError(fmt::format("The eye tracker's server at {} is lost: {}; start it again and "
                                          "connect anew.",
                                          name(), loss()));
    }
    return answer;
}

void OpenGazeLink::keep_calibration(const OpenGazeMessage& message) {
    if (message.kind == OpenGazeMessage::Kind::calibration && calibration_.size() < most_calibration_messages)
        calibration_.push_back({true, std::string(message.attributes)});
}

std::optional<OpenGazeAnswer> OpenGazeLink::next_calibration_message(SessionTime deadline) {
    if (calibration_.empty())
        pump(
            deadline, [this](const OpenGazeMessage& message) { keep_calibration(message); }, [] {});
    if (calibration_.empty())
        return std::nullopt;
    OpenGazeAnswer first = std::move(calibration_.front());
    calibration_.pop_front();
    return first;
}

void OpenGazeLink::forget() {
    splitter_.forget();
    calibration_.clear();
}

} // namespace overt
