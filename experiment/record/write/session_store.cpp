#include "experiment/record/write/session_store.h"

#include <ctime>
#include <utility>

#include <fmt/chrono.h>

#include "experiment/base/error.h"
#include "experiment/record/write/session_writer.h"

namespace overt {

SessionStore::SessionStore(const std::filesystem::path& session_file, const Options& options)
    : writer_(std::make_unique<Writer>(session_file, options)) {}

SessionStore::~SessionStore() {
    try {
        close();
    } catch (const Error&) {
        // Whoever wants to know calls close().
    }
}

void SessionStore::flip(const FlipRecord& flip) noexcept { writer_->push(Row(flip)); }

void SessionStore::slot_flip(const SlotFlip& flip) noexcept { writer_->push(Row(flip)); }
void SessionStore::steered_flip(const SteeredFlip& flip) noexcept { writer_->push(Row(flip)); }

void SessionStore::missed(const MissedRefresh& refresh) noexcept { writer_->push(Row(refresh)); }

void SessionStore::sample(int trial, const GazeSample& sample) noexcept {
    writer_->push(Row(SampleRow{trial, sample}));
}

void SessionStore::tracker_item(int trial, const TrackerItem& item) noexcept {
    writer_->push(Row(TrackerItemRow{trial, item}));
}

void SessionStore::calibration(const RecordedCalibration& calibration) { writer_->send(calibration); }

void SessionStore::buttons(const std::vector<RecordedButton>& buttons) { writer_->send(buttons); }

void SessionStore::key_presses(const std::vector<RecordedKeyPress>& presses) { writer_->send(presses); }

void SessionStore::gaze_came(const GazeYield& gaze) { writer_->send(gaze); }

void SessionStore::markers(const std::vector<RecordedMarker>& markers) { writer_->send(markers); }

void SessionStore::clock_pair(const ClockPair& pair) noexcept { writer_->push(Row(pair)); }

void SessionStore::event(const SessionEvent& event) {
    writer_->send(EventRow{event.at, event.trial, std::string(event.kind), event.detail});
}

void SessionStore::trial_started(const Trial& trial, SessionTime at) {
    writer_->lost_before_trial = writer_->lost();
    writer_->send(TrialStart{trial, at});
}

void SessionStore::trial_finished(const Trial& trial, const TrialOutcome& outcome) {
    const LostRows now = writer_->lost();
    const LostRows before = writer_->lost_before_trial;
    auto written =
        writer_->send(TrialFinish{trial, outcome, now.flips - before.flips, now.samples - before.samples});
    writer_->wake();
    written.get();
}

void SessionStore::consent(const RecordedConsent& consent) {
    RecordedConsent dated = consent;
    if (dated.utc.empty())
        dated.utc = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
    writer_->send(std::move(dated));
}

void SessionStore::answer_recorded(const RecordedAnswer& answer) { writer_->send(answer); }

void SessionStore::observer_fields(const std::vector<RecordedObserverField>& fields) {
    writer_->send(fields);
}

void SessionStore::map_made(const RecordedMap& map) { writer_->send(map); }

void SessionStore::display_box(const RecordedBox& box) { writer_->send(box); }

void SessionStore::box_clock(const std::vector<BoxClockPair>& readings) { writer_->send(readings); }

LostRows SessionStore::lost() const noexcept { return writer_ ? writer_->lost() : lost_in_all_; }

void SessionStore::close() {
    const std::unique_ptr<Writer> writer = std::move(writer_);
    if (!writer)
        return;
    writer->stop();
    lost_in_all_ = writer->lost();
    writer->close();
}

} // namespace overt
