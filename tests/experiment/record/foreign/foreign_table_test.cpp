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
    // A quotation mark in quotes is written twice, also at a cell's end.
    ForeignTable quoted(foreign_file(folder, "q.csv", "a,b\n\"he said \"\"no\"\"\",\"\"\"x\"\"y\"\n"));
    REQUIRE(quoted.next());
    CHECK(quoted.cell(0) == "he said \"no\"");
    CHECK(quoted.cell(1) == "\"x\"y");
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
        return ForeignGaze({foreign_file(folder, name, text)}, columns, ScreenGeometry()).survey({});
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
        ForeignGaze({file}, columns, screen).read([&](const ForeignItem& item) {
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

TEST_CASE("of Tobii's spaces of coordinates that of the display is taken, and its tracker's clock",
          "[unit]") {
    const test::TemporaryFolder folder;
    // The tracker's clock lies 1000.4 ms behind: whole ms of the recording are cut, not rounded.
    std::string text =
        "Recording timestamp [ms]\tSensor\tEyetracker timestamp [\u03bcs]\tEvent\t"
        "Gaze point left X [DACS px]\tGaze point left Y [DACS px]\tGaze point left X [DACS mm]\t"
        "Gaze point left X [MCS norm]\tGaze point left Y [MCS norm]\t"
        "Pupil diameter left [mm]\tValidity left\n"
        "0\t\t\tRecordingStart\t\t\t\t\t\t\t\n";
    for (int i = 0; i < 3000; ++i) {
        const int fine_us = 500'000 + 3333 * i, coarse_ms = (fine_us + 1'000'400) / 1000;
        text += std::to_string(coarse_ms) + "\tEye Tracker\t" + std::to_string(fine_us) +
                (i == 5 ? "\t\t\t\t\t\t\t\tInvalid\n" : "\t\t537\t362\t147,6\t0,28\t0,34\t2,925\tValid\n");
    }
    const ForeignGaze gaze({foreign_file(folder, "t.tsv", text)}, std::nullopt, ScreenGeometry());
    const GazeSurvey survey = gaze.survey({});
    CHECK(survey.columns.program == "Tobii Pro Lab");
    CHECK(survey.rows_left_out == 0);
    CHECK(survey.samples == 3000);
    CHECK(survey.without_gaze == 1);
    CHECK_FALSE(survey.has_right);
    CHECK(survey.rate_hz == Approx(1e6 / 3333).epsilon(1e-4));
    REQUIRE(survey.marks.size() == 1);
    CHECK(survey.marks[0].text == "RecordingStart");
    std::vector<GazeSample> samples;
    gaze.read([&](const ForeignItem& item) {
        if (item.sample)
            samples.push_back(*item.sample);
    });
    CHECK(samples[0].gaze->x_px == 537.0);
    CHECK(samples[0].gaze->y_px == 362.0);
    CHECK(samples[0].pupil_area == Approx(2.925));
    // Cut milliseconds lie 0.5 ms early in the mean; what is left of their steps is a few microseconds.
    for (std::size_t i = 2000; i < samples.size(); ++i) {
        const double truth_us = 1'500'400.0 + 3333.0 * static_cast<double>(i);
        const double error_us =
            static_cast<double>(samples[i].sampled_at.time_since_epoch().count()) - truth_us;
        CHECK(error_us == Approx(-500.0).margin(30.0));
    }
}

TEST_CASE("Tobii Studio's codes of validity are 0 and 1 for gaze, and its marks stand beside samples",
          "[unit]") {
    const test::TemporaryFolder folder;
    std::string text =
        "RecordingTimestamp\tMediaName\tStudioEvent\tStudioEventData\tGazePointLeftX (ADCSpx)\t"
        "GazePointLeftY (ADCSpx)\tPupilLeft\tValidityLeft\n"
        "0\tvase.png\tImageStart\tvase.png\t\t\t\t\n";
    for (int code = 0; code <= 4; ++code)
        text += std::to_string(8 + 8 * code) + "\tvase.png\t\t\t100\t50\t3,1\t" + std::to_string(code) + "\n";
    const ForeignGaze gaze({foreign_file(folder, "s.tsv", text)}, std::nullopt, ScreenGeometry());
    const GazeSurvey survey = gaze.survey({});
    CHECK(survey.columns.program == "Tobii Studio");
    CHECK(survey.samples == 5); // the mark's row is no lost sample
    CHECK(survey.without_gaze == 3);
    REQUIRE(survey.marks.size() == 2);
    CHECK(survey.marks[0].text == "ImageStart vase.png");
    CHECK(survey.marks[1].is_trial);
    CHECK(survey.marks[1].text == "vase.png");
}

TEST_CASE("BeGaze's rows say what was shown", "[unit]") {
    const test::TemporaryFolder folder;
    std::string text = "## BeGaze\nTime\tType\tTrial\tL POR X [px]\tL POR Y [px]\tStimulus\n"
                       "70590724309\tMSG\t1\t# Message: vase.bmp\n";
    for (int i = 0; i < 3; ++i)
        text += std::to_string(70590726108 + 4000 * i) + "\tSMP\t1\t858.16\t516.11\tvase.bmp\n";
    const GazeSurvey survey =
        ForeignGaze({foreign_file(folder, "b.txt", text)}, std::nullopt, ScreenGeometry()).survey({});
    CHECK(survey.rate_hz == Approx(250.0));
    REQUIRE(survey.marks.size() == 2);
    CHECK(survey.marks[0].text == "vase.bmp");
    CHECK_FALSE(survey.marks[0].is_trial);
    CHECK(survey.marks[1].is_trial);
}

TEST_CASE("Neon's Marker Mapper has places on the screen from its upper left, and its scene camera has none",
          "[unit]") {
    const test::TemporaryFolder folder;
    ScreenGeometry screen;
    screen.screen_px = {1000, 500};
    const std::string of_id = "recording id,timestamp [ns],";
    const auto gaze_file = foreign_file(
        folder, "gaze.csv",
        "section id," + of_id +
            "gaze detected on surface,gaze position on surface x [normalized],gaze position on surface y "
            "[normalized],fixation id,blink id\n"
            "s,r,1700000000000000000,True,0.25,0.1,1,\ns,r,1700000000005000000,False,,,,\n");
    const auto events =
        foreign_file(folder, "events.csv", of_id + "name,type\nr,1700000000004000000,trial 1,recording\n");
    const ForeignGaze gaze({gaze_file, events}, std::nullopt, screen);
    const GazeSurvey survey = gaze.survey({});
    CHECK(survey.columns.program == "Pupil Labs Neon");
    CHECK(survey.rate_hz == Approx(200.0));
    CHECK(survey.without_gaze == 1);
    REQUIRE(survey.marks.size() == 1);
    CHECK(survey.marks[0].text == "trial 1");
    CHECK(survey.marks[0].at == tracker_time(1'700'000'000'004'000));
    std::vector<GazeSample> samples;
    gaze.read([&](const ForeignItem& item) {
        if (item.sample)
            samples.push_back(*item.sample);
    });
    CHECK(samples[0].gaze->x_px == 250.0);
    CHECK(samples[0].gaze->y_px == 50.0);
    const auto scene = foreign_file(folder, "scene.csv", of_id + "gaze x [px],gaze y [px],worn\nr,1,2,3,1\n");
    CHECK_THROWS_AS(ForeignGaze({scene}, std::nullopt, screen), InputError);
}
