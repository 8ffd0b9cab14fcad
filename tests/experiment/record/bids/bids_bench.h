/// A dataset of one session or more, and what its files hold.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "experiment/base/output_file.h"
#include "experiment/record/bids/bids_export.h"
#include "tests/experiment/record/eye_session.h"
#include "tests/support/bids_rules.h"

namespace overt::bids_bench {

using namespace overt::testing;

inline const SurfaceLookup* without_surface(const ViewedObject&) { return nullptr; }

struct Dataset {
    test::TemporaryFolder root;
    std::filesystem::path path = root.path() / "dataset";
    BidsExportCounts counts;

    Dataset() { counts = add("AB7"); }
    BidsExportCounts add(const std::string& observer, bool overwrite = false) {
        const std::filesystem::path sessions = root.path() / "sessions";
        const std::filesystem::path session =
            std::filesystem::exists(sessions / "tiny" / ("sub-" + observer + "_ses-01"))
                ? sessions / "tiny" / ("sub-" + observer + "_ses-01")
                : make_eye_session(sessions, observer);
        return export_bids(SessionRecord(session), without_surface, path, {overwrite, false, {}});
    }
    std::filesystem::path beh(const std::string& file) const {
        return path / "sub-AB7" / "ses-01" / "beh" / file;
    }
    nlohmann::json json(const std::filesystem::path& file) const {
        return nlohmann::json::parse(bytes_of(file));
    }
};

inline const std::string physio = "sub-AB7_ses-01_task-tiny_run-01_recording-eye1_physio";
inline const std::string gaze_events = "sub-AB7_ses-01_task-tiny_run-01_recording-eye1_physioevents";
inline const std::string events_file = "sub-AB7_ses-01_task-tiny_run-01_events";

inline void write_text(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

inline void write_packed(const std::filesystem::path& file, const std::string& text, bool with_name = false) {
    if (with_name) {
        const gzFile stream = gzopen(file.c_str(), "wb");
        gzwrite(stream, text.data(), static_cast<unsigned>(text.size()));
        gzclose(stream);
        std::string bytes = bytes_of(file);
        bytes[4] = 1;
        write_text(file, bytes);
        return;
    }
    std::filesystem::remove(file);
    OutputFile out(file, Packing::gzip);
    out.text() = text;
    out.close();
}

inline std::string with_replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

inline std::map<std::string, std::string> content_of(const std::filesystem::path& folder) {
    std::map<std::string, std::string> content;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            content[std::filesystem::relative(entry.path(), folder).string()] = bytes_of(entry.path());
    return content;
}

} // namespace overt::bids_bench
