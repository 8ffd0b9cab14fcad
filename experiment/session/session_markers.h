/// Tells the outputs of markers what happens in a trial, and records what became of each marker.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "experiment/flip_report.h"
#include "experiment/ports/marker_sink.h"
#include "experiment/ports/presenter.h"
#include "experiment/ports/session_log.h"
#include "experiment/protocol/marker_codes.h"

namespace overt {

/// One thread, the session's. What is noexcept allocates and waits for nothing.
class SessionMarkers {
  public:
    /// `sinks`: one for each [[marker_output]], see SessionPorts, or none at all. All must outlive this.
    SessionMarkers(const Protocol& protocol, const std::vector<MarkerSink*>& sinks);

    /// Markers are of this trial from now on; in practice none are sent.
    void begin_trial(const Trial& trial, bool is_practice) noexcept;

    void mark(MarkedEvent event, SessionTime at, std::string_view text) noexcept;
    /// For outputs that tell texts.
    void tell(SessionTime at, std::string_view text) noexcept { send(std::nullopt, at, text, {}, {}); }

    /// A show begins with the next flip. `onset_text`: of its onset's marker; must stay as long as the show.
    void begin_presentation(std::string_view onset_text) noexcept;
    /// The next flip is meant for this refresh of the animation, and shows this frame: raises what rides on
    /// it.
    void before_flip(int refresh, AnimationFrameIndex frame, Presenter& presenter) noexcept;
    /// Marks the onset and further frames. `refresh`: of the show, at which the flip was lit.
    void flipped(const FlipRecord& flip, int refresh) noexcept;

    /// Records what is known by now of markers sent before. Throws as SessionLog does.
    void write_down(SessionLog& log);
    /// Ends the outputs, and records the rest. Gives a sentence for each thing the operator should know.
    std::vector<std::string> finish(SessionLog& log);

  private:
    struct Mark {
        SessionTime at;
        std::array<char, longest_marker> text;
        std::uint8_t length = 0;
        int trial = -1;
        int planned = -1, shown = -1; ///< refreshes; -1: none
    };
    /// What the picture raised.
    struct Raised {
        std::int64_t mark = -1;
        int code = 0;
        bool is_sent = false;
        SessionTime not_before, not_after;
    };
    void send(std::optional<MarkedEvent> event, SessionTime at, std::string_view text,
              std::optional<int> planned, std::optional<int> shown) noexcept;
    std::int64_t keep(SessionTime at, std::string_view text, int planned, int shown) noexcept;
    void keep_raised(SessionTime at, std::string_view text, int code, int planned, int shown,
                     const FlipReport* flip) noexcept;
    RecordedMarker recorded(std::int64_t number, std::string_view output) const;

    const Protocol& protocol_;
    const std::vector<MarkerSink*>& sinks_;
    std::vector<MarkerCodes> codes_;    ///< by output
    SessionDuration outputs_after_{};   ///< from the vertical blank of its refresh to its outputs' edge
    std::optional<std::size_t> t_lock_; ///< which output rides on the video signal, if it is used
    Trial trial_;
    bool is_silent_ = true;
    std::vector<Mark> marks_;    ///< room for those between two calls of write_down()
    std::int64_t first_ = 0;     ///< number of the first of them
    std::int64_t forgotten_ = 0; ///< there was no room
    std::vector<Raised> raised_;
    // Of the show.
    std::string_view onset_text_;
    AnimationFrameIndex frame_ = no_frame;
    int planned_ = -1; ///< refresh of the flip under way
    int raised_now_ = 0;
    std::size_t next_refresh_code_ = 0;
    std::vector<SentMarker> fates_;
};

} // namespace overt
