#include <algorithm>
#include <filesystem>
#include <map>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/cli/command_options.h"
#include "app/cli/event_options.h"
#include "app/cli/interruption.h"
#include "app/cli/progress_bar.h"
#include "app/inputs/session_folders.h"
#include "app/record/export_formats.h"
#include "app/record/record_commands.h"
#include "app/record/sound_sessions.h"
#include "experiment/base/error.h"
#include "experiment/record/session_schema.h"

namespace overt {

namespace {

struct ExportOptions {
    std::vector<std::filesystem::path> sessions;
    std::string format = "tsv"; ///< by its name
    std::filesystem::path out;
    bool overwrite = false;
    EventOptions events;

    struct Format {
        const ExportFormatEntry* entry;
        std::shared_ptr<ExportFormat> format;
    };
    std::map<std::string, Format> formats; ///< by name; names of one entry share its options
};

/// With no dots and no separator at its end; the session file itself may be named.
std::filesystem::path folder_at(const std::filesystem::path& session) {
    const std::filesystem::path path = std::filesystem::absolute(session).lexically_normal();
    return path.has_filename() && path.filename() != session_file_name ? path : path.parent_path();
}

/// The folder that all sessions lie in.
std::filesystem::path common_folder(std::span<const std::filesystem::path> sessions) {
    std::filesystem::path common = folder_at(sessions.front()).parent_path();
    for (const std::filesystem::path& session : sessions) {
        const std::filesystem::path folder = folder_at(session);
        while (*folder.lexically_relative(common).begin() == "..")
            common = common.parent_path();
    }
    return common;
}

/// Where one of the sessions goes.
std::filesystem::path folder_of(const ExportOptions& options, const ExportFormatEntry& format,
                                const std::filesystem::path& session) {
    const std::filesystem::path folder = folder_at(session);
    if (options.out.empty())
        return folder / ("export_" + options.format);
    if (options.sessions.size() == 1 || format.joins_sessions)
        return options.out;
    // Observers of several protocols, and recordings that were imported, have folders of the same names.
    const bool has_namesakes = std::ranges::any_of(options.sessions, [&](const auto& other) {
        return folder_at(other).filename() == folder.filename() && folder_at(other) != folder;
    });
    return options.out /
           (has_namesakes ? folder.lexically_relative(common_folder(options.sessions)) : folder.filename());
}

/// That each session's folder is free, before the first is written. Throws InputError that names all that
/// are not.
void need_free_folders(const ExportOptions& options, const ExportFormatEntry& format) {
    if (options.overwrite || format.joins_sessions)
        return;
    std::vector<std::string> taken;
    for (const std::filesystem::path& session : options.sessions)
        if (const std::filesystem::path folder = folder_of(options, format, session);
            std::filesystem::exists(folder))
            taken.push_back(folder.string());
    // Of one alone the export itself says so.
    if (!taken.empty() && options.sessions.size() > 1)
        throw InputError(
            fmt::format("{}: {} already, and nothing was exported. Name another folder with --out, "
                        "or replace what is there with --overwrite.",
                        fmt::join(taken, ", "), taken.size() == 1 ? "exists" : "exist"));
}

/// That events can be found in all that is exported. Throws InputError.
void need_angles(const SessionRecord& record) {
    for (const TrialRecord& trial : record.trials())
        if (const SessionRecord::EventOrigin origin = record.event_origin(trial.sitting);
            origin.from == SessionRecord::EventOrigin::From::no_angles)
            throw InputError(
                fmt::format("{}: {}", folder_at(record.directory()).string(), sentence_on(origin)));
}

int run_export(const ExportOptions& given) {
    const Interruption interruption;
    ExportOptions options = given;
    options.sessions = sessions_in(given.sessions);
    const auto& [entry, format] = options.formats.at(options.format);
    need_free_folders(options, *entry);
    say_broken_seals(options.sessions);
    for (const std::filesystem::path& session : options.sessions) {
        SessionRecord record(session);
        if (const auto thresholds = options.events.detection()) {
            record.detect_events(*thresholds);
            need_angles(record);
        }
        if (!record.closed_in_order())
            fmt::print(
                stderr,
                "{}: this session is running, or was interrupted: what it has so far is exported. `overt "
                "verify` tells which.\n",
                folder_at(record.directory()).string());
        ProgressBar bar;
        const std::string title = "exporting " + folder_at(record.directory()).filename().string();
        const std::string said = format->write({record, options.format, folder_of(options, *entry, session),
                                                options.overwrite, [&](int done, int all) {
                                                    bar.update(title, done, all);
                                                    Interruption::check("The export");
                                                }});
        bar.finish();
        fmt::print("{}", said);
    }
    if (options.sessions.size() > 1 && !options.out.empty() && !entry->joins_sessions)
        fmt::print("{}", format->write_pooled(options.format, options.sessions, options.out));
    return 0;
}

} // namespace

void add_export(CLI::App& app, ChosenCommand& chosen) {
    const auto [command, options] =
        add_command(app, chosen, run_export, "export", "Writes sessions as tables or files for other tools",
                    "overt export sessions/overt_2019/sub-07_ses-01 --format tsv --out tables\n"
                    "  overt export sessions/overt_2019/* --format bids --out dataset\n"
                    "  overt export sessions/overt_2019/sub-07_ses-01 --format asc --out asc");
    command.add_option("SESSION", options.sessions, sessions_help)->required();
    std::vector<std::string> names, explained, joining;
    std::vector<std::shared_ptr<ExportFormat>> formats;
    for (const ExportFormatEntry& entry : export_formats()) {
        formats.push_back(entry.make());
        explained.push_back(fmt::format("{}: {}", fmt::join(entry.names, ", "), entry.help));
        for (const std::string& name : entry.names) {
            names.push_back(name);
            options.formats[name] = {&entry, formats.back()};
            if (entry.joins_sessions)
                joining.push_back("--format " + name);
        }
    }
    option(command, "--format", options.format, "", fmt::format("{}", fmt::join(explained, "; ")),
           one_of(names), shown_default);
    option(command, "--out", options.out, "DIR",
           fmt::format("Folder to write to (default: export_FORMAT in the session; for several "
                       "sessions a folder each is made in it, but one dataset of all with {})",
                       fmt::join(joining, " and ")));
    for (const auto& format : formats)
        format->add_options(command);
    add_event_options(
        command, options.events,
        "Find fixations, saccades and blinks anew in the samples, in place of those on record, which stay "
        "there; recordings that were imported without any have them found only so");
    command.add_flag("--overwrite", options.overwrite, "Replace an export that is there");
}

} // namespace overt
