#include "devices/replay/replay_source.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/record/asc/asc_import.h"
#include "experiment/record/no_stimulus.h"

namespace overt {

namespace {

/// The time of an item on the tracker's clock; of what lasts, its end, when the tracker told it.
TrackerTime time_of(const TrackerItem& item) {
    struct Time {
        TrackerTime operator()(const GazeSample& sample) const { return sample.sampled_at; }
        TrackerTime operator()(const SampleDetail& detail) const { return detail.sampled_at; }
        TrackerTime operator()(const TrackerEvent& event) const { return event.end; }
        TrackerTime operator()(const TrackerInput& input) const { return input.at; }
        TrackerTime operator()(const TrackerButton& button) const { return button.at; }
        TrackerTime operator()(const TrackerGap& gap) const { return gap.after; }
        TrackerTime operator()(const ClockPair& pair) const { return pair.other; }
    };
    return std::visit(Time{}, item);
}

template <class Items> std::string id_at(const Items& items, int index) {
    return index >= 0 && index < static_cast<int>(items.size()) ? items[static_cast<std::size_t>(index)].id
                                                                : std::string();
}

} // namespace

ReplaySource::ReplaySource(const std::filesystem::path& recording) {
    if (recording.empty())
        throw InputError(
            "the eye tracker \"replay\" needs a recording: write [tracker] address = \"…\" with a "
            "session's folder or an EyeLink recording (.asc), or give --address");
    if (!std::filesystem::exists(recording))
        throw InputError(
            fmt::format("{}: this recording, which the eye tracker \"replay\" is to play back, is "
                        "not there",
                        recording.string()));
    std::filesystem::path session = recording;
    if (std::filesystem::is_regular_file(recording) && recording.extension() != ".sqlite") {
        imported_ = std::make_unique<ScratchFolder>("overt-replay");
        AscImportOptions options;
        options.out = imported_->path() / "session";
        options.place = {imported_->path(), "replayed", "replayed"};
        options.now_utc = "1970-01-01T00:00:00Z"; // nobody reads when it was imported
        session = import_asc(AscFiles(recording), options).session;
    }
    record_ = std::make_unique<SessionRecord>(session);
    for (const TrialRecord& trial : record_->trials()) {
        clock_ = record_->clock_map(trial);
        if (!clock_ || !record_->sample_span(trial))
            continue;
        const SessionRecord::Eyes eyes = record_->eyes(trial.sitting);
        both_eyes_ = eyes.both();
        eye_ = both_eyes_ ? record_->header().tracker.eye : eyes.left ? Eye::left : Eye::right;
        tells_events_ =
            record_->event_origin(trial.sitting).from == SessionRecord::EventOrigin::From::tracker;
        return;
    }
    throw InputError(fmt::format("{}: this recording has no gaze to be played back", recording.string()));
}

std::optional<ReplayedTrial> ReplaySource::attempt_at(int trial, int number) const {
    const TrialRecord* found = nullptr;
    int seen = 0;
    for (const TrialRecord& attempt : record_->trials())
        if (attempt.trial.index == trial && seen < number && record_->sample_span(attempt)) {
            found = &attempt;
            ++seen;
        }
    const std::optional<ClockMap> clock = found ? record_->clock_map(*found) : std::nullopt;
    if (!clock)
        return std::nullopt;
    ReplayedTrial replayed;
    replayed.attempt_id = found->id;
    if (found->reached(found->outcome.presentation_onset))
        replayed.onset = clock->to_other(found->outcome.presentation_onset);
    if (found->has_outcome())
        replayed.drift = found->outcome.drift;
    if (!knows_no_stimulus(record_->header())) {
        replayed.object = id_at(record_->header().objects, found->trial.stimulus.object);
        replayed.material = id_at(record_->header().materials, found->trial.stimulus.material);
    }
    record_->read_samples(*found, 4096, [&](std::span<const GazeSample> samples) {
        replayed.items.insert(replayed.items.end(), samples.begin(), samples.end());
    });
    record_->read_gaze_events(*found, [&](const GazeEvent& event) {
        if (is_eye_event(event.kind) && !tells_events_)
            return; // whoever records what is played back finds them
        if (const std::optional<TrackerItem> item = tracker_item_of(event))
            replayed.items.push_back(*item);
    });
    std::ranges::stable_sort(replayed.items, {}, time_of);
    return replayed;
}

std::optional<RecordedCalibration> ReplaySource::calibration(int number) const {
    std::vector<RecordedCalibration> all;
    for (int sitting = 1; sitting <= (record_->trials().empty() ? 1 : record_->trials().back().sitting);
         ++sitting)
        for (RecordedCalibration& calibration : record_->calibrations(sitting))
            all.push_back(std::move(calibration));
    if (all.empty())
        return std::nullopt;
    return all[std::min(static_cast<std::size_t>(number), all.size()) - 1];
}

} // namespace overt
