#include "experiment/checks/checked_protocol.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fmt/format.h>

#include "experiment/base/whole_file.h"
#include "experiment/checks/protocol_checks.h"
#include "experiment/protocol/files/protocol_reader.h"
#include "experiment/protocol/files/written_series.h"

namespace overt {

namespace {

void require_lists(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    if (protocol.tasks.empty())
        examination.error({"task"}, "there is no [[task]]", "add [[task]] with id and question");
    if (protocol.objects.empty())
        examination.error({"object"}, "there is no [[object]]", "add [[object]] with id and shipped or mesh");
    if (protocol.materials.empty())
        examination.error({"material"}, "there is no [[material]]", "add [[material]] with id and kind");
}

/// Errors in tables of trials, which say nothing of the protocol itself.
int errors_in_tables(const Protocol& protocol, const Diagnostics& diagnostics) {
    int errors = 0;
    for (const Finding& finding : diagnostics.findings())
        errors += finding.severity == Severity::error &&
                  std::ranges::find(protocol.trial_tables, finding.file, &TrialTable::file) !=
                      protocol.trial_tables.end();
    return errors;
}

std::optional<Protocol> read_text(std::string_view text, const std::filesystem::path& file,
                                  std::span<const std::string_view> shipped_sculptures, bool look_at_files,
                                  const IncludeReader& reader, Diagnostics& diagnostics) {
    const int errors_before = diagnostics.error_count();
    Protocol protocol;
    protocol.file = file;
    ProtocolExamination examination(protocol, diagnostics);
    if (read_written_keys(examination, text, reader)) {
        require_lists(examination);
        take_characterisation(examination, look_at_files);
        check_image_fits(examination);
        check_sizes(examination);
        check_output(examination);
        check_stereo(examination);
        check_motions(examination);
        check_motion_kinds(examination);
        check_screens(examination);
        check_ids(examination);
        check_blocks(examination);
        check_groups(examination);
        check_practice(examination);
        check_simulated_effects(examination);
        check_breaks(examination);
        check_sitting(examination);
        check_devices(examination);
        check_objects(examination, shipped_sculptures);
        check_materials(examination);
        check_lights(examination);
        check_backgrounds(examination);
        check_frames(examination);
        check_steps(examination);
        check_answers(examination);
        check_matches(examination);
        check_turning(examination);
        check_recorded_motions(examination);
        check_slots(examination);
        check_points(examination);
        if (diagnostics.error_count() == errors_before + errors_in_tables(protocol, diagnostics))
            check_trials(examination);
        check_procedures(examination);
        check_bake(examination);
        if (look_at_files)
            check_files(examination);
        if (diagnostics.error_count() == errors_before)
            check_points_on_objects(examination);
        if (diagnostics.error_count() == errors_before)
            check_match_levels(examination);
        if (diagnostics.error_count() == errors_before)
            check_slot_memory(examination);
        if (diagnostics.error_count() == errors_before)
            check_schedule(examination);
        if (diagnostics.error_count() == errors_before)
            check_yoked_trials(examination);
    }
    if (diagnostics.error_count() > errors_before)
        return std::nullopt;
    return protocol;
}

/// The whole of a file, or nothing with the reason.
std::optional<std::string> text_of(const std::filesystem::path& file, std::string& why_not) {
    // Far more than anyone writes by hand: someone gave a mesh or a picture for the protocol. Tables are made
    // by programs, and one of how objects were turned has a row for each change.
    const bool is_table = file.extension() == ".tsv" || file.extension() == ".csv";
    const std::size_t largest_mib = is_table ? 16 : 1, largest_bytes = largest_mib << 20;
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) {
        why_not = "this is a folder, not a protocol file";
        return std::nullopt;
    }
    int error = 0;
    std::optional<std::string> text = read_whole_file(file, largest_bytes, error);
    if (!text)
        why_not = error == EFBIG && is_table ? fmt::format("larger than {} MiB", largest_mib)
                  : error == EFBIG           ? "larger than 1 MiB: this is no protocol file"
                                             : fmt::format("cannot be read: {}", std::strerror(error));
    return text;
}

/// The names of the files that a pattern stands for, one a line, in their order; or nothing with the reason.
std::optional<std::string> names_that_fit(const std::filesystem::path& pattern, std::string& why_not) {
    std::vector<std::string> names;
    std::error_code error;
    const std::filesystem::path folder = pattern.parent_path().empty() ? "." : pattern.parent_path();
    for (auto entry = std::filesystem::directory_iterator(folder, error);
         !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (!name.starts_with('.') && fits_pattern(name, pattern.filename().string()) &&
            entry->is_regular_file(error))
            names.push_back(name);
    }
    if (error)
        why_not = fmt::format("the folder cannot be read: {}", error.message());
    else if (names.empty())
        why_not = "no file has such a name";
    if (error || names.empty())
        return std::nullopt;
    std::ranges::sort(names);
    std::string lines;
    for (const std::string& name : names)
        lines += name + "\n";
    return lines;
}

/// What is read beside a protocol: a text, or the names that a pattern stands for.
std::optional<std::string> text_or_names(const std::filesystem::path& file, std::string& why_not) {
    return is_pattern(file) ? names_that_fit(file, why_not) : text_of(file, why_not);
}

} // namespace

std::optional<Protocol> read_protocol(const std::filesystem::path& file,
                                      std::span<const std::string_view> shipped_sculptures,
                                      Diagnostics& diagnostics) {
    std::string why_not;
    const std::optional<std::string> text = text_of(file, why_not);
    if (!text) {
        diagnostics.error(file.string(), {}, why_not);
        return std::nullopt;
    }
    return read_text(*text, file, shipped_sculptures, true, text_or_names, diagnostics);
}

std::optional<Protocol> read_protocol_text(std::string_view text, const std::filesystem::path& file,
                                           std::span<const std::string_view> shipped_sculptures,
                                           Diagnostics& diagnostics, const IncludedTexts& included,
                                           FilesNamed files) {
    const IncludeReader from_record = [&](const std::filesystem::path& wanted,
                                          std::string& why_not) -> std::optional<std::string> {
        const auto known = included.find(wanted.lexically_proximate(file.parent_path()).string());
        if (known != included.end())
            return known->second;
        why_not = "it is not among the texts that are kept";
        return std::nullopt;
    };
    return read_text(text, file, shipped_sculptures, files == FilesNamed::looked_up, from_record,
                     diagnostics);
}

} // namespace overt
