#include "experiment/record/foreign/logged_trials.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

LogTime log_time(double number, double ns) { return LogTime(std::llround(number * ns)); }

std::string text_of_cell(std::string_view cell) {
    return is_missing_cell(cell) ? std::string() : std::string(cell);
}

} // namespace

TrialLog read_trial_log(const std::filesystem::path& file, const TrialColumns& columns,
                        const std::vector<std::string>& factors, const std::optional<GazeSurvey>& gaze) {
    ForeignTable table(file);
    const double ns = ns_of_unit(columns.unit, "--trial-columns");
    // Durations and response times of BIDS are seconds, whatever its onsets are.
    const double ns_of_durations = columns.program == "BIDS" ? 1e9 : ns;
    const auto at = [&](const std::string& name, std::string_view what) {
        return table.require_named(name, what);
    };
    const std::size_t onset = table.require(columns.onset, "the onset");
    const auto end = at(columns.end, "the end"), duration = at(columns.duration, "the duration"),
               marker = at(columns.marker, "the marker"),
               marker_time = at(columns.marker_time, "the marker's time"),
               answer = at(columns.answer, "the answer"),
               response_time = at(columns.response_time, "the response time"),
               correct = at(columns.correct, "the correct answer"), key = at(columns.key, "the trial"),
               only = at(columns.only_column, "the rows of trials");
    std::map<std::string, std::size_t> words;
    for (std::size_t i = 0; i < table.columns().size(); ++i) {
        const std::string& name = table.columns()[i];
        const std::string factor =
            name.substr(name.rfind('.') == std::string::npos ? 0 : name.rfind('.') + 1);
        if (std::ranges::find(factors, factor) != factors.end() || name == "stimulus")
            words.emplace(name, i);
    }
    for (const auto& [factor, column] : columns.words)
        words[factor] = table.require(column, factor);

    TrialLog log;
    log.program = columns.program;
    if (columns.from_first_sample && gaze)
        log.zero = gaze->first - TrackerClock::duration(std::llround(1e6 * gaze->columns.start_s));
    std::map<std::string, std::size_t> trial_of_key;
    std::map<std::string, std::pair<std::string, std::optional<LogTime>>>
        answers; // of rows beside those of trials
    const auto number_or_throw = [&](std::optional<std::size_t> column,
                                     double unit_ns) -> std::optional<LogTime> {
        const std::string_view cell = table.cell(column);
        if (is_missing_cell(cell))
            return std::nullopt;
        // PsychoPy writes all keys of a trial as a list: "[0.512]".
        std::string_view text = cell;
        if (text.starts_with('[') && text.ends_with(']'))
            text = text.substr(1, text.find_first_of(",]") - 1);
        if (const std::optional<double> number = number_in_cell(text))
            return log_time(*number, unit_ns);
        throw InputError(
            fmt::format("{}: {} is \"{}\", and no number", table.place(), table.columns()[*column], cell));
    };
    while (table.next()) {
        if (marker && !is_missing_cell(table.cell(*marker)))
            if (const auto sent = number_or_throw(marker_time ? marker_time : std::optional(onset), ns))
                log.markers.push_back({table.place(), std::string(table.cell(*marker)), *sent});
        const bool is_trial = !only || table.cell(*only) == columns.only_word;
        const std::optional<LogTime> begin = is_trial ? number_or_throw(onset, ns) : std::nullopt;
        if (!begin) { // instructions, breaks, rows of answers
            if (key && !is_missing_cell(table.cell(*key))) {
                auto& [text, time] = answers[std::string(table.cell(*key))];
                if (const std::string given = text_of_cell(table.cell(answer)); !given.empty())
                    text = given;
                if (response_time && !time)
                    time = number_or_throw(response_time, ns_of_durations);
            }
            continue;
        }
        if (!columns.marker_text.empty())
            log.markers.push_back({table.place(), columns.marker_text,
                                   marker_time ? number_or_throw(marker_time, ns).value_or(*begin) : *begin});
        LoggedTrial trial;
        trial.place = table.place();
        trial.onset = *begin;
        trial.end = end ? number_or_throw(end, ns) : std::nullopt;
        if (!trial.end && duration)
            if (const auto lasts = number_or_throw(duration, ns_of_durations); lasts && lasts->count() > 0)
                trial.end = *begin + *lasts;
        if (trial.end && *trial.end <= trial.onset)
            throw InputError(fmt::format("{}: the trial ends before it begins", table.place()));
        trial.key = text_of_cell(table.cell(key));
        trial.answer = text_of_cell(table.cell(answer));
        trial.correct = text_of_cell(table.cell(correct));
        trial.response_time = response_time ? number_or_throw(response_time, ns_of_durations) : std::nullopt;
        for (const auto& [factor, column] : words)
            if (std::string word = text_of_cell(table.cell(column)); !word.empty())
                trial.words[factor] = std::move(word);
        log.trials.push_back(std::move(trial));
    }
    for (LoggedTrial& trial : log.trials)
        if (const auto found = answers.find(trial.key); !trial.key.empty() && found != answers.end()) {
            if (trial.answer.empty())
                trial.answer = found->second.first;
            if (!trial.response_time)
                trial.response_time = found->second.second;
        }
    if (log.trials.empty())
        throw InputError(fmt::format("{}: no row has an onset in {}", file.string(), columns.onset));
    std::ranges::stable_sort(log.trials, {}, &LoggedTrial::onset);
    return log;
}

