/// What is done with any bytes as a protocol, as an EyeLink recording and as a session file: shared by the
/// fuzzers and by the test that replays their corpus. None of these may do anything but return: what is wrong
/// with the bytes is told by findings, reports, or an overt::Error.
#pragma once

#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "experiment/base/error.h"
#include "experiment/base/scratch_folder.h"
#include "experiment/checks/checked_protocol.h"
#include "experiment/record/asc/asc_export.h"
#include "experiment/record/asc/asc_import.h"
#include "experiment/record/bids/bids_export.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/read/timing_report.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/tables/table_export.h"
#include "experiment/record/verify/verification.h"

namespace overt::fuzz {

inline void take_protocol(std::string_view bytes) {
    Diagnostics diagnostics;
    const std::string_view shipped[] = {"muse", "runner"};
    read_protocol_text(bytes, "fuzz.toml", shipped, diagnostics);
    diagnostics.quote_from("fuzz.toml", bytes);
    diagnostics.print();
    diagnostics.to_json().dump();
}

inline std::filesystem::path put(const ScratchFolder& folder, const char* name, std::string_view bytes) {
    std::filesystem::path file = folder.path() / name;
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return file;
}

inline const SurfaceLookup* no_surface(const ViewedObject&) { return nullptr; }

/// An import, and what any session must stand: all of its exports.
inline void export_all(const std::filesystem::path& session, const std::filesystem::path& to) {
    const auto attempt = [](const auto& work) {
        try {
            work();
        } catch (const Error&) {
        }
    };
    const SessionRecord record(session);
    attempt([&] { record.damages(); });
    attempt([&] { record.last_time(); });
    attempt([&] { timing_report(record); });
    attempt([&] { export_tables(record, no_surface, to / "tsv"); });
    attempt([&] { export_asc(record, to / "asc"); });
    attempt([&] { export_bids(record, no_surface, to / "bids"); });
}

/// How far an input goes. Each further step takes ten times as long, so a fuzzer takes few of them on, by the
/// input's own bytes; a replay takes all.
enum class Depth { by_content, full };

inline void take_asc(std::string_view bytes, Depth depth = Depth::full) {
    const ScratchFolder folder("overt-fuzz");
    const std::size_t lot = depth == Depth::full ? 0 : std::hash<std::string_view>()(bytes);
    AscImportOptions options;
    options.place = {folder.path(), "fuzz", "1"};
    options.out = folder.path() / "session";
    options.screen_mm = glm::dvec2(400.0, 300.0);
    options.viewing_distance_mm = 600.0;
    options.reading.report = [](const std::string&) {};
    try {
        const std::filesystem::path file = put(folder, "fuzz.asc", bytes);
        survey_asc(file, options.reading);
        if (lot % 8 != 0)
            return;
        const AscImportSummary summary = import_asc(file, options);
        if (lot % 64 == 0)
            export_all(summary.session, folder.path());
    } catch (const Error&) {
    }
}

inline void take_session(std::string_view bytes) {
    const ScratchFolder folder("overt-fuzz");
    try {
        put(folder, session_file_name, bytes);
        verify_session(folder.path());
        export_all(folder.path(), folder.path() / "out");
    } catch (const Error&) {
    }
}

} // namespace overt::fuzz
