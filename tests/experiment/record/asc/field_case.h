/// Recordings of other programs, places and options of edf2asc, imported and looked at.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/record/asc/asc_import.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/read/tracker_facts.h"
#include "tests/experiment/record/session_fixture.h"
#include "tests/support/asc_readers.h"
#include "tests/support/asc_text.h"

namespace overt::field_case {

using namespace overt::testing;

/// Imports recordings into a folder of its own.
struct ImportBench {
    test::TemporaryFolder root;
    AscSurveyOptions reading;
    AscImportSummary summary;
    int sessions = 0;

    std::filesystem::path file(const std::string& name, const std::string& text) {
        return write_asc(root.path() / name, text);
    }
    SessionRecord import(const AscFiles& files) {
        AscImportOptions options;
        options.place = {root.path(), "imported", "07"};
        options.out = root.path() / fmt::format("session_{}", ++sessions);
        options.screen_mm = glm::dvec2(400.0, 300.0);
        options.viewing_distance_mm = 600.0;
        options.reading = reading;
        summary = import_asc(files, options);
        return SessionRecord(summary.session);
    }
    SessionRecord import(const std::string& text) { return import(AscFiles(file("text.asc", text))); }
    SessionRecord field_case(const std::string& name) {
        return import(AscFiles(std::filesystem::path(OVERT_SOURCE_DIR) / "tests/data/asc" / (name + ".asc")));
    }
    std::string remarks() const { return fmt::format("{}", fmt::join(summary.remarks, "\n")); }
};

inline std::vector<GazeSample> samples_of(const SessionRecord& record) {
    std::vector<GazeSample> all;
    for (const TrialRecord& trial : record.trials())
        for (const GazeSample& sample : record.samples(trial))
            all.push_back(sample);
    return all;
}

inline std::vector<GazeEvent> events_of_kind(const SessionRecord& record, GazeEvent::Kind kind) {
    std::vector<GazeEvent> all;
    for (const TrialRecord& trial : record.trials())
        record.read_gaze_events(trial, [&](const GazeEvent& event) {
            if (event.kind == kind)
                all.push_back(event);
        });
    return all;
}

inline std::int64_t lost_of(const std::vector<GazeSample>& samples) {
    return std::ranges::count_if(samples, [](const GazeSample& sample) { return !sample.gaze; });
}

inline void check_same(const std::vector<GazeSample>& a, const std::vector<GazeSample>& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        REQUIRE(a[i].sampled_at == b[i].sampled_at);
        REQUIRE(a[i].eye == b[i].eye);
        REQUIRE(a[i].gaze == b[i].gaze);
        REQUIRE(a[i].pupil_area == b[i].pupil_area);
    }
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

/// Samples at these places, 500 Hz, from 1000 ms on, in a recording of the right eye, with pupils.
inline std::string made_recording(const std::vector<std::array<double, 3>>& values,
                                  const std::string& kind = "GAZE") {
    std::string text = "** VERSION: EYELINK II 1\nMSG\t990 GAZE_COORDS 0.00 0.00 1279.00 1023.00\n"
                       "START\t1000 \tRIGHT\tSAMPLES\tEVENTS\nPUPIL\tAREA\n"
                       "EVENTS\tGAZE\tRIGHT\tRATE\t 500.00\tTRACKING\tCR\nSAMPLES\t" +
                       kind + "\tRIGHT\tRATE\t 500.00\tTRACKING\tCR\n";
    int ms = 1000;
    for (const auto& [x, y, pupil] : values) {
        text += fmt::format("{}\t{:7.1f}\t{:7.1f}\t{:7.1f}\t...\n", ms, x, y, pupil);
        ms += 2;
    }
    return text + fmt::format("END\t{} \tSAMPLES\tEVENTS\tRES\t  35.00\t  36.00\n", ms);
}

} // namespace overt::field_case
