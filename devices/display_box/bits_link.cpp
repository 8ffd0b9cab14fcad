#include "devices/display_box/bits_link.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

/// Three seconds of status at the 1400 lines a second that a Bits# was seen to send.
constexpr std::size_t ring_size = 4096;
constexpr std::size_t kept_noise = 256;

} // namespace

BitsLink::BitsLink(std::unique_ptr<ByteTransport> transport, Clock& clock, BitsTimeouts timeouts)
    : transport_(std::move(transport)), clock_(clock), timeouts_(timeouts), incoming_(4096),
      ring_(ring_size) {
    reply_.reserve(longest_bits_line);
    noise_.reserve(2 * kept_noise);
}

void BitsLink::note_noise(std::string_view text) noexcept {
    if (text.size() > kept_noise)
        text.remove_prefix(text.size() - kept_noise);
    if (noise_.size() + text.size() + 1 > 2 * kept_noise)
        noise_.clear();
    if (!noise_.empty())
        noise_ += '\n';
    noise_ += text;
}

void BitsLink::keep(const StatusSample& sample) noexcept {
    if (last_number_ && sample.number > *last_number_)
        lost_samples_ += sample.number - *last_number_ - 1;
    last_number_ = sample.number;
    if (filled_ == ring_.size()) {
        first_ = (first_ + 1) % ring_.size();
        --filled_;
        ++lost_samples_;
    }
    ring_[(first_ + filled_) % ring_.size()] = {sample, clock_.now()};
    ++filled_;
}

void BitsLink::take_line(std::string_view line) noexcept {
    if (!expected_.empty() && !replied_) {
        if (const auto reply = bits_reply(line, expected_)) {
            reply_.assign(*reply);
            replied_ = true;
            return;
        }
    }
    if (const auto sample = parse_status_line(line)) {
        ++stream_lines_;
        keep(*sample);
    } else if (is_touch_line(line)) {
        ++stream_lines_;
    } else {
        note_noise(line);
    }
}

std::size_t BitsLink::pump(SessionTime deadline) noexcept {
    const std::size_t count = transport_->read(incoming_, deadline);
    splitter_.feed({incoming_.data(), count}, [this](std::string_view line) { take_line(line); });
    return count;
}

void BitsLink::drain_until_quiet() {
    const SessionTime give_up = clock_.now() + timeouts_.drain;
    SessionTime deadline = clock_.now() + timeouts_.quiet;
    while (clock_.now() < std::min(deadline, give_up)) {
        if (pump(std::min(deadline, give_up)) > 0)
            deadline = clock_.now() + timeouts_.quiet;
        require_line("$Stop");
    }
    splitter_.forget();
}

void BitsLink::hush() {
    tell("Stop");
    drain_until_quiet();
    noise_.clear();
    filled_ = 0;
    last_number_.reset();
}

void BitsLink::tell(std::string_view name, std::string_view argument) {
    const std::string command = bits_command(name, argument);
    const std::string shown = command.substr(0, command.size() - 1);
    if (transport_->write(command, clock_.now() + timeouts_.reply))
        return;
    require_line(shown);
    throw DeviceError(
        fmt::format("{}: the box did not take the command \"{}\" within {:.1f} s; switch it off and on.",
                    port(), shown, to_seconds(timeouts_.reply)));
}

std::optional<std::string> BitsLink::try_ask(std::string_view name, std::string_view argument) {
    // What is already here cannot be the answer; a stream is no reason to wait on.
    const SessionTime begun = clock_.now();
    while (pump(begun) == incoming_.size() && clock_.now() < begun + timeouts_.drain) {
    }
    // Nor can half of an answer that came too late, once its other half is here.
    if (bits_reply(splitter_.partial(), name))
        splitter_.forget();
    noise_.clear();
    stream_lines_ = 0;
    replied_ = false;
    expected_.clear();
    tell(name, argument);
    expected_ = name;

    const SessionTime asked = clock_.now();
    SessionTime deadline = asked + timeouts_.reply;
    while (!replied_ && clock_.now() < deadline) {
        const bool came = pump(deadline) > 0;
        require_line(fmt::format("${}", name));
        if (came && reply_has_begun())
            deadline = std::min(asked + timeouts_.whole_reply, clock_.now() + timeouts_.reply);
    }
    expected_.clear();
    if (!replied_)
        return std::nullopt;
    return reply_;
}

std::string BitsLink::ask(std::string_view name, std::string_view argument) {
    if (auto reply = try_ask(name, argument))
        return *reply;
    const char* const what = bits_reply(splitter_.partial(), name) ? "end of" : "line beginning with";
    throw DeviceError(
        fmt::format("{}: no {} \"#{};\" came within {:.1f} s of \"${}\", but {}; see that the box is in its "
                    "serial (CDC) mode and that this is its port.",
                    port(), what, name, to_seconds(timeouts_.reply), name, what_came()));
}

bool BitsLink::reply_has_begun() const { return bits_reply(splitter_.partial(), expected_).has_value(); }

std::string BitsLink::what_came() const {
    std::string unexpected = noise_;
    if (!splitter_.partial().empty())
        unexpected.append(unexpected.empty() ? "" : "\n").append(splitter_.partial());
    std::string came = unexpected.empty() ? "" : fmt::format("\"{}\"", printable(unexpected));
    if (stream_lines_ > 0)
        came += fmt::format("{}{} lines of a stream", came.empty() ? "" : " and ", stream_lines_);
    return came.empty() ? "nothing" : came;
}

std::size_t BitsLink::poll_status(std::span<ArrivedStatus> into) noexcept {
    while (filled_ < into.size() && pump(SessionTime()) == incoming_.size()) {
    }
    const std::size_t count = std::min(into.size(), filled_);
    for (std::size_t i = 0; i < count; ++i)
        into[i] = ring_[(first_ + i) % ring_.size()];
    first_ = (first_ + count) % ring_.size();
    filled_ -= count;
    return count;
}

bool BitsLink::wait_for_status(SessionTime deadline) noexcept {
    while (filled_ == 0 && !lost() && clock_.now() < deadline)
        pump(deadline);
    return filled_ > 0;
}

void BitsLink::require_line(std::string_view command) const {
    if (lost())
        throw DeviceError(fmt::format(
            "{}: the line to the box was lost at \"{}\" ({}); plug it in, wait until it is up and "
            "start again.",
            port(), command, transport_->loss()));
}

} // namespace overt
