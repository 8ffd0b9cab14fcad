/// Areas of the screen: their shapes, and what recordings and files say of them.
#include <catch2/catch.hpp>

#include <fstream>

#include "experiment/screen_areas/interest_area_text.h"
#include "experiment/screen_areas/screen_areas_file.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

namespace {

ScreenArea area_in(std::string_view text, double after_s = 0.0) {
    const InterestArea area = interest_area(text, after_s);
    if (const auto* const fault = std::get_if<std::string>(&area))
        FAIL(*fault);
    return std::get<ScreenArea>(area);
}

std::string fault_of(std::string_view text) {
    const InterestArea area = interest_area(text);
    return std::holds_alternative<std::string>(area) ? std::get<std::string>(area) : "none";
}

struct ReadAreas {
    std::vector<ChosenScreenArea> areas;
    std::string said;
};
ReadAreas areas_of_file(const std::string& name, const std::string& text) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / name;
    std::ofstream(file, std::ios::binary) << text;
    Diagnostics diagnostics;
    ReadAreas read;
    read.areas = read_screen_areas(file, diagnostics);
    read.said = diagnostics.print();
    return read;
}

} // namespace

TEST_CASE("areas side by side share no place, and leave none out", "[unit]") {
    const ScreenArea left = area_in("RECTANGLE 1 0 10 100 20"), right = area_in("RECTANGLE 2 100 10 200 20");
    for (const double x : {0.0, 50.0, 99.999, 100.0, 150.0, 199.999})
        CHECK(left.contains({x, 10.0}) + right.contains({x, 10.0}) == 1);
    CHECK_FALSE(right.contains({200.0, 15.0}));
    CHECK_FALSE(left.contains({50.0, 20.0}));
    CHECK_FALSE(left.contains({50.0, 9.999}));
}

TEST_CASE("an ellipse and a polygon hold what lies in them", "[unit]") {
    const ScreenArea ellipse = area_in("ELLIPSE 1 100 200 300 260 round");
    CHECK(ellipse.contains({200.0, 230.0}));
    CHECK(ellipse.contains({299.9, 230.0}));
    CHECK(ellipse.contains({200.0, 200.1}));
    CHECK_FALSE(ellipse.contains({290.0, 255.0})); // in its box alone
    // A C: what its arms hold between them is not in it.
    const ScreenArea c = area_in("FREEHAND 3 0,0 90,0 90,30 30,30 30,60 90,60 90,90 0,90 a C");
    CHECK(c.name == "a C");
    CHECK(c.contains({15.0, 45.0}));
    CHECK(c.contains({80.0, 10.0}));
    CHECK(c.contains({80.0, 80.0}));
    CHECK_FALSE(c.contains({60.0, 45.0}));
    CHECK_FALSE(c.contains({95.0, 10.0}));
}

TEST_CASE("pixels of areas are counted once, and on the screen only", "[unit]") {
    const ScreenArea a = area_in("RECTANGLE 1 0 0 10 10"), b = area_in("RECTANGLE 2 5 5 15 15"),
                     off = area_in("RECTANGLE 3 -20 -20 5 4"), circle = area_in("ELLIPSE 4 10 10 90 90");
    const auto count = [](std::initializer_list<const ScreenArea*> shapes) {
        const std::vector<const ScreenArea*> all(shapes);
        return pixels_in(all, {100, 100});
    };
    CHECK(count({&a}) == 100);
    CHECK(count({&a, &b}) == 175);
    CHECK(count({&off}) == 20);
    CHECK(count({}) == 0);
    CHECK(static_cast<double>(count({&circle})) == Approx(3.14159265 * 1600.0).epsilon(0.005));
    const ScreenArea beyond = area_in("RECTANGLE 5 200 200 300 300");
    CHECK(count({&beyond}) == 0);
}

TEST_CASE("messages of interest areas are read as the maker's programs write them", "[unit]") {
    CHECK(interest_area_words("!V IAREA RECTANGLE 1 0 0 9 9 face").value() == " RECTANGLE 1 0 0 9 9 face");
    CHECK(interest_area_words(" !V IAREA ELLIPSE 1 0 0 9 9").has_value());
    CHECK(interest_area_words("-12 !V IAREA ELLIPSE 1 0 0 9 9").has_value());
    CHECK_FALSE(interest_area_words("!V TRIAL_VAR IAREA 1").has_value());
    CHECK_FALSE(interest_area_words("IAREA RECTANGLE 1 0 0 9 9").has_value());
    CHECK_FALSE(interest_area_words("!V IMGLOAD FILL a.png").has_value());

    const ScreenArea plain = area_in(" RECTANGLE\t 7 \t 10 \t 20 \t 30.5 \t 40 \n");
    CHECK(plain.name == "7");
    CHECK(plain.points == std::vector<ScreenPoint>{{10.0, 20.0}, {30.5, 40.0}});
    CHECK(plain.is_there_at(0.0));
    CHECK(plain.is_there_at(1e6));
    CHECK(area_in("RECTANGLE 7 10 20 30 40 left  eye ").name == "left  eye");

    // From 66 to 1016 ms after the message, which came half a second after the onset.
    const ScreenArea moving = area_in("-66 -1016 RECTANGLE 3 0 0 9 9 blue", 0.5);
    CHECK_FALSE(moving.is_there_at(0.565));
    CHECK(moving.is_there_at(0.567));
    CHECK(moving.is_there_at(1.515));
    CHECK_FALSE(moving.is_there_at(1.517));
    CHECK(interest_area_file(" FILE  sets/a b.ias ").value() == "sets/a b.ias");
    CHECK_FALSE(interest_area_file(" RECTANGLE 1 0 0 9 9").has_value());
}

