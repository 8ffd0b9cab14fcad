#include <fstream>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/record/foreign/foreign_gaze.h"
#include "tests/support/temporary_folder.h"

using namespace overt;

namespace {

std::filesystem::path foreign_file(const test::TemporaryFolder& folder, const std::string& name,
                                   const std::string& text) {
    std::ofstream(folder.path() / name, std::ios::binary) << text;
    return folder.path() / name;
}

} // namespace

TEST_CASE("tables of other programs are read whatever stands between their cells", "[unit]") {
    const test::TemporaryFolder folder;
    ForeignTable table(foreign_file(
        folder, "a.csv",
        "\xef\xbb\xbf# made by somebody\r\ntime (s);\"gaze; x\";note\r\n1,5;2;\"two\nlines\"\r\n\r\n3\r\n"));
    CHECK(table.comments() == std::vector<std::string>{"# made by somebody"});
    CHECK(table.columns() == std::vector<std::string>{"time (s)", "gaze; x", "note"});
    CHECK(table.find("time") == 0u);
    CHECK_FALSE(table.find("tim"));
    REQUIRE(table.next());
    CHECK(table.cell(2) == "two\nlines");
    CHECK(table.place().ends_with("a.csv:3"));
    REQUIRE(table.next());
    CHECK(table.cell(0) == "3");
    CHECK(table.cell(1).empty());
    CHECK(table.place().ends_with("a.csv:6"));
    CHECK_FALSE(table.next());
    // Two columns that differ in their unit alone are not one.
    CHECK_FALSE(ForeignTable(foreign_file(folder, "b.tsv", "x [px]\tx [mm]\n1\t2\n")).find("x"));
    CHECK_THROWS_AS(ForeignTable(foreign_file(folder, "c.csv", "words\n")), InputError);
    CHECK_THROWS_AS(ForeignTable(foreign_file(folder, "d.csv", std::string("a,b\0c\n", 6))), InputError);
}

TEST_CASE("numbers of cells have points or commas, and what stands for nothing is nothing", "[unit]") {
    CHECK(number_in_cell("1.25") == 1.25);
    CHECK(number_in_cell(" -1,25 ") == -1.25);
    CHECK(number_in_cell("+2e3") == 2000.0);
    for (const char* word : {"", "1.2.3", "12 px", "inf", "nan", "0x10"})
        CHECK_FALSE(number_in_cell(word));
    for (const char* word : {"", ".", "n/a", "NaN", "NA", "None", "-"})
        CHECK(is_missing_cell(word));
    CHECK_FALSE(is_missing_cell("0"));
}

TEST_CASE("the spacing of samples tells the unit of their times, and a coarse one is refused", "[unit]") {
    const test::TemporaryFolder folder;
    const auto surveyed = [&](double step, const std::string& name) {
        std::string text = "t,x,y\n";
        for (int i = 0; i < 20; ++i)
            text += std::to_string(7.0 + i * step) + ",1,2\n";
        GazeColumns columns = gaze_columns_of({"time=t,x=x,y=y"});
        return ForeignGaze({foreign_file(folder, name, text)}, columns, ScreenGeometry(), false).survey({});
    };
    const GazeSurvey seconds = surveyed(0.004, "s.csv"), milliseconds = surveyed(4.0, "ms.csv"),
                     microseconds = surveyed(4000.0, "us.csv");
    CHECK(seconds.rate_hz == Approx(250.0));
    CHECK(milliseconds.rate_hz == Approx(250.0));
    CHECK(microseconds.rate_hz == Approx(250.0));
    CHECK(seconds.first == tracker_time(7'000'000));
    CHECK(milliseconds.first == tracker_time(7'000));
    CHECK(microseconds.last == tracker_time(76'007));
    CHECK_THROWS_AS(surveyed(0.2, "slow.csv"), InputError);
}

TEST_CASE("places are put onto the screen by their unit and their corner", "[unit]") {
    const test::TemporaryFolder folder;
    const auto place = [&](const std::string& words, const std::string& x, const std::string& y) {
        const auto file =
            foreign_file(folder, "p.csv", "t,x,y,ok\n0," + x + "," + y + ",1\n4," + x + "," + y + ",0\n");
        ScreenGeometry screen;
        screen.screen_px = {1000, 500};
        screen.screen_mm = {400.0, 200.0};
        screen.viewing_distance_mm = 500.0;
        const GazeColumns columns = gaze_columns_of({"time=t,x=x,y=y,validity=ok,time_unit=ms," + words});
        std::vector<std::optional<ScreenPoint>> places;
        ForeignGaze({file}, columns, screen, false).read([&](const ForeignItem& item) {
            places.push_back(item.sample->gaze);
        });
        REQUIRE(places.size() == 2);
        CHECK_FALSE(places[1]); // not valid
        return places[0];
    };
    CHECK(place("unit=px", "10", "20")->y_px == 20.0);
    CHECK(place("unit=px,y_up=yes", "10", "20")->y_px == 480.0);
    CHECK(place("unit=normalised", "0.25", "0.25")->x_px == 250.0);
    CHECK(place("unit=normalised", "0.25", "0.25")->y_px == 125.0);
    CHECK(place("unit=normalised,y_up=yes", "0.25", "0.25")->y_px == 375.0);
    // 45 degrees are as far to the side as the screen is away: 500 mm, 1250 px.
    CHECK(place("unit=degrees", "45", "0")->x_px == Approx(1750.0));
    CHECK(place("unit=degrees", "0", "45")->y_px == Approx(-1000.0));
    CHECK_FALSE(place("unit=px,zero_is_lost=yes", "0", "0"));
    CHECK_FALSE(place("unit=px,least_validity=2", "1", "1"));
}
