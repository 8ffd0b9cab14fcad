#include "experiment/record/asc/asc_parser.h"

#include <cmath>
#include <map>
#include <numeric>

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace overt;

namespace {

/// What the parser said.
struct Heard final : AscListener {
    void header(std::string_view) override {}
    void samples(std::span<const GazeSample> samples) override {
        const std::int64_t us = samples[0].sampled_at.time_since_epoch().count();
        CHECK((times_us.empty() || us > times_us.back()));
        times_us.push_back(us);
        x_px.push_back(samples[0].gaze ? samples[0].gaze->x_px : -1.0);
    }
    void event(const GazeEvent& event) override { events.push_back(event); }
    void malformed(std::int64_t line, std::string_view why, std::string_view text) override {
        reports[line] = fmt::format("{}: {}", why, text);
    }
    std::vector<std::int64_t> times_us;
    std::vector<double> x_px;
    std::vector<GazeEvent> events;
    std::map<std::int64_t, std::string> reports;
};

Heard parsed(const std::vector<std::string>& lines) {
    Heard heard;
    AscParser parser(heard);
    for (const std::string& line : lines)
        parser.line(line);
    parser.end();
    return heard;
}

std::string sample(std::int64_t ms, int x) { return fmt::format("{}\t  {}.0\t  300.0\t 1000.0\t...", ms, x); }

/// Samples of one recording at these times, x counting them from 100.
std::vector<std::string> recording(const std::vector<std::int64_t>& times_ms) {
    std::vector<std::string> lines{fmt::format("START\t{} \tLEFT\tSAMPLES\tEVENTS", times_ms.front()),
                                   "SAMPLES\tGAZE\tLEFT\tRATE\t1000.00\tTRACKING\tCR"};
    for (const std::int64_t ms : times_ms)
        lines.push_back(sample(ms, 100 + static_cast<int>(lines.size()) - 2));
    lines.push_back(fmt::format("END\t{} \tSAMPLES\tEVENTS\tRES\t  38.00\t  38.00", times_ms.back() + 1));
    return lines;
}

std::vector<std::int64_t> range_ms(std::int64_t first, int count) {
    std::vector<std::int64_t> times(static_cast<std::size_t>(count));
    std::iota(times.begin(), times.end(), first);
    return times;
}

} // namespace

TEST_CASE("one sample whose stamp is broken anyhow is left out alone", "[unit]") {
    const std::vector<std::string> good = recording(range_ms(1030724, 12));
    for (std::size_t broken = 2; broken + 1 < good.size(); ++broken)
        for (std::size_t digit = 0; digit < 7; ++digit)
            for (char other = '0'; other <= '9'; ++other) {
                std::vector<std::string> lines = good;
                if (lines[broken][digit] == other)
                    continue;
                lines[broken][digit] = other;
                CAPTURE(broken, lines[broken]);
                const Heard heard = parsed(lines);
                // Within a fifth of a second nothing tells a stamp from a gap.
                const std::int64_t stamp = std::stoll(lines[broken]), own = std::stoll(good[broken]);
                if (std::abs(stamp - own) < 300)
                    continue;
                CHECK(heard.times_us.size() == 11);
                REQUIRE(heard.reports.size() == 1);
                CHECK(heard.reports.begin()->first == static_cast<std::int64_t>(broken) + 1);
                for (std::size_t i = 0; i < heard.times_us.size(); ++i)
                    CHECK(heard.times_us[i] / 1000 - 1030724 == std::lround(heard.x_px[i]) - 100);
            }
}

TEST_CASE("a gap in a recording costs no sample, wherever it is", "[unit]") {
    for (const std::int64_t gap_ms : {150, 400, 5000, 3'600'000})
        for (std::size_t at = 1; at < 12; ++at) {
            std::vector<std::int64_t> times = range_ms(500, 12);
            for (std::size_t i = at; i < times.size(); ++i)
                times[i] += gap_ms;
            CAPTURE(gap_ms, at);
            const Heard heard = parsed(recording(times));
            CHECK(heard.reports.empty());
            REQUIRE(heard.times_us.size() == times.size());
            for (std::size_t i = 0; i < times.size(); ++i)
                CHECK(heard.times_us[i] == 1000 * times[i]);
        }
}

TEST_CASE("a recording whose begin has a broken stamp loses no sample", "[unit]") {
    for (const char* const start : {"START\t9000500 \tLEFT", "START\t5 \tLEFT"}) {
        std::vector<std::string> lines = recording(range_ms(100'500, 12));
        lines[0] = start;
        const Heard heard = parsed(lines);
        CHECK(heard.reports.empty());
        CHECK(heard.times_us.size() == 12);
    }
}

TEST_CASE("a broken stamp leaves the two samples of a millisecond in their places", "[unit]") {
    std::vector<std::int64_t> times;
    for (std::int64_t ms = 7000; ms < 7008; ++ms)
        times.insert(times.end(), {ms, ms});
    std::vector<std::string> lines = recording(times);
    lines[1] = "SAMPLES\tGAZE\tLEFT\tRATE\t2000.00\tTRACKING\tCR";
    lines.insert(lines.begin() + 7, sample(9'007'002, 999)); // between the two of 7002
    const Heard heard = parsed(lines);
    CHECK(heard.reports.size() == 1);
    CHECK(heard.reports.count(8) == 1);
    REQUIRE(heard.times_us.size() == 16);
    for (std::size_t i = 0; i < 16; ++i)
        CHECK(heard.times_us[i] == 7'000'000 + 500 * static_cast<std::int64_t>(i));
}

TEST_CASE("what comes next tells a broken stamp from a gap: also a message, and the end of the recording",
          "[unit]") {
    std::vector<std::string> lines = recording(range_ms(500, 4));
    lines.insert(lines.begin() + 6, {sample(90'000, 999), "MSG\t504 soon"});
    CHECK(parsed(lines).reports.count(7) == 1);
    lines[7] = "MSG\t89990 later";
    CHECK(parsed(lines).reports.empty());
    CHECK(parsed(lines).times_us.size() == 5);
    // Cut off where nothing comes next.
    lines.resize(7);
    CHECK(parsed(lines).reports.count(7) == 1);
}
