#include "app/replay/shown_frames.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/record/read/sample_join.h"

namespace overt {

namespace {

/// The vertical blanks of the first and the last flip of the steps that lit its slot.
std::pair<SessionTime, SessionTime> shown_span(const SessionRecord& record, const TrialRecord& trial,
                                               const std::optional<TrialLedger>& ledger) {
    std::optional<std::pair<SessionTime, SessionTime>> span;
    if (ledger)
        for (const RecordedShow& show : shows_of(record.header(), trial, ledger->recorded))
            if (show.is_lit) {
                const SessionTime last = ledger->recorded[show.end - 1].report.vertical_blank;
                span = {span ? span->first : ledger->recorded[show.begin].report.vertical_blank, last};
            }
    if (!span)
        throw InputError(fmt::format("{}: nothing was shown in trial {}: choose another with --trial",
                                     record.directory().string(), trial.trial.index + 1));
    return *span;
}

} // namespace

ShownFrames::ShownFrames(const SessionRecord& record, const TrialRecord& trial, const SurfaceLookup* lookup)
    : record_(record), lookup_(lookup), history_(record.flip_history(trial, record.ledger(trial))) {
    const SessionHeader& header = record.header();
    const std::optional<TrialLedger> ledger = record.ledger(trial);
    const auto [onset, last_flip] = shown_span(record, trial, ledger);
    first_light_ = onset + header.display.latency;
    const double refresh_hz = header.display.refresh_hz;
    const int held =
        std::max(1, refreshes_per_frame(header.animation_of(trial.trial.stimulus).frame_rate_hz, refresh_hz));
    period_s_ = held / refresh_hz;
    const SessionTime last = last_flip + header.display.latency;
    const double lit_s = to_seconds(last - first_light_) + 1.0 / refresh_hz;
    // The last period counts if it was lit for half of its time.
    count_ = std::max(1, static_cast<int>(std::lround(lit_s / period_s_)));
    screen_ = header.screen_of_slot(trial.trial.slot);
    const SampleJoin join(record, trial, ledger, nullptr);
    constexpr std::size_t piece = 4096;
    record.read_samples(trial, piece, [&](std::span<const GazeSample> samples) {
        for (const GazeSample& sample : samples) {
            const JoinedSample joined = join.join(sample);
            if (joined.at)
                gaze_.push_back({to_seconds(joined.at->time - first_light_),
                                 joined.is_elsewhere ? std::nullopt : joined.image_px});
        }
    });
    std::ranges::stable_sort(gaze_, {}, &TimedGaze::at_s);
}

ShownFrame ShownFrames::frame(int number) const {
    OVERT_EXPECTS(number >= 1 && number <= count_);
    const ScreenGeometry& screen = screen_;
    ShownFrame frame;
    frame.number = number;
    frame.begin_s = (number - 1) * period_s_;
    frame.end_s = number * period_s_;
    // The middle row's light in the middle of the period.
    const double row_px = screen.image_origin_px.y + 0.5 * screen.image_px.y;
    const SessionTime middle =
        first_light_ + from_seconds(0.5 * (frame.begin_s + frame.end_s)) +
        from_seconds(row_px / screen.screen_px.y / record_.header().display.refresh_hz);
    frame.lit = history_.frame_shown_at(middle, row_px);
    frame.planned = history_.frame_planned_at(middle, row_px);
    auto gaze = std::ranges::lower_bound(gaze_, frame.begin_s, {}, &TimedGaze::at_s);
    glm::dvec2 sum{0.0};
    for (; gaze != gaze_.end() && gaze->at_s < frame.end_s; ++gaze) {
        ++frame.samples;
        if (gaze->image_px) {
            frame.gaze_px.push_back(*gaze->image_px);
            sum += *gaze->image_px;
        }
    }
    if (!frame.gaze_px.empty())
        frame.mean_px = sum / static_cast<double>(frame.gaze_px.size());
    if (frame.mean_px && frame.lit && lookup_)
        frame.surface = lookup_->surface_at(frame.lit->pose, *frame.mean_px);
    return frame;
}

const TrialRecord& attempt_at(const SessionRecord& record, int trial) {
    const TrialRecord* found = nullptr;
    for (const TrialRecord& attempt : record.trials())
        if (attempt.trial.index + 1 == trial && (attempt.counts || !found || !found->counts))
            found = &attempt;
    if (found)
        return *found;
    throw InputError(fmt::format("{}: there is no attempt at trial {}; the session's order has {}, and "
                                 "`overt show` lists what was attempted",
                                 record.directory().string(), trial, record.header().schedule.trials.size()));
}

} // namespace overt