TrialLog trials_in_gaze(const GazeSurvey& gaze, const std::filesystem::path& file) {
    TrialLog log;
    log.program = gaze.columns.program;
    for (const GazeMark& mark : gaze.marks) {
        if (!mark.is_trial)
            continue;
        const LogTime at = mark.at.time_since_epoch();
        if (!log.trials.empty() && !log.trials.back().end)
            log.trials.back().end = at;
        if (!mark.text.empty()) {
            LoggedTrial trial;
            trial.place = fmt::format("{}, at {} us", file.string(), mark.at.time_since_epoch().count());
            trial.onset = at;
            trial.words["stimulus"] = mark.text;
            log.trials.push_back(std::move(trial));
        }
    }
    if (!log.trials.empty() && !log.trials.back().end)
        log.trials.back().end = gaze.last.time_since_epoch();
    if (log.trials.empty())
        throw InputError(fmt::format(
            "{}: nothing says which trials there were and what they showed: give their log, --trial-log "
            "FILE, or name the column that says it, --columns …,trial=NAME",
            file.string()));
    return log;
}

std::vector<LoggedFrame> read_frame_log(const std::filesystem::path& file,
                                        const std::vector<std::string>& words) {
    ForeignTable table(file);
    std::string time = "time", unit, frame, angle, key;
    for (const auto& [word, value] :
         column_words(words, {"time", "unit", "frame", "angle", "key"}, "--frame-columns"))
        (word == "time"    ? time
         : word == "unit"  ? unit
         : word == "frame" ? frame
         : word == "angle" ? angle
                           : key) = value;
    if (frame.empty() && table.has("frame") && angle.empty())
        frame = "frame";
    if (angle.empty() && frame.empty() && table.has("angle_deg"))
        angle = "angle_deg";
    if (key.empty() && table.has("trial"))
        key = "trial";
    if (frame.empty() == angle.empty())
        throw InputError(
            fmt::format("{}: a log of frames has either frame (from 0) or angle (degrees): name one, "
                        "--frame-columns frame=NAME",
                        file.string()));
    const double ns = ns_of_unit(unit, "--frame-columns");
    const std::size_t time_at = table.require(time, "the time"),
                      what_at = table.require(frame.empty() ? angle : frame, "the frame");
    const std::optional<std::size_t> key_at = table.require_named(key, "the trial");
    std::vector<LoggedFrame> frames;
    while (table.next()) {
        const std::optional<double> at = number_in_cell(table.cell(time_at)),
                                    what = number_in_cell(table.cell(what_at));
        if (is_missing_cell(table.cell(what_at)))
            continue; // nothing was shown
        if (!at || !what || (angle.empty() && (*what < 0 || *what != std::floor(*what))))
            throw InputError(
                fmt::format("{}: {} \"{}\", {} \"{}\": a time and {} are wanted", table.place(), time,
                            table.cell(time_at), table.columns()[what_at], table.cell(what_at),
                            angle.empty() ? "the number of a frame, from 0," : "an angle in degrees"));
        LoggedFrame row{table.place(), text_of_cell(table.cell(key_at)), log_time(*at, ns), {}, {}};
        if (angle.empty())
            row.frame = static_cast<int>(*what);
        else
            row.angle_deg = *what;
        if (!frames.empty() && row.at < frames.back().at)
            throw InputError(fmt::format("{}: its time goes back: sort the rows by {}", table.place(), time));
        frames.push_back(std::move(row));
    }
    return frames;
}

} // namespace overt
