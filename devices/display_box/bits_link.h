/// A conversation with a Display++ or Bits#: questions with their answers, and the status stream that may run
/// between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "devices/display_box/bits_protocol.h"
#include "devices/display_box/bits_status.h"
#include "devices/link/byte_transport.h"
#include "devices/link/text_line.h"
#include "experiment/ports/clock.h"

namespace overt {

/// How long to wait for what.
struct BitsTimeouts {
    /// A reply must have begun by then, and must go on within this time until it is complete. A box answers
    /// within milliseconds; a machine that is busy may take a second to notice.
    SessionDuration reply = std::chrono::seconds(2);
    /// A reply must be complete by then.
    SessionDuration whole_reply = std::chrono::seconds(5);
    /// So long nothing must come for the line to be quiet.
    SessionDuration quiet = std::chrono::milliseconds(100);
    /// Waiting for quiet ends here, quiet or not.
    SessionDuration drain = std::chrono::seconds(1);
};

/// A status sample and when it was here.
struct ArrivedStatus {
    StatusSample sample;
    SessionTime read_at; ///< right after the read that brought its end: not before the sample was taken
};

/// Owns the line. Functions that throw throw DeviceError, which names the port, the command and what came
/// instead of its reply. One thread.
class BitsLink {
  public:
    /// `clock` must outlive the link.
    BitsLink(std::unique_ptr<ByteTransport> transport, Clock& clock, BitsTimeouts timeouts = {});

    const std::string& port() const noexcept { return transport_->name(); }
    bool lost() const noexcept { return transport_->lost(); }
    const BitsTimeouts& timeouts() const noexcept { return timeouts_; }

    /// Sends "$Stop" and waits until nothing comes any more. Forgets what came, status samples too.
    void hush();

    /// Sends a command that has no reply.
    void tell(std::string_view name, std::string_view argument = {});

    /// Sends a command and gives what follows "#name;" in its reply. What came before is not taken for an
    /// answer.
    std::string ask(std::string_view name, std::string_view argument = {});

    /// As ask(), but gives nothing where no reply came in time. A lost line throws.
    std::optional<std::string> try_ask(std::string_view name, std::string_view argument = {});

    /// Status samples that have arrived, oldest first; gives their number. Call until it gives less than the
    /// span holds. Does not wait; allocates and throws nothing.
    std::size_t poll_status(std::span<ArrivedStatus> into) noexcept;

    /// Waits for at least one status sample until the deadline. False if none came.
    bool wait_for_status(SessionTime deadline) noexcept;

    /// Status samples whose number is missing between two that came, and those that were not fetched in time.
    std::uint64_t lost_samples() const noexcept { return lost_samples_; }

    /// What came since the last command and was neither its reply nor of a stream, as it may stand in a
    /// message.
    std::string what_came() const;

  private:
    std::size_t pump(SessionTime deadline) noexcept;
    void take_line(std::string_view line) noexcept;
    void keep(const StatusSample& sample) noexcept;
    void note_noise(std::string_view text) noexcept;
    void drain_until_quiet();
    bool reply_has_begun() const;
    void require_line(std::string_view command) const;

    std::unique_ptr<ByteTransport> transport_;
    Clock& clock_;
    BitsTimeouts timeouts_;
    LineSplitter splitter_{longest_bits_line};
    std::vector<char> incoming_;

    std::string expected_; ///< name of the reply waited for; empty: none
    std::string reply_;    ///< its text; room for the longest line is kept
    bool replied_ = false;
    std::string noise_; ///< the last of what was not expected, within its first capacity
    std::size_t stream_lines_ = 0;

    std::vector<ArrivedStatus> ring_;
    std::size_t first_ = 0, filled_ = 0;
    std::optional<std::uint64_t> last_number_;
    std::uint64_t lost_samples_ = 0;
};

} // namespace overt
