#include "app/rig/video_check.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;

namespace {

constexpr const char* today = "2026-11-23T20:06:10Z";

VideoCheck passed(const std::string& when = "2026-11-20T10:00:00Z") {
    return {{"Display++", "DPP-0042", "card", "driver 1", "DP-1", 1920, 1080, 120}, when, true, "all well"};
}

std::string refusal(const std::vector<VideoCheck>& checks, const VideoPath& path, int days = 30) {
    try {
        require_video_check(checks, path, days, today);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST_CASE("a check of this path that passed and is not too old is enough, to the day", "[unit]") {
    const VideoCheck check = passed("2026-10-24T23:59:59Z");
    const ScreenFinding finding = require_video_check({check}, check.path, 30, today);
    CHECK(finding.weight == ScreenFinding::Weight::good);
    CHECK_THAT(finding.finding, Contains("2026-10-24T23:59:59Z") && Contains("DP-1"));
    CHECK_THAT(refusal({passed("2026-10-23T23:59:59Z")}, check.path),
               Contains("2026-10-23") && Contains("30 days") && Contains("overt display verify --hardware"));
    CHECK_THAT(refusal({passed("yesterday")}, check.path), Contains("yesterday"));
}

TEST_CASE("whatever changed of a path makes its check worthless, and is named", "[unit]") {
    const VideoCheck check = passed();
    VideoPath now = check.path;
    SECTION("box") {
        now.serial_number = "DPP-0043";
        CHECK_THAT(refusal({check}, now), Contains("never checked with the box DPP-0043"));
    }
    SECTION("card") {
        now.graphics = "other card";
        CHECK_THAT(refusal({check}, now), Contains("the graphics card was card, is other card"));
    }
    SECTION("driver") {
        now.driver = "driver 2";
        CHECK_THAT(refusal({check}, now), Contains("the driver was driver 1, is driver 2"));
    }
    SECTION("output") {
        now.output = "DP-2";
        CHECK_THAT(refusal({check}, now), Contains("the output was DP-1, is DP-2"));
    }
    SECTION("mode") {
        now.refresh_hz = 60;
        CHECK_THAT(refusal({check}, now),
                   Contains("the mode was 1920 x 1080 at 120 Hz, is 1920 x 1080 at 60"));
    }
    CHECK(refusal({check, {now, today, true, "all well"}}, now).empty());
}

TEST_CASE("a check that failed refuses with its verdict, and 0 days ask for none", "[unit]") {
    VideoCheck check = passed();
    check.passed = false;
    check.verdict = "differently each time";
    CHECK_THAT(refusal({check}, check.path), Contains("failed") && Contains("differently each time"));
    CHECK(require_video_check({}, check.path, 0, today).weight == ScreenFinding::Weight::risk);
}

TEST_CASE("of each path the latest check is kept, in a file that is whole or refused", "[unit]") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "state" / "video_checks.json";
    CHECK(read_video_checks(file).empty());
    VideoCheck one = passed(), other = passed();
    other.path.output = "DP-2";
    keep_video_check(file, one);
    keep_video_check(file, other);
    CHECK(read_video_checks(file) == std::vector{other, one});
    one.passed = false;
    one.checked_utc = today;
    keep_video_check(file, one);
    CHECK(read_video_checks(file) == std::vector{one, other});

    for (const char* const damaged : {"", "{}", "[1]", "[{\"product\": 3}]", "[{}"}) {
        write_whole_file(file, damaged);
        CHECK_THROWS_WITH(read_video_checks(file), Contains(file.string()) && Contains("delete it"));
        CHECK_THROWS_AS(keep_video_check(file, one), InputError);
        CHECK(read_whole_file(file) == damaged);
    }
}
