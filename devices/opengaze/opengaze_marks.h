/// Marks on their way into the records of an Open Gaze server, each of which bears one text: the last that
/// was sent before it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/session_time.h"

namespace overt {

/// A mark that comes before a record has borne the one before it does not replace that, but goes out together
/// with it: "SYNCTIME | FRAME 0". What has no room is left out, frames first, and counted. One thread at a
/// time.
class OpenGazeMarks {
  public:
    /// The longest text; the API's document names no limit, so it is one that a line of any server holds.
    static constexpr std::size_t longest = 240;

    /// `interval`: between two records.
    void begin(SessionDuration interval) noexcept { interval_ = interval; }

    /// What is to be sent now, of ASCII that may stand in a value.
    std::string add(std::string_view text, SessionTime now);

    /// A record came that bears this text: if it is what was sent last, nothing of it has to be sent again.
    void borne(std::string_view user) noexcept;

    /// Since the beginning of the session.
    std::int64_t frames_left_out() const noexcept { return frames_left_out_; }
    std::int64_t others_left_out() const noexcept { return others_left_out_; }

  private:
    std::string joined() const;
    void leave_one_out();

    std::vector<std::string> waiting_; ///< in their order
    std::string sent_;
    SessionTime sent_at_;
    SessionDuration interval_ = std::chrono::milliseconds(17);
    std::int64_t frames_left_out_ = 0, others_left_out_ = 0;
};

} // namespace overt
