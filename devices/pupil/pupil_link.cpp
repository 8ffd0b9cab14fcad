#include "devices/pupil/pupil_link.h"

#include <array>

#include <fmt/format.h>

#include "devices/link/byte_transport.h"
#include "devices/link/text_line.h"
#include "devices/tracker/tracker_seconds.h"
#include "experiment/base/error.h"
#include "experiment/base/text_number.h"

namespace overt {
namespace {

std::string endpoint_of(const NetworkAddress& address) { return fmt::format("tcp://{}", describe(address)); }

} // namespace

PupilLink::PupilLink(const NetworkAddress& remote, const Clock& clock, SessionDuration patience)
    : name_(describe(remote)), endpoint_(endpoint_of(remote)), clock_(clock) {
    open_questions();
    const auto open = [&](ZmqSocket::Kind kind, std::string_view command) {
        const NetworkAddress there{remote.host, static_cast<std::uint16_t>(port_of(command, patience))};
        return std::make_unique<ZmqSocket>(context_, kind, endpoint_of(there), clock_);
    };
    published_ = open(ZmqSocket::Kind::subscribe, "SUB_PORT");
    publisher_ = open(ZmqSocket::Kind::publish, "PUB_PORT");
}

void PupilLink::open_questions() {
    questions_ = std::make_unique<ZmqSocket>(context_, ZmqSocket::Kind::request, endpoint_, clock_);
}

int PupilLink::port_of(std::string_view command, SessionDuration patience) {
    const std::optional<std::string> answer = ask(command, clock_.now() + patience);
    if (!answer)
        throw DeviceError(
            fmt::format("Pupil Capture does not answer at {}; start it, see that its plugin Pupil "
                        "Remote is on, and name the address that it shows.",
                        name_));
    const auto port = number_in<int>(*answer);
    if (!port || *port <= 0 || *port > 65535)
        throw DeviceError(
            fmt::format("What answers at {} is not Pupil Remote: to {} it says \"{}\"; name the "
                        "address that Pupil Capture shows.",
                        name_, command, printable(*answer, 40)));
    return *port;
}

std::optional<std::string> PupilLink::await_answer(SessionTime deadline) noexcept {
    if (questions_->receive(frames_, deadline) && !frames_.empty())
        return frames_.front();
    // A question without an answer blocks its socket for good.
    open_questions();
    return std::nullopt;
}

std::optional<std::string> PupilLink::ask(std::string_view command, SessionTime deadline) noexcept {
    if (!questions_->send({&command, 1}, deadline))
        return std::nullopt;
    return await_answer(deadline);
}

bool PupilLink::notify(std::string_view subject, std::string_view content, SessionTime deadline) noexcept {
    const std::string topic = fmt::format("notify.{}", subject);
    const std::array<std::string_view, 2> frames{topic, content};
    return questions_->send(frames, deadline) && await_answer(deadline).has_value();
}

std::optional<ClockPair> PupilLink::read_clocks(SessionTime deadline) noexcept {
    ClockPair pair;
    pair.before = clock_.now();
    const std::optional<std::string> answer = ask("t", deadline);
    pair.after = clock_.now();
    const std::optional<double> time_s = answer ? decimal_number(*answer) : std::nullopt;
    const std::optional<TrackerTime> time = time_s ? tracker_time_of_seconds(*time_s) : std::nullopt;
    if (!time)
        return std::nullopt;
    pair.other = *time;
    return pair;
}

bool PupilLink::receive(PupilMessage& message, SessionTime deadline) noexcept {
    if (!published_->receive(frames_, deadline) || frames_.size() < 2)
        return false;
    message = {frames_[0], frames_[1]};
    return true;
}

void PupilLink::publish(std::string_view topic, std::string_view content, SessionTime deadline) noexcept {
    const std::array<std::string_view, 2> frames{topic, content};
    publisher_->send(frames, deadline);
}

} // namespace overt
