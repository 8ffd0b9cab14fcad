#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/record/foreign/logged_trials.h"

namespace overt {
namespace {

/// Columns whose names end so.
std::vector<std::string> columns_ending(const ForeignTable& table, std::string_view ending) {
    std::vector<std::string> found;
    for (const std::string& column : table.columns())
        if (column.size() > ending.size() && column.ends_with(ending))
            found.push_back(column);
    return found;
}

void require_one_onset(const ForeignTable& table, const std::vector<std::string>& onsets,
                       std::string_view program) {
    if (onsets.size() != 1)
        throw InputError(fmt::format(
            "{}: of this log of {} nobody can tell which column has the stimulus' onset: say it, "
            "--trial-columns onset=NAME; {}",
            table.file().string(), program,
            onsets.empty() ? "there is none by name" : fmt::format("there are {}", fmt::join(onsets, ", "))));
}

TrialColumns psychopy_columns(const ForeignTable& table, const TrialColumns& given) {
    TrialColumns columns;
    columns.program = "PsychoPy";
    columns.unit = "s";
    columns.onset = given.onset;
    if (columns.onset.empty()) {
        std::vector<std::string> onsets;
        for (const std::string& column : columns_ending(table, ".started")) {
            const std::string stem = column.substr(0, column.size() - 8);
            // Keyboards and routines have such times, too.
            if (!table.has(stem + ".keys") && !table.has(stem + ".rt") && !table.has(stem + ".response"))
                onsets.push_back(column);
        }
        require_one_onset(table, onsets, columns.program);
        columns.onset = onsets.front();
    }
    const std::string stem = columns.onset.substr(0, columns.onset.rfind('.'));
    if (table.has(stem + ".stopped"))
        columns.end = stem + ".stopped";
    const auto only_one = [&](std::string_view ending) {
        const std::vector<std::string> found = columns_ending(table, ending);
        return found.size() == 1 ? found.front() : std::string();
    };
    columns.answer = only_one(".keys");
    columns.response_time = only_one(".rt");
    return columns;
}

TrialColumns opensesame_columns(const ForeignTable& table, const TrialColumns& given) {
    TrialColumns columns;
    columns.program = "OpenSesame";
    columns.unit = "ms";
    columns.onset = given.onset;
    if (columns.onset.empty()) {
        std::vector<std::string> onsets;
        for (const std::string& column : table.columns())
            if (column.starts_with("time_"))
                onsets.push_back(column);
        require_one_onset(table, onsets, columns.program);
        columns.onset = onsets.front();
    }
    if (table.has("response"))
        columns.answer = "response";
    if (table.has("response_time"))
        columns.response_time = "response_time";
    if (table.has("correct_response"))
        columns.correct = "correct_response";
    return columns;
}

TrialColumns bids_event_columns(const ForeignTable& table) {
    TrialColumns columns;
    columns.program = "BIDS";
    columns.onset = "onset";
    columns.duration = "duration";
    columns.unit = "s";
    columns.from_first_sample = true;
    if (table.has("response_time"))
        columns.response_time = "response_time";
    if (table.has("answer"))
        columns.answer = "answer";
    if (table.has("tracker_onset")) { // of overt's own export, whose trials have several rows
        columns.onset = "tracker_onset";
        columns.unit = "us";
        columns.from_first_sample = false;
        columns.only_column = "trial_type";
        columns.only_word = "presentation";
        columns.key = "trial";
    }
    return columns;
}

void lay_over(TrialColumns& columns, const TrialColumns& given) {
    for (const auto member :
         {&TrialColumns::onset, &TrialColumns::end, &TrialColumns::duration, &TrialColumns::unit,
          &TrialColumns::marker, &TrialColumns::marker_time, &TrialColumns::marker_text,
          &TrialColumns::answer, &TrialColumns::response_time, &TrialColumns::correct, &TrialColumns::key,
          &TrialColumns::only_column, &TrialColumns::only_word})
        if (!(given.*member).empty())
            columns.*member = given.*member;
    if (!given.marker_text.empty())
        columns.marker.clear(); // in place of a column of that name
    for (const auto& [factor, column] : given.words)
        columns.words[factor] = column;
}

} // namespace

double ns_of_unit(const std::string& unit, std::string_view option) {
    if (unit.empty() || unit == "s")
        return 1e9;
    if (unit == "ms")
        return 1e6;
    if (unit == "us")
        return 1e3;
    if (unit == "ns")
        return 1.0;
    throw InputError(fmt::format("{} unit={}: s, ms, us and ns are understood", option, unit));
}

TrialColumns trial_columns_of(const std::vector<std::string>& words) {
    TrialColumns columns;
    for (const auto& [key, value] : column_words(words, {}, "--trial-columns")) {
        if (key == "onset")
            columns.onset = value;
        else if (key == "end")
            columns.end = value;
        else if (key == "duration")
            columns.duration = value;
        else if (key == "unit")
            columns.unit = value;
        else if (key == "marker")
            columns.marker = value;
        else if (key == "marker_time")
            columns.marker_time = value;
        else if (key == "marker_text")
            columns.marker_text = value;
        else if (key == "answer")
            columns.answer = value;
        else if (key == "response_time")
            columns.response_time = value;
        else if (key == "correct")
            columns.correct = value;
        else if (key == "key")
            columns.key = value;
        else if (key == "only") {
            const std::size_t colon = value.find(':');
            if (colon == std::string::npos)
                throw InputError(fmt::format("--trial-columns only={}: is no COLUMN:WORD", value));
            columns.only_column = value.substr(0, colon);
            columns.only_word = value.substr(colon + 1);
        } else
            columns.words[key] = value;
    }
    ns_of_unit(columns.unit, "--trial-columns");
    if (!columns.marker.empty() && !columns.marker_text.empty())
        throw InputError(
            "--trial-columns: marker names a column of markers, marker_text one that is the same "
            "for all trials: give one of them");
    return columns;
}

TrialColumns known_trial_columns(const std::filesystem::path& file, const TrialColumns& given) {
    const ForeignTable table(file);
    TrialColumns columns;
    if (table.has("tracker_onset") ||
        (file.filename().string().ends_with("_events.tsv") && table.has("onset")))
        columns = bids_event_columns(table);
    else if (table.has("psychopyVersion") || table.has("frameRate"))
        columns = psychopy_columns(table, given);
    else if (table.has("subject_nr") || table.has("opensesame_version"))
        columns = opensesame_columns(table, given);
    else {
        if (table.has("onset"))
            columns.onset = "onset";
        for (const auto& [name, member] : {std::pair{"end", &TrialColumns::end},
                                           {"duration", &TrialColumns::duration},
                                           {"marker", &TrialColumns::marker},
                                           {"answer", &TrialColumns::answer},
                                           {"response_time", &TrialColumns::response_time},
                                           {"correct", &TrialColumns::correct},
                                           {"trial", &TrialColumns::key}})
            if (table.has(name))
                columns.*member = name;
    }
    lay_over(columns, given);
    if (columns.onset.empty())
        require_one_onset(table, {}, "trials");
    return columns;
}

} // namespace overt
