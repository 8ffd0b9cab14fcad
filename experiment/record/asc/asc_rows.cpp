#include "experiment/record/asc/asc_rows.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <utility>

#include "experiment/record/asc/asc_trial.h"
#include "experiment/record/asc/asc_words.h"

namespace overt {
namespace {

/// What a message says first, and when that was. A whole number before the word says by how many
/// milliseconds the message came too late; less than 0: it was sent beforehand.
struct SaidAt {
    std::string_view word;
    TrackerTime at;
};

SaidAt said_at(const GazeEvent& message) {
    Words words(message.text);
    std::string_view word = words.next();
    std::int64_t late_ms = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), late_ms);
    constexpr std::int64_t most_ms = 60'000;
    if (error == std::errc() && end == word.data() + word.size() && std::abs(late_ms) < most_ms)
        word = words.next();
    else
        late_ms = 0;
    return {word, message.start - std::chrono::milliseconds(late_ms)};
}

} // namespace

AscRows::AscRows(GazeRows& rows, int sitting, AscTrialCutter::By cut_by, TrialId trial_id,
                 std::function<void(const AscTrialTimes&)> trial_over)
    : rows_(rows), sitting_(sitting), cutter_(cut_by), trial_id_(std::move(trial_id)),
      trial_over_(std::move(trial_over)) {
    rows_.begin_trial(0);
}

void AscRows::begin_trial() {
    end();
    times_ = {};
    times_.trial = cutter_.trial();
    has_time_ = is_after_ = false;
    into_ = trial_id_(times_.trial);
    if (into_)
        rows_.begin_trial(*into_);
}

void AscRows::take_time(TrackerTime time) {
    if (!has_time_)
        times_.first = time;
    has_time_ = true;
}

/// What comes between a trial's result and the next trial is kept beside the trial.
void AscRows::follow_cutter(bool begins) {
    if (begins)
        begin_trial();
    if (cutter_.is_after_trial() && !std::exchange(is_after_, true) && into_)
        rows_.begin_trial(after_trial(*into_));
}

void AscRows::samples(std::span<const GazeSample> samples) {
    follow_cutter(cutter_.take_sample());
    take_time(samples.front().sampled_at);
    if (into_)
        for (const GazeSample& sample : samples)
            rows_.sample(sample);
}

void AscRows::event(const GazeEvent& event) {
    follow_cutter(cutter_.take(event));
    if (event.kind != GazeEvent::Kind::note)
        take_time(event.end);
    if (event.kind == GazeEvent::Kind::message && !is_after_) {
        if (is_trial_id(event))
            times_.first = event.start;
        const std::string_view text = event.text;
        const auto [word, at] = said_at(event);
        constexpr std::array words{task_screen_message, onset_message, end_message, response_screen_message,
                                   response_message};
        if (word == earlier_end_message)
            times_.screens.emplace(end_message, at);
        if (std::find(words.begin(), words.end(), word) != words.end())
            times_.screens.emplace(word, at);
        if (word == "SYNCTIME")
            times_.screens.emplace(onset_message, at);
        times_.is_aborted |= text == "TRIAL_RESULT aborted" || text == "TRIAL_RESULT open";
    }
    if (into_)
        rows_.event(event);
}

void AscRows::malformed(std::int64_t line, std::string_view why, std::string_view text) {
    rows_.line_left_out(sitting_, skipped_line_text(line, why, text));
}

void AscRows::end() {
    if (times_.trial >= 0 && trial_over_)
        trial_over_(times_);
    times_.trial = -1;
}

} // namespace overt
