#include "experiment/record/foreign/foreign_frames.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

/// An angle is a pose's if it is nearer than this: logs have angles in single precision or with few decimals.
constexpr double most_off_deg = 0.5;

struct LoggedLight {
    SessionTime at;
    AnimationFrameIndex frame;
};

AnimationFrameIndex frame_of(const LoggedFrame& row, const SessionHeader& header, int motion) {
    const std::span<const PoseIndex> poses = header.poses.frames_of(motion);
    if (row.frame) {
        if (*row.frame >= static_cast<int>(poses.size()))
            throw InputError(fmt::format("{}: there is no frame {}: the motion has {}, from 0 on", row.place,
                                         *row.frame, poses.size()));
        return {*row.frame};
    }
    AnimationFrameIndex nearest{0};
    double least = 1e9;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const double off =
            std::abs(std::remainder(header.poses.object_of(poses[i]).angle.value - *row.angle_deg, 360.0));
        if (off < least - 1e-9) {
            least = off;
            nearest = {static_cast<int>(i)};
        }
    }
    if (least > most_off_deg)
        throw InputError(fmt::format(
            "{}: no frame of the motion shows the object turned by {} degrees; the nearest is {:.3f} off: "
            "the protocol's [animation] has to have the poses that were shown",
            row.place, *row.angle_deg, least));
    return nearest;
}

/// The rows of a trial; of a log without keys, those from its onset until its end or the next trial.
std::vector<LoggedLight> frames_of_trial(const std::vector<LoggedFrame>& rows, const ForeignTrial& trial,
                                         std::optional<SessionTime> end, const SessionHeader& header,
                                         const ClockRelation& clocks, SessionDuration refresh) {
    std::vector<LoggedLight> lit;
    for (const LoggedFrame& row : rows) {
        const SessionTime at = clocks.session(row.at);
        const bool is_its = !row.key.empty() && !trial.logged.key.empty()
                                ? row.key == trial.logged.key
                                : at >= trial.onset - refresh / 2 && (!end || at < *end);
        if (is_its)
            lit.push_back({at, frame_of(row, header, trial.trial.stimulus.motion)});
    }
    if (lit.empty())
        throw InputError(fmt::format("{}: the log of frames has no row of this trial", trial.logged.place));
    return lit;
}

class FlipMaker {
  public:
    FlipMaker(const SessionHeader& header, ForeignTrial& trial, SessionDuration refresh)
        : header_(header), trial_(trial), refresh_(refresh) {
        for (std::size_t i = 0; i < trial.trial.shown_count(); ++i)
            plans_.push_back(header.page_cycle_of(trial.trial.shown(i).stimulus));
    }
    int planned_refreshes() const { return plans_.front().total_refreshes; }
    void keep(int refreshes) {
        for (PageCycle& plan : plans_)
            plan = cut_to(std::move(plan), refreshes, std::nullopt);
    }

    void add(SessionTime at, std::optional<AnimationFrameIndex> shown) {
        const int n = static_cast<int>(trial_.flips.size());
        FlipRecord flip;
        flip.trial = trial_.trial.index;
        flip.refresh_in_trial = n;
        flip.planned = planned(0, n);
        flip.shown = shown.value_or(flip.planned);
        flip.pose = header_.poses.pose_of(trial_.trial.stimulus.motion, flip.shown);
        flip.report.refresh = {std::llround(to_seconds(at) / to_seconds(refresh_))};
        if (n > 0) // times of a log scatter, and a refresh has one flip
            flip.report.refresh.value =
                std::max(flip.report.refresh.value, trial_.flips.back().report.refresh.value + 1);
        flip.report.requested = flip.report.swapped = flip.report.vertical_blank = at;
        flip.report.source = VblankSource::swap_return; // nobody counted refreshes
        flip.report.uncertainty = refresh_;
        trial_.flips.push_back(flip);
        for (std::size_t place = 1; place < plans_.size(); ++place) {
            const AnimationFrameIndex frame = planned(place, n);
            const int motion = trial_.trial.shown(place).stimulus.motion;
            trial_.slot_flips.push_back(
                {flip.trial, n, static_cast<int>(place), frame, frame, header_.poses.pose_of(motion, frame)});
        }
    }

  private:
    AnimationFrameIndex planned(std::size_t place, int n) const {
        const PageCycle& plan = plans_[place];
        return plan.entry_at(std::min(n, plan.total_refreshes - 1)).frame;
    }
    const SessionHeader& header_;
    ForeignTrial& trial_;
    SessionDuration refresh_;
    std::vector<PageCycle> plans_;
};

} // namespace

void add_flips(const SessionHeader& header, const std::optional<std::vector<LoggedFrame>>& frames,
               ForeignPlan& plan) {
    const double refresh_s = 1.0 / header.display.refresh_hz;
    const SessionDuration refresh = from_seconds(refresh_s);
    for (std::size_t i = 0; i < plan.trials.size(); ++i) {
        ForeignTrial& trial = plan.trials[i];
        FlipMaker maker(header, trial, refresh);
        std::optional<SessionTime> end;
        if (trial.logged.end)
            end = plan.clocks.session(*trial.logged.end);
        if (!frames) {
            const int refreshes =
                end ? std::max(1, static_cast<int>(std::lround(to_seconds(*end - trial.onset) / refresh_s)))
                    : maker.planned_refreshes();
            maker.keep(refreshes);
            for (int n = 0; n < refreshes; ++n)
                maker.add(trial.onset + from_seconds(n * refresh_s), std::nullopt);
            trial.end = end.value_or(trial.onset + from_seconds(refreshes * refresh_s));
            continue;
        }
        std::optional<SessionTime> stop = end;
        if (!stop && i + 1 < plan.trials.size())
            stop = plan.trials[i + 1].onset;
        const std::vector<LoggedLight> lit =
            frames_of_trial(*frames, trial, stop, header, plan.clocks, refresh);
        trial.onset = lit.front().at;
        trial.end = std::max(end.value_or(lit.back().at + refresh), lit.back().at + refresh);
        maker.keep(
            std::max(1, static_cast<int>(std::lround(to_seconds(trial.end - trial.onset) / refresh_s))));
        for (std::size_t row = 0; row < lit.size(); ++row) {
            const SessionTime next = row + 1 < lit.size() ? lit[row + 1].at : trial.end;
            const int refreshes =
                std::max(1, static_cast<int>(std::lround(to_seconds(next - lit[row].at) / refresh_s)));
            for (int n = 0; n < refreshes; ++n)
                maker.add(lit[row].at + from_seconds(n * refresh_s), lit[row].frame);
        }
    }
    plan.remarks.push_back(
        frames ? "What was lit is that of the log of frames: nobody knows whether the screen missed "
                 "refreshes, or how "
                 "long after the log its light came ([display] latency_ms says that, if it is known)."
               : "What was lit is what the protocol plans from each onset on: nobody knows whether the "
                 "screen missed "
                 "refreshes, or how long after the onset its light came ([display] latency_ms says that, if "
                 "it is known).");
}

} // namespace overt
