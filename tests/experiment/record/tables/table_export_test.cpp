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
#include "experiment/record/session_schema.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/record/tables/table_writer.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

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
void record_trial(SessionStore& store, const PageCycle& plan, const Trial& trial,
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
        const PageCycle plan = make_page_cycle(header.animation, header.display.refresh_hz);
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

std::vector<std::vector<std::string>> rows_of(const fs::path& file) {
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

std::map<std::string, std::string> row_of(const std::vector<std::vector<std::string>>& rows,
                                          std::size_t index) {
    std::map<std::string, std::string> row;
    for (std::size_t i = 0; i < rows[0].size(); ++i)
        row[rows[0][i]] = rows[index][i];
    return row;
}

const LeftHalf left_half;
const SurfaceLookup* bust_only(int sculpture) { return sculpture == 0 ? &left_half : nullptr; }

} // namespace

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
    CHECK(row["sculpture"] == "bust");
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
    CHECK(files == 10);
}

TEST_CASE("the dictionary explains each column of each file, in the files' order", "[unit]") {
    const Recorded recorded;
    export_tables(SessionRecord(recorded.session), bust_only, recorded.target());
    const auto dictionary = nlohmann::ordered_json::parse(text_of(recorded.target() / "dictionary.json"));
    REQUIRE(dictionary["Files"].size() == 9);
    for (const auto& [file, description] : dictionary["Files"].items()) {
        std::vector<std::string> explained;
        for (const auto& [column, entry] : description["Columns"].items()) {
            explained.push_back(column);
            CHECK_FALSE(entry["Description"].get<std::string>().empty());
        }
        const auto rows = rows_of(recorded.target() / file);
        CHECK(explained == rows[0]);
        // Where values are listed, no other occurs.
        for (std::size_t column = 0; column < explained.size(); ++column) {
            const auto& entry = description["Columns"][explained[column]];
            for (std::size_t i = 1; entry.contains("Levels") && i < rows.size(); ++i)
                REQUIRE((rows[i][column] == "n/a" || entry["Levels"].contains(rows[i][column])));
        }
    }
}

/// Cells of comma-separated text, read as RFC 4180 has it.
std::vector<std::vector<std::string>> comma_separated(const std::string& text) {
    std::vector<std::vector<std::string>> rows{{""}};
    bool in_quotes = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"' && in_quotes && i + 1 < text.size() && text[i + 1] == '"') {
            rows.back().back() += text[++i];
        } else if (c == '"') {
            in_quotes = !in_quotes;
        } else if (c == ',' && !in_quotes) {
            rows.back().emplace_back();
        } else if (c == '\n' && !in_quotes) {
            rows.push_back({""});
        } else {
            rows.back().back() += c;
        }
    }
    rows.pop_back();
    return rows;
}

/// Whether a row of the table is this JSON object. A column holds numbers or texts in all rows alike.
void check_is_row(const nlohmann::ordered_json& object, const std::vector<std::string>& names,
                  const std::vector<std::string>& cells, std::map<std::string, bool>& holds_numbers) {
    REQUIRE(object.size() == names.size());
    std::size_t column = 0;
    for (const auto& [name, value] : object.items()) {
        CAPTURE(name, value, cells[column]);
        REQUIRE(name == names[column]);
        const std::string& cell = cells[column++];
        REQUIRE(value.is_null() == (cell == "n/a"));
        if (value.is_null())
            continue;
        REQUIRE(holds_numbers.try_emplace(name, value.is_number()).first->second == value.is_number());
        REQUIRE((value.is_number() ? value.get<double>() == std::stod(cell) : value == cell));
    }
}