TEST_CASE("what is wrong with an interest area is said", "[unit]") {
    using Catch::Matchers::Contains;
    CHECK_THAT(fault_of("CIRCLE 1 0 0 9 9"), Contains("none of RECTANGLE"));
    CHECK_THAT(fault_of("RECTANGLE"), Contains("no id"));
    CHECK_THAT(fault_of("RECTANGLE 1 0 0 9"), Contains("no place in pixels"));
    CHECK_THAT(fault_of("RECTANGLE 1 0 0 9 nan"), Contains("no place in pixels"));
    CHECK_THAT(fault_of("RECTANGLE 1 9 0 9 9"), Contains("not less"));
    CHECK_THAT(fault_of("RECTANGLE 1 0 9 9 0"), Contains("not less"));
    CHECK_THAT(fault_of("FREEHAND 1 0,0 9,9 name"), Contains("three corners"));
    CHECK_THAT(fault_of("-20 RECTANGLE 1 0 0 9 9"), Contains("does not say when it ends"));
    CHECK_THAT(fault_of("-20 -20 RECTANGLE 1 0 0 9 9"), Contains("not after"));
}

TEST_CASE("a file of interest areas is read, and each faulty line is named", "[unit]") {
    const ReadAreas good = areas_of_file("set.IAS", "RECTANGLE\t1\t0\t0\t100\t50\tface\r\n\r\nELLIPSE 2 10 "
                                                    "10 20 20\r\n-0 -500 FREEHAND 3 0,0 9,0 9,9 tri\r\n");
    CHECK(good.said.empty());
    REQUIRE(good.areas.size() == 3);
    CHECK(good.areas[0].area.name == "face");
    CHECK(good.areas[2].area.until_s == 0.5);
    CHECK(good.areas[2].trials.empty());
    const ReadAreas bad =
        areas_of_file("set.ias", "RECTANGLE 1 0 0 9 9\nSQUARE 2 0 0 9 9\nRECTANGLE 3 0 0 0 9\n");
    CHECK_THAT(bad.said, Catch::Matchers::Contains("set.ias:2:1: error") &&
                             Catch::Matchers::Contains("set.ias:3:1: error") &&
                             Catch::Matchers::Contains("2 errors"));
    CHECK_THAT(areas_of_file("set.ias", "\n").said, Catch::Matchers::Contains("no interest areas"));
}

TEST_CASE("a table of areas has shapes, times and the trials that they are of", "[unit]") {
    const ReadAreas read = areas_of_file(
        "areas.csv", "\xEF\xBB\xBF"
                     "area,shape,left_px,top_px,right_px,bottom_px,corners_px,from_s,until_s,task\n"
                     "\"face\",\"rectangle\",0,0,100,50.5,,,,\n"
                     "# a remark\n"
                     "sign,ellipse,0,0,10,10,,0.5,2,search\r\n"
                     "roof,polygon,,,,,0 0 10 0 5 9,,,look\n");
    INFO(read.said);
    REQUIRE(read.areas.size() == 3);
    CHECK(read.areas[0].area.name == "face");
    CHECK(read.areas[0].area.points[1] == ScreenPoint{100.0, 50.5});
    CHECK(read.areas[0].trials.empty());
    CHECK(read.areas[1].area.shape == ScreenArea::Shape::ellipse);
    CHECK(read.areas[1].area.from_s == 0.5);
    CHECK(read.areas[1].trials == std::vector<std::pair<std::string, std::string>>{{"task", "search"}});
    CHECK(read.areas[2].area.contains({5.0, 3.0}));
}

TEST_CASE("what is wrong with a table of areas is told all at once, with places", "[unit]") {
    using Catch::Matchers::Contains;
    const std::string names = "area,shape,left_px,top_px,right_px,bottom_px\n";
    CHECK_THAT(areas_of_file("a.csv", names + ",rectangle,0,0,9,9\nb,square,0,0,9,9\nc,rectangle,0,x,9,9\n"
                                              "d,rectangle,9,0,9,9\ne,rectangle,0,0,9\n")
                   .said,
               Contains("a.csv:2:1: error: the area has no name") &&
                   Contains("a.csv:3:3: error: \"square\"") && Contains("a.csv:4:15: error: \"x\"") &&
                   Contains("a.csv:5:17: error") && Contains("a.csv:6:1: error") && Contains("5 errors"));
    CHECK_THAT(areas_of_file("a.csv", "name;shape\n").said, Contains("no column area"));
    CHECK_THAT(areas_of_file("a.csv", "area,area,shape\n").said, Contains("two columns area"));
    CHECK_THAT(areas_of_file("a.csv", "").said, Contains("empty"));
    CHECK_THAT(areas_of_file("a.csv", names).said, Contains("no areas"));
    CHECK_THAT(areas_of_file("a.csv", "area,shape\nb,polygon\n").said, Contains("corners_px"));
    CHECK_THAT(areas_of_file("a.csv", "area,shape,corners_px\nb,polygon,1 2 3 4\n").said,
               Contains("4 numbers"));
    CHECK_THAT(areas_of_file("a.csv", "area,shape\nb,rectangle\n").said, Contains("no column left_px"));
    CHECK_THAT(
        areas_of_file("a.csv",
                      "area,shape,left_px,top_px,right_px,bottom_px,from_s,until_s\nb,ellipse,0,0,9,9,2,2\n")
            .said,
        Contains("ends before it begins"));
}
