#include "experiment/record/foreign/shared_markers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/clock_map.h"

namespace overt {
namespace {

constexpr SessionDuration lead{std::chrono::seconds(1)};

struct SharedMarker {
    const LoggedMarker* logged;
    TrackerTime at;
};

/// A mark is a marker's if it says the same, behind what the tracker's program puts before it.
bool is_of_marker(const std::string& mark, const std::string& marker) {
    return mark == marker || mark.ends_with(" " + marker);
}

std::vector<SharedMarker> shared_markers(const TrialLog& log, const GazeSurvey& gaze,
                                         std::vector<std::string>& remarks) {
    std::map<std::string, std::vector<const LoggedMarker*>> logged;
    for (const LoggedMarker& marker : log.markers)
        logged[marker.text].push_back(&marker);
    std::vector<SharedMarker> shared;
    for (const auto& [text, sent] : logged) {
        std::vector<TrackerTime> received;
        for (const GazeMark& mark : gaze.marks)
            if (!mark.is_trial && is_of_marker(mark.text, text))
                received.push_back(mark.at);
        if (received.size() == sent.size()) {
            for (std::size_t i = 0; i < sent.size(); ++i)
                shared.push_back({sent[i], received[i]});
        } else if (!received.empty()) {
            remarks.push_back(fmt::format(
                "The marker \"{}\" is {} times in the log and {} times in the recording: it relates "
                "no times.",
                text, sent.size(), received.size()));
        }
    }
    std::ranges::sort(shared, {}, [](const SharedMarker& marker) { return marker.logged->at; });
    return shared;
}

std::string first_texts(const auto& marks) {
    std::set<std::string> texts;
    for (const auto& mark : marks)
        if (texts.size() < 4)
            texts.insert(mark.text);
    std::string all;
    for (const std::string& text : texts)
        all += (all.empty() ? "\"" : ", \"") + text + "\"";
    return all.empty() ? "none" : all;
}

SessionDuration half(LogTime tick) { return SessionDuration(tick.count() / 2 + 1); }

ClockRelation one_clock(const TrialLog& log, const GazeSurvey& gaze, const std::string& file) {
    const LogTime offset = log.zero ? LogTime(log.zero->time_since_epoch()) : LogTime(0);
    const LogTime first = LogTime(gaze.first.time_since_epoch()) - offset,
                  last = LogTime(gaze.last.time_since_epoch()) - offset;
    const auto is_outside = [&](const LoggedTrial& trial) {
        return trial.onset < first - lead || trial.onset > last + lead;
    };
    if (const auto outside = std::ranges::find_if(log.trials, is_outside); outside != log.trials.end())
        throw InputError(fmt::format("{}: this trial began at {:.6f} s, and the recording goes from {:.6f} "
                                     "to {:.6f} s: the two have different clocks. "
                                     "Name the column of markers that the tracker was sent, --trial-columns "
                                     "marker=NAME, and in the recording their "
                                     "column, --columns …,mark=NAME",
                                     outside->place, 1e-9 * static_cast<double>(outside->onset.count()),
                                     1e-9 * static_cast<double>(first.count()),
                                     1e-9 * static_cast<double>(last.count())));
    ClockRelation relation;
    relation.zero = std::min(first, log.trials.front().onset) - lead;
    relation.bound = half(gaze.tick) + half(log.tick);
    for (const TrackerTime at : {gaze.first, gaze.last}) {
        const SessionTime session = relation.session(LogTime(at.time_since_epoch()) - offset);
        relation.pairs.push_back({session - relation.bound, at, session + relation.bound});
    }
    relation.remarks.push_back(
        log.zero && gaze.columns.start_s != 0.0
            ? fmt::format(
                  "Times of {} count so that the recording's first sample is at {:.6g} s (StartTime).", file,
                  gaze.columns.start_s)
        : log.zero
            ? fmt::format("Times of {} count from the recording's first sample.", file)
            : fmt::format("Times of {} are taken for the tracker's own: no markers relate them.", file));
    return relation;
}

} // namespace

ClockRelation relate_clocks(const TrialLog& log, const GazeSurvey& gaze, const std::string& file) {
    if (log.markers.empty())
        return one_clock(log, gaze, file);
    ClockRelation relation;
    const std::vector<SharedMarker> shared = shared_markers(log, gaze, relation.remarks);
    if (shared.empty())
        throw InputError(fmt::format(
            "{}: none of its markers is in the recording as often as here; the log has {}, the recording {}",
            file, first_texts(log.markers), first_texts(gaze.marks)));
    // The line as of readings that are exact: what they are off it is how far they may be wrong.
    relation.zero = shared.front().logged->at;
    std::vector<ClockPair> exact;
    for (const SharedMarker& marker : shared) {
        const SessionTime at = relation.session(marker.logged->at);
        exact.push_back({at - SessionDuration(1), marker.at, at + SessionDuration(1)});
    }
    const ClockMapOf<TrackerClock> line(exact);
    const SharedMarker* worst = &shared.front();
    SessionDuration largest{};
    for (const SharedMarker& marker : shared) {
        const SessionDuration off = line.to_session(marker.at).time - relation.session(marker.logged->at);
        if (const SessionDuration size = off < SessionDuration(0) ? -off : off; size > largest) {
            largest = size;
            worst = &marker;
        }
    }
    relation.bound = largest + half(gaze.tick) + half(log.tick);
    const SessionDuration begin =
        std::min(line.to_session(gaze.first).time, relation.session(log.trials.front().onset))
            .time_since_epoch();
    relation.zero += begin - lead;
    for (const SharedMarker& marker : shared) {
        const SessionTime at = relation.session(marker.logged->at);
        relation.pairs.push_back({at - relation.bound, marker.at, at + relation.bound});
    }
    relation.remarks.push_back(
        fmt::format("{} shared markers relate the clocks, which run apart by {:.1f} ppm; the largest "
                    "distance of one from the line is {:.3f} ms "
                    "({}), so that a sample's time is off by {:.3f} ms at most where markers are.",
                    shared.size(), line.drift_ppm(), 1e-6 * static_cast<double>(largest.count()),
                    worst->logged->place, 1e-6 * static_cast<double>(relation.bound.count())));
    if (shared.size() == 1)
        relation.remarks.emplace_back(
            "One shared marker alone says nothing of the clocks' rates, which may differ by 200 ppm: "
            "12 ms in a minute.");
    return relation;
}

} // namespace overt