TEST_CASE("commas and JSON hold the same cells as tab-separated tables, with their texts as they were",
          "[unit]") {
    const Recorded recorded({20});
    const SessionRecord record(recorded.session);
    export_tables(record, bust_only, recorded.root.path() / "tsv");
    export_tables(record, bust_only, recorded.root.path() / "jsonl", {TableFormat::jsonl, false, {}, {}});
    const auto counts =
        export_tables(record, bust_only, recorded.root.path() / "csv", {TableFormat::csv, false, {}, {}});
    const auto unescaped = [](std::string cell) {
        for (const auto& [escape, character] : {std::pair{"\\t", "\t"}, {"\\n", "\n"}, {"\\r", "\r"}})
            for (auto at = cell.find(escape); at != std::string::npos; at = cell.find(escape))
                cell.replace(at, 2, character);
        return cell;
    };
    std::int64_t rows = 0, quoted = 0;
    std::map<std::string, bool> holds_numbers; // by column, in all tables alike
    for (const char* name : {"trials", "flips", "samples", "gaze_events", "events", "responses", "stimuli",
                             "display_box", "participants"}) {
        auto expected = rows_of(recorded.root.path() / "tsv" / (std::string(name) + ".tsv"));
        for (auto& row : expected)
            for (std::string& cell : row)
                cell = unescaped(cell);
        const std::string text = text_of(recorded.root.path() / "csv" / (std::string(name) + ".csv"));
        quoted += text.find('"') != std::string::npos;
        REQUIRE(comma_separated(text) == expected);
        rows += static_cast<std::int64_t>(expected.size()) - 1;
        std::istringstream objects(text_of(recorded.root.path() / "jsonl" / (std::string(name) + ".jsonl")));
        std::size_t row = 1;
        for (std::string line; std::getline(objects, line); ++row) {
            REQUIRE(row < expected.size());
            check_is_row(nlohmann::ordered_json::parse(line), expected[0], expected[row], holds_numbers);
        }
        CHECK(row == expected.size());
    }
    CHECK(quoted > 0);
    for (const char* column :
         {"session", "trial", "attempt", "refresh", "time_s", "x_px", "surface_z", "planned_frame"})
        CHECK(holds_numbers.at(column));
    CHECK_FALSE(holds_numbers.at("task"));
    CHECK_FALSE(holds_numbers.at("observer"));
    CHECK(counts.rows == rows);
    const auto dictionary = nlohmann::json::parse(text_of(recorded.root.path() / "csv" / "dictionary.json"));
    CHECK(dictionary["Files"].contains("samples.csv"));
}

TEST_CASE("texts with commas, quotes, line breaks and blanks at their ends stand in quotes", "[unit]") {
    CHECK(text_cell("a,b", TableFormat::csv) == "\"a,b\"");
    CHECK(text_cell("say \"no\"", TableFormat::csv) == "\"say \"\"no\"\"\"");
    CHECK(text_cell("a\nb", TableFormat::csv) == "\"a\nb\"");
    CHECK(text_cell(" a", TableFormat::csv) == "\" a\"");
    CHECK(text_cell("", TableFormat::csv) == "n/a");
    CHECK(text_cell("Wie alt? 何歳？ كم عمره؟", TableFormat::csv) == "Wie alt? 何歳？ كم عمره؟");
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

TEST_CASE("cells keep their numbers to the last decimal, and texts in one cell", "[unit]") {
    const TemporaryFolder root;
    TableWriter writer(root.path(), {"t", "", {{"a", "", "", {}}, {"b", "", "", {}}}}, TableFormat::tsv);
    const auto row = [&](auto&& first, auto&& second) {
        first(), second();
        writer.end_row();
    };
    row([&] { writer.seconds(SessionDuration(-1)); },
        [&] { writer.seconds(SessionDuration(1'234'567'890'123)); });
    row([&] { writer.fixed(-0.0004, 3); }, [&] { writer.fixed(-1.0005, 3); });
    row([&] { writer.fixed(std::nan(""), 3); },
        [&] { writer.fixed(-std::numeric_limits<double>::infinity(), 1); });
    row([&] { writer.fixed(1e17, 2); }, [&] { writer.integer(std::numeric_limits<std::int64_t>::min()); });
    row([&] { writer.text(""); }, [&] { writer.text("a\tb\\c\r\n"); });
    CHECK(writer.rows() == 5);
    writer.close();
    CHECK(text_of(root.path() / "t.tsv") == "a\tb\n"
                                            "-0.000000001\t1234.567890123\n"
                                            "0.000\t-1.001\n"
                                            "n/a\tn/a\n"
                                            "100000000000000000.00\t-9223372036854775808\n"
                                            "n/a\ta\\tb\\\\c\\r\\n\n");
}
