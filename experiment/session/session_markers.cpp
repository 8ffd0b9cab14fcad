#include "experiment/session/session_markers.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/ports/event_kinds.h"

namespace overt {
namespace {

/// Each frame of half a minute at 120 Hz, and the rest.
constexpr std::size_t most_marks = 4096;

} // namespace

SessionMarkers::SessionMarkers(const Protocol& protocol, const std::vector<MarkerSink*>& sinks)
    : protocol_(protocol), sinks_(sinks) {
    if (sinks_.empty())
        return;
    for (std::size_t i = 0; i < sinks_.size() && i < protocol.marker_outputs.size(); ++i) {
        codes_.emplace_back(protocol, protocol.marker_outputs[i]);
        if (row_of(protocol.marker_outputs[i].kind).rides_on_picture)
            t_lock_ = i;
    }
    if (t_lock_)
        outputs_after_ = from_seconds(
            protocol.marker_outputs[*t_lock_].offset_ms.value_or(1e3 / protocol.display.refresh_hz) / 1e3);
    marks_.reserve(most_marks);
    if (t_lock_)
        raised_.reserve(most_marks);
    fates_.resize(256);
}

void SessionMarkers::begin_trial(const Trial& trial, bool is_practice) noexcept {
    trial_ = trial;
    is_silent_ = is_practice || codes_.empty();
}

std::int64_t SessionMarkers::keep(SessionTime at, std::string_view text, int planned, int shown) noexcept {
    if (marks_.size() == marks_.capacity()) {
        ++forgotten_;
        return -1;
    }
    Mark mark{};
    mark.at = at;
    mark.length = static_cast<std::uint8_t>(std::min(text.size(), longest_marker));
    std::memcpy(mark.text.data(), text.data(), mark.length);
    mark.trial = trial_.index;
    mark.planned = planned;
    mark.shown = shown;
    marks_.push_back(mark);
    return first_ + static_cast<std::int64_t>(marks_.size()) - 1;
}

void SessionMarkers::send(std::optional<MarkedEvent> event, SessionTime at, std::string_view text,
                          std::optional<int> planned, std::optional<int> shown) noexcept {
    if (is_silent_)
        return;
    const std::int64_t number = keep(at, text, planned.value_or(-1), shown.value_or(-1));
    for (std::size_t i = 0; i < codes_.size(); ++i) {
        if (!sinks_[i])
            continue;
        const int code = event ? codes_[i].code_of(*event, trial_) : 0;
        sinks_[i]->mark({at, static_cast<std::uint8_t>(code), text, number});
    }
}

void SessionMarkers::mark(MarkedEvent event, SessionTime at, std::string_view text) noexcept {
    send(event, at, text, {}, {});
}

void SessionMarkers::begin_presentation(std::string_view onset_text) noexcept {
    onset_text_ = onset_text;
    frame_ = no_frame;
    planned_ = -1;
    next_refresh_code_ = 0;
}

void SessionMarkers::before_flip(int refresh, AnimationFrameIndex frame, Presenter& presenter) noexcept {
    planned_ = refresh;
    raised_now_ = 0;
    if (is_silent_ || !t_lock_)
        return;
    const MarkerCodes& codes = codes_[*t_lock_];
    // Refreshes that went by with the picture before: their outputs were never raised.
    while (next_refresh_code_ < codes.refresh_codes().size() &&
           codes.refresh_codes()[next_refresh_code_].refresh < refresh) {
        const RefreshCode& missed = codes.refresh_codes()[next_refresh_code_++];
        keep_raised({}, "REFRESH", missed.code, missed.refresh, -1, nullptr);
    }
    if (frame != frame_)
        raised_now_ = codes.code_of(frame_ == no_frame ? MarkedEvent::onset : MarkedEvent::frame, trial_);
    if (next_refresh_code_ < codes.refresh_codes().size() &&
        codes.refresh_codes()[next_refresh_code_].refresh == refresh)
        raised_now_ |= codes.refresh_codes()[next_refresh_code_++].code;
    if (raised_now_ != 0)
        presenter.raise_with_next_flip(static_cast<std::uint16_t>(raised_now_),
                                       protocol_.marker_outputs[*t_lock_].pulse_ms);
}

void SessionMarkers::keep_raised(SessionTime at, std::string_view text, int code, int planned, int shown,
                                 const FlipReport* flip) noexcept {
    const std::int64_t number = keep(at, text, planned, shown);
    if (number < 0 || raised_.size() == raised_.capacity())
        return;
    Raised raised{number, code, flip != nullptr, {}, {}};
    if (flip) {
        raised.not_before = flip->swapped;
        raised.not_after = flip->vertical_blank + outputs_after_;
    }
    raised_.push_back(raised);
}

void SessionMarkers::flipped(const FlipRecord& flip, int refresh) noexcept {
    if (is_silent_)
        return;
    const SessionTime lit = flip.report.vertical_blank;
    const bool is_onset = frame_ == no_frame, is_new = flip.shown != frame_;
    frame_ = flip.shown;
    std::array<char, 24> words{};
    const auto end = fmt::format_to_n(words.data(), words.size(), "FRAME {}", flip.shown.value).out;
    const std::string_view text = is_onset ? onset_text_ : std::string_view(words.data(), end);
    if (is_new)
        send(is_onset ? MarkedEvent::onset : MarkedEvent::frame, lit, text, planned_, refresh);
    if (raised_now_ != 0)
        keep_raised(lit, is_new ? text : std::string_view("REFRESH"), raised_now_, planned_, refresh,
                    &flip.report);
}

RecordedMarker SessionMarkers::recorded(std::int64_t number, std::string_view output) const {
    RecordedMarker marker;
    marker.output = output;
    const std::int64_t place = number - first_;
    if (number < 0 || place < 0 || place >= static_cast<std::int64_t>(marks_.size()))
        return marker;
    const Mark& mark = marks_[static_cast<std::size_t>(place)];
    marker.at = mark.at;
    marker.trial = mark.trial;
    marker.text.assign(mark.text.data(), mark.length);
    if (mark.planned >= 0)
        marker.planned_refresh = mark.planned;
    if (mark.shown >= 0)
        marker.shown_refresh = mark.shown;
    return marker;
}

void SessionMarkers::write_down(SessionLog& log) {
    if (codes_.empty())
        return;
    std::vector<RecordedMarker> markers;
    for (std::size_t i = 0; i < codes_.size(); ++i) {
        if (!sinks_[i])
            continue;
        const std::string& output = protocol_.marker_outputs[i].id;
        for (std::size_t taken = fates_.size(); taken == fates_.size();) {
            taken = sinks_[i]->poll(fates_);
            for (std::size_t k = 0; k < taken; ++k) {
                RecordedMarker marker = recorded(fates_[k].number, output);
                marker.at = fates_[k].at;
                marker.code = fates_[k].code;
                marker.is_sent = fates_[k].is_sent;
                marker.not_before = fates_[k].not_before;
                marker.not_after = fates_[k].not_after;
                markers.push_back(std::move(marker));
            }
        }
    }
    for (const Raised& raised : raised_) {
        RecordedMarker marker = recorded(raised.mark, protocol_.marker_outputs[*t_lock_].id);
        marker.code = raised.code;
        marker.is_sent = raised.is_sent;
        marker.not_before = raised.not_before;
        marker.not_after = raised.not_after;
        markers.push_back(std::move(marker));
    }
    raised_.clear();
    if (!markers.empty())
        log.markers(markers);
    if (forgotten_ > 0)
        log.event(
            {markers.empty() ? SessionTime() : markers.back().at, -1, marker_output_event,
             fmt::format("{} came too fast for all of it to be recorded", counted(forgotten_, "marker"))});
    forgotten_ = 0;
    // What became of the older ones is known; the others may still wait in an output.
    if (marks_.size() > marks_.capacity() / 2) {
        const std::size_t old = marks_.size() / 2;
        marks_.erase(marks_.begin(), marks_.begin() + static_cast<std::ptrdiff_t>(old));
        first_ += static_cast<std::int64_t>(old);
    }
}

std::vector<std::string> SessionMarkers::finish(SessionLog& log) {
    std::vector<std::string> said;
    for (MarkerSink* const sink : sinks_)
        if (sink)
            for (std::string& sentence : sink->finish())
                said.push_back(std::move(sentence));
    write_down(log);
    return said;
}

} // namespace overt
