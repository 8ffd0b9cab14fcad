/// A session of two completed trials and an open one, its surface, and the rows of the tables made of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "experiment/record/session_schema.h"
#include "experiment/record/tables/export_tables.h"
#include "tests/experiment/record/session_fixture.h"

namespace overt::testing {

namespace fs = std::filesystem;

/// A surface on the left half of the image: every coordinate of the answer tells what was asked.
class LeftHalf final : public SurfaceLookup {
  public:
    bool goes_on(PoseIndex, glm::ivec2 pixel, glm::ivec2 next) const override {
        return pixel.x < 256 && next.x < 256;
    }
    std::optional<SurfacePoint> surface_at(PoseIndex pose, glm::dvec2 point) const override {
        if (point.x >= 256.0)
            return std::nullopt;
        SurfacePoint surface;
        surface.position = {point.x, -point.y, static_cast<double>(pose.value)};
        surface.triangle = 41;
        surface.part = 1;
        surface.depth = 200.25;
        surface.incidence = Degrees{12.34567};
        return surface;
    }
};

constexpr std::int64_t tracker_offset_us = 7'000'000'000;

/// One presentation of 252 refreshes at 100 Hz with 20 samples in each, the gaze going round. Before some
/// refreshes one is missed.
inline void record_trial(SessionStore& store, const PageCycle& plan, const Trial& trial,
                         const std::vector<int>& missed) {
    const SessionTime start = at_ms(10000 * trial.index);
    const SessionTime onset = start + std::chrono::milliseconds(1000);
    store.trial_started(trial, start);
    for (int refresh = 0; refresh < plan.total_refreshes;) {
        const bool late = std::count(missed.begin(), missed.end(), refresh) > 0;
        const int lit = refresh + late;
        const PageCycleEntry& entry = plan.entry_at(refresh);
        FlipRecord flip{trial.index, lit,        plan.entry_at(std::min(lit, plan.total_refreshes - 1)).frame,
                        entry.frame, entry.pose, {}};
        flip.report.vertical_blank = onset + std::chrono::milliseconds(10 * lit);
        flip.missed_refreshes = late;
        store.flip(flip);
        refresh = lit + 1;
    }
    for (int i = 0; i < 5000; ++i) {
        GazeSample sample;
        const auto since_start = std::chrono::microseconds(1000'000 + 500 * i + 123);
        sample.sampled_at = TrackerTime(std::chrono::microseconds(tracker_offset_us) +
                                        std::chrono::milliseconds(10000 * trial.index) + since_start);
        if (i % 10 != 0) {
            sample.gaze = ScreenPoint{400.0 + 200.0 * std::cos(0.01 * i), 300.0};
            sample.pupil_area = 812.5f;
        }
        store.sample(trial.index, sample);
    }
    store.trial_finished(trial, outcome_at(10000 * trial.index));
}

struct Recorded {
    TemporaryFolder root;
    fs::path session;
    explicit Recorded(const std::vector<int>& missed = {}) {
        const SessionHeader header = example_header();
        session = make_session(root.path(), header);
        SessionStore store(session / session_file_name, patient());
        const PageCycle plan = header.page_cycle_of({});
        // Both clocks are read in no time and run at one rate: the map is exact.
        for (const std::int64_t second : {0, 100})
            store.clock_pair({at_ms(1000 * second),
                              TrackerTime(std::chrono::microseconds(tracker_offset_us + 1'000'000 * second)),
                              at_ms(1000 * second)});
        store.event({at_ms(5), -1, "calibration", "0.3\tdeg"});
        record_trial(store, plan, header.schedule.trials[0], missed);
        record_trial(store, plan, header.schedule.trials[1], {});
        store.trial_started(header.schedule.trials[2], at_ms(20000));
        store.sample(2, {});
    }
    fs::path target() const { return root.path() / "export"; }
};

inline std::vector<std::vector<std::string>> rows_of(const fs::path& file) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream text(text_of(file));
    for (std::string line; std::getline(text, line);) {
        std::vector<std::string>& row = rows.emplace_back();
        std::istringstream cells(line + '\t');
        for (std::string cell; std::getline(cells, cell, '\t');)
            row.push_back(cell);
    }
    return rows;
}

inline std::map<std::string, std::string> row_of(const std::vector<std::vector<std::string>>& rows,
                                                 std::size_t index) {
    std::map<std::string, std::string> row;
    for (std::size_t i = 0; i < rows[0].size(); ++i)
        row[rows[0][i]] = rows[index][i];
    return row;
}

inline const LeftHalf left_half;
inline const SurfaceLookup* bust_only(const ViewedObject& viewed) { return viewed.object == 0 ? &left_half : nullptr; }

} // namespace overt::testing
