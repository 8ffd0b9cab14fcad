#include "experiment/record/bids/bids_export.h"

#include <map>
#include <sstream>

#include <catch2/catch.hpp>

#include "tests/experiment/record/eye_session.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::testing;

namespace {

using Row = std::map<std::string, std::string>;

std::vector<Row> rows_of(const std::string& tsv) {
    std::vector<Row> rows;
    std::vector<std::string> names;
    std::istringstream text(tsv);
    for (std::string line; std::getline(text, line);) {
        std::vector<std::string> cells;
        std::istringstream in(line);
        for (std::string cell; std::getline(in, cell, '\t');)
            cells.push_back(cell);
        if (names.empty()) {
            names = cells;
            continue;
        }
        Row& row = rows.emplace_back();
        for (std::size_t i = 0; i < cells.size(); ++i)
            row[names.at(i)] = cells[i];
    }
    return rows;
}

/// How the frames of a row's stimulus were made, by the session's header.
std::string frames_of(const SessionHeader& header, const Row& row) {
    for (const RecordedStimulus& stimulus : header.stimuli) {
        const auto object = static_cast<std::size_t>(stimulus.stimulus.object),
                   material = static_cast<std::size_t>(stimulus.stimulus.material);
        if (header.objects[object].id == row.at("object") &&
            header.materials[material].id == row.at("material"))
            return stimulus.source;
    }
    return "n/a";
}

} // namespace

TEST_CASE(
    "events of BIDS have the onset and duration of what was on the screen, responses from their screen on",
    "[unit]") {
    const test::TemporaryFolder root;
    const std::filesystem::path session = make_eye_session(root.path() / "sessions", "AB7");
    export_bids(SessionRecord(session), [](const ViewedObject&) -> const SurfaceLookup* { return nullptr; },
                root.path() / "dataset", {});
    // Of each attempt, by the names of its rows: see outcome_at().
    std::map<std::pair<std::string, std::string>, std::map<std::string, Row>> attempts;
    for (const Row& row : rows_of(text_of(root.path() / "dataset" / "sub-AB7" / "ses-01" / "beh" /
                                          "sub-AB7_ses-01_task-tiny_run-01_events.tsv")))
        attempts[{row.at("trial"), row.at("attempt")}][row.at("trial_type")] = row;
    const SessionHeader header = SessionRecord(session).header();
    int responses = 0, presentations = 0, known = 0;
    for (auto& [attempt, rows] : attempts) {
        CAPTURE(attempt.first, attempt.second);
        const auto number = [&rows = rows](const char* row, const char* cell) {
            return std::stod(rows.at(row).at(cell));
        };
        if (!rows.contains("presentation"))
            continue;
        ++presentations;
        CHECK(number("presentation", "onset") == Approx(number("question", "onset") + 0.99));
        CHECK(number("presentation", "duration") == Approx(2.0));
        CHECK(rows["presentation"].at("response_time") == "n/a");
        CHECK(rows["presentation"].at("frames") == frames_of(header, rows["presentation"]));
        known += rows["presentation"].at("frames") != "n/a";
        if (!rows.contains("response"))
            continue;
        ++responses;
        CHECK(number("response", "onset") == Approx(number("presentation", "onset") + 2.01));
        CHECK(number("response", "duration") == Approx(0.99));
        CHECK(number("response", "response_time") == Approx(0.99));
        CHECK(number("trial", "duration") == Approx(4.0));
    }
    CHECK(known >= 1);
    CHECK(responses >= 2);
    CHECK(presentations > responses);
}
