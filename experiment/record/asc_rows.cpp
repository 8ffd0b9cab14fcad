#include "experiment/record/asc_rows.h"

#include <algorithm>
#include <array>
#include <utility>

#include "experiment/record/asc_trial.h"

namespace overt {

AscRows::AscRows(GazeRows& rows, AscTrialCutter::By cut_by, TrialId trial_id,
                 std::function<void(const AscTrialTimes&)> trial_over)
    : rows_(rows), cutter_(cut_by), trial_id_(std::move(trial_id)), trial_over_(std::move(trial_over)) {
    rows_.begin_trial(0);
}

void AscRows::begin_trial() {
    end();
    times_ = {};
    times_.trial = cutter_.trial();
    has_time_ = false;
    into_ = trial_id_(times_.trial);
    if (into_)
        rows_.begin_trial(*into_);
}

void AscRows::take_time(TrackerTime time) {
    times_.first = has_time_ ? std::min(times_.first, time) : time;
    times_.last = has_time_ ? std::max(times_.last, time) : time;
    has_time_ = true;
}

void AscRows::samples(std::span<const GazeSample> samples) {
    if (cutter_.take_sample())
        begin_trial();
    take_time(samples.front().sampled_at);
    if (into_)
        for (const GazeSample& sample : samples)
            rows_.sample(sample);
}

void AscRows::event(const GazeEvent& event) {
    if (cutter_.take(event))
        begin_trial();
    if (event.kind != GazeEvent::Kind::note)
        take_time(event.start);
    if (event.kind == GazeEvent::Kind::message) {
        if (is_trial_id(event))
            times_.number = asc_trial_number(event);
        const std::string_view text = event.text;
        const std::string_view word = text.substr(0, text.find(' '));
        constexpr std::array words{task_screen_message, onset_message, end_message, response_screen_message,
                                   response_message};
        if (std::find(words.begin(), words.end(), word) != words.end())
            times_.screens.emplace(word, event.start);
        if (word == "SYNCTIME")
            times_.screens.emplace(onset_message, event.start);
        times_.is_aborted |= text == "TRIAL_RESULT aborted" || text == "TRIAL_RESULT open";
    }
    if (into_)
        rows_.event(event);
}

void AscRows::end() {
    if (times_.trial >= 0 && trial_over_)
        trial_over_(times_);
    times_.trial = -1;
}

} // namespace overt
