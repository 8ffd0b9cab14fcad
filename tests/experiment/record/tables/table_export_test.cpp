#include "experiment/record/tables/table_export.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "experiment/base/error.h"
#include "experiment/factors.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/record/tables/table_writer.h"
#include "experiment/table_columns.h"
#include "tests/experiment/record/tables/recorded_trials.h"

using namespace overt;
using namespace overt::testing;
using Catch::Matchers::Contains;

TEST_CASE("an export holds each row of the completed trials, and its counts are those of its rows",
          "[unit]") {
    const Recorded recorded({20});
    const SessionRecord record(recorded.session);
    int steps = 0;
    const auto counts =
        export_tables(record, bust_only, recorded.target(), {TableFormat::tsv, false, [&](int done, int all) {
                                                                 CHECK(done == ++steps);
                                                                 CHECK(all == 3);
                                                             }});
    CHECK(steps == 3);
    CHECK(counts.trials == 2);
    CHECK(counts.samples == 10'000);
    CHECK(counts.samples_without_gaze == 1000);
    CHECK(counts.flips == 503);

    const auto samples = rows_of(recorded.target() / "samples.tsv");
    REQUIRE(samples.size() == 10'001);
    std::int64_t on_object = 0;
    for (std::size_t i = 1; i < samples.size(); ++i)
        on_object += row_of(samples, i)["part"] == "head";
    CHECK(on_object == counts.samples_on_object);
    CHECK(on_object > 1000);
    // The names, a row for each flip, and one for the refresh that was missed.
    CHECK(rows_of(recorded.target() / "flips.tsv").size() == 505);
    CHECK(rows_of(recorded.target() / "responses.tsv").size() == 3);
    CHECK(rows_of(recorded.target() / "stimuli.tsv").size() == 3);
    const auto trials = rows_of(recorded.target() / "trials.tsv");
    REQUIRE(trials.size() == 4);
    CHECK(row_of(trials, 1)["status"] == "completed");
    CHECK(row_of(trials, 1)["samples_on_object"] == std::to_string(on_object));
    CHECK(row_of(trials, 3)["status"] == "open");
    CHECK(row_of(trials, 3)["samples"] == "n/a");
    const auto events = rows_of(recorded.target() / "events.tsv");
    REQUIRE(events.size() == 2);
    CHECK(events[1] ==
          std::vector<std::string>{"AB7", "3", "0.005000000", "n/a", "calibration", "0.3\\tdeg"});
    CHECK(row_of(rows_of(recorded.target() / "responses.tsv"), 1)["answer"] == "forty\\tor\\nfifty");
    CHECK(row_of(rows_of(recorded.target() / "responses.tsv"), 2)["response_time_s"] == "0.990000000");
}

TEST_CASE("a sample's row says when, on which frame and where on the surface it was", "[unit]") {
    const Recorded recorded;
    export_tables(SessionRecord(recorded.session), bust_only, recorded.target());
    const auto samples = rows_of(recorded.target() / "samples.tsv");
    // Sample 301 was taken 150.623 ms after the onset. Row 300 of 600 and a latency of 1.5 ms put it 144.123
    // ms after the onset's blank: refresh 14, the fourth frame of forty milliseconds, which is frame 1 on its
    // way back (0 1 2 1 0 …), pose 1.
    auto row = row_of(samples, 302);
    const double x_px = 400.0 + 200.0 * std::cos(3.01);
    CHECK(row["trial"] == "1");
    CHECK(row["task"] == "age");
    CHECK(row["object"] == "bust");
    CHECK(row["material"] == "silver");
    CHECK(row["time_s"] == "1.150623000");
    CHECK(std::stod(row["time_uncertainty_s"]) > 0.0);
    CHECK(std::stod(row["time_uncertainty_s"]) < 1e-5);
    CHECK(row["tracker_time_us"] == std::to_string(tracker_offset_us + 1'150'623));
    CHECK(row["eye"] == "right");
    CHECK(std::stod(row["x_px"]) == Approx(x_px).margin(5e-4));
    CHECK(row["y_px"] == "300.000");
    CHECK(row["pupil_area"] == "812.5000");
    CHECK(row["frame"] == "1");
    CHECK(row["angle_deg"] == "0.100000");
    CHECK(std::stod(row["image_x_px"]) == Approx(x_px - 144.0).margin(5e-4));
    CHECK(row["image_y_px"] == "256.000");
    CHECK(std::stod(row["surface_x"]) == Approx(x_px - 144.0).margin(5e-7));
    CHECK(row["surface_y"] == "-256.000000");
    CHECK(row["surface_z"] == "1.000000");
    CHECK(row["triangle"] == "41");
    CHECK(row["part"] == "head");
    CHECK(row["depth"] == "200.250000");
    CHECK(row["incidence_deg"] == "12.3457");

    row = row_of(samples, 301); // the eye was lost
    for (const char* column :
         {"x_px", "y_px", "pupil_area", "frame", "angle_deg", "image_x_px", "surface_z", "part"})
        CHECK(row[column] == "n/a");
    CHECK(row["time_s"] == "1.150123000");
    CHECK(row_of(samples, 2)["frame"] == "n/a");   // 0.623 ms after the blank that row is still dark
    CHECK(row_of(samples, 5303)["part"] == "n/a"); // no lookup for the vase
    CHECK(row_of(samples, 5303)["frame"] == "1");
}

TEST_CASE("samples that the plan would put on another frame are counted exactly", "[unit]") {
    // Refreshes 20 and 40 begin frames, so each missed one leaves the old frame on for 10 ms: twenty samples,
    // two of them without gaze. The others are missed within a frame.
    const std::vector<std::pair<std::vector<int>, std::int64_t>> cases{
        {{}, 0}, {{20}, 18}, {{20, 40}, 36}, {{18, 21, 42}, 0}, {{16, 17, 18, 20}, 36}};
    for (const auto& [missed, expected] : cases) {
        const Recorded recorded(missed);
        const auto counts = export_tables(SessionRecord(recorded.session), bust_only, recorded.target());
        CHECK(counts.samples_off_plan == expected);
    }
}

TEST_CASE("two exports of one session are the same, byte for byte", "[unit]") {
    const Recorded recorded({20});
    const SessionRecord record(recorded.session);
    export_tables(record, bust_only, recorded.root.path() / "a");
    export_tables(SessionRecord(recorded.session), bust_only, recorded.root.path() / "b");
    int files = 0;
    for (const auto& entry : fs::directory_iterator(recorded.root.path() / "a")) {
        const std::string text = text_of(entry.path());
        CHECK_FALSE(text.empty());
        CHECK(text == text_of(recorded.root.path() / "b" / entry.path().filename()));
        CHECK(text.find("2024-0") == std::string::npos); // the dates of the wall clock
        CHECK(text.find('\r') == std::string::npos);
        ++files;
    }
    CHECK(files == 20);
}

TEST_CASE("samples come in pieces of any size, the same as all at once", "[unit]") {
    const Recorded recorded;
    const SessionRecord record(recorded.session);
    for (const std::size_t most : {1u, 7u, 5000u, 100000u}) {
        std::vector<std::int64_t> times;
        std::size_t largest = 0;
        record.read_samples(record.trials()[0], most, [&](std::span<const GazeSample> piece) {
            largest = std::max(largest, piece.size());
            for (const GazeSample& sample : piece)
                times.push_back(sample.sampled_at.time_since_epoch().count());
        });
        std::vector<std::int64_t> expected;
        for (const GazeSample& sample : record.samples(record.trials()[0]))
            expected.push_back(sample.sampled_at.time_since_epoch().count());
        CHECK(largest <= most);
        CHECK(times == expected);
    }
}

TEST_CASE("an export replaces an earlier export only when asked, and other folders never", "[unit]") {
    const Recorded recorded;
    const SessionRecord record(recorded.session);
    export_tables(record, bust_only, recorded.target());
    CHECK_THROWS_WITH(export_tables(record, bust_only, recorded.target()), Contains("exists already"));
    CHECK_NOTHROW(export_tables(record, bust_only, recorded.target(), {TableFormat::tsv, true, {}}));
    std::ofstream(recorded.target() / "thesis.txt") << "years of work";
    CHECK_THROWS_WITH(export_tables(record, bust_only, recorded.target(), {TableFormat::tsv, true, {}}),
                      Contains("thesis.txt"));
    CHECK(text_of(recorded.target() / "thesis.txt") == "years of work");
    CHECK(std::distance(fs::directory_iterator(recorded.root.path()), fs::directory_iterator()) == 2);
}

TEST_CASE("no column that a protocol's entry may have is called as another of a table that has it",
          "[unit]") {
    SessionHeader header = overt::testing::example_header();
    REQUIRE(!header.materials.empty());
    header.materials.front().columns = {{"hue", "red"}};
    int tables = 0;
    const ExportTables exported(header, pupil_words(PupilMeasure::unknown), {.cone_accuracy = Degrees{0.5}});
    for (const Table* const table : exported.all()) {
        if (std::ranges::none_of(table->columns,
                                 [](const TableColumn& column) { return column.name == "hue"; }))
            continue;
        ++tables;
        for (const TableColumn& column : table->columns) {
            INFO(table->name << ": " << column.name);
            // Of a gaze cone, the parts of the objects as they are called.
            if (!column.name.starts_with("p_"))
                CHECK((column.name == "hue" || is_name_of_factor(column.name) ||
                       is_column_of_tables(column.name)));
        }
    }
    CHECK(tables >= 5);
}
