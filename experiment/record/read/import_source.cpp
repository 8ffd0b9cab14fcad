#include "experiment/record/read/import_source.h"

#include <fmt/format.h>

namespace overt {

namespace {

constexpr std::string_view before_gaze = "gaze of ", before_trials = "; trials", of_program = " of ",
                           end_of_clause = ";";

/// "X" of "X; …".
std::string up_to_clause(std::string_view text) {
    return std::string(text.substr(0, text.find(end_of_clause)));
}

} // namespace

std::string import_source_text(const ImportSource& programs, std::string_view gaze_files,
                               std::string_view trial_files, bool has_log) {
    std::string text = fmt::format("{}{}{}", before_gaze, programs.gaze, gaze_files);
    if (has_log)
        text += fmt::format("{}{}{}{}", before_trials, programs.presenter.empty() ? "" : of_program,
                            programs.presenter, trial_files);
    return text;
}

std::optional<ImportSource> import_source(const SessionRecord& record) {
    std::optional<ImportSource> source;
    record.read_events([&](const RecordedEvent& event) {
        if (event.kind != gaze_imported_event || source || !event.detail.starts_with(before_gaze))
            return;
        const std::string_view text = event.detail;
        source.emplace();
        source->text = event.detail;
        source->gaze = up_to_clause(text.substr(before_gaze.size()));
        const std::size_t at = text.find(before_trials);
        if (at == std::string_view::npos) {
            source->presenter = source->gaze; // the table of gaze says what was shown
            return;
        }
        const std::string_view rest = text.substr(at + before_trials.size());
        if (rest.starts_with(of_program))
            source->presenter = up_to_clause(rest.substr(of_program.size()));
    });
    return source;
}

} // namespace overt
