#include "experiment/study/results/template_rows.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/temporary_folder.h"

using namespace overt;

namespace {

struct ReadLandmarks {
    Diagnostics diagnostics;
    std::vector<Landmark> landmarks;
    explicit ReadLandmarks(const std::string& text) {
        const test::TemporaryFolder folder;
        landmarks = read_landmarks(folder.file("faces.csv", text), diagnostics);
    }
    /// "line:column: message" of the first finding.
    std::string fault() const {
        if (diagnostics.findings().empty())
            return {};
        const Finding first = diagnostics.findings().front();
        return fmt::format("{}:{}: {}", first.place.line, first.place.column, first.message);
    }
};

} // namespace

TEST_CASE("landmarks are read in any order of columns, with others beside them", "[unit]") {
    const ReadLandmarks read(
        "# by hand\nlandmark,z_mm,object,x_mm,y_mm,by\n\"nose\",3,muse,1,-2.5,AB\nchin, 6e1 "
        ",muse,4,5,AB\nnose,1,\"vase\",0,0,\n");
    CHECK(read.fault() == "");
    REQUIRE(read.landmarks.size() == 3);
    CHECK(read.landmarks[0].object == "muse");
    CHECK(read.landmarks[0].name == "nose");
    CHECK(read.landmarks[0].place_mm == glm::dvec3(1.0, -2.5, 3.0));
    CHECK(read.landmarks[1].place_mm == glm::dvec3(4.0, 5.0, 60.0));
    CHECK(read.landmarks[2].object == "vase");
}

TEST_CASE("what is wrong with a table of landmarks is said with its place", "[unit]") {
    const std::string names = "object,landmark,x_mm,y_mm,z_mm\n";
    CHECK(ReadLandmarks("").fault() == "0:0: the table is empty");
    CHECK(ReadLandmarks(names).fault() == "0:0: the table has no landmarks");
    CHECK(ReadLandmarks("object,landmark,x_mm,y_mm\na,b,1,2\n").fault() == "1:1: there is no column z_mm");
    CHECK(ReadLandmarks(names + "muse,nose,1,2\n").fault() == "2:1: 4 cells in a row under 5 names");
    CHECK(ReadLandmarks(names + "muse,nose,1,two,3\n").fault() == "2:13: \"two\" is no number");
    CHECK(ReadLandmarks(names + "muse,,1,2,3\n").fault() == "2:6: a landmark needs an object and a name");
    CHECK(ReadLandmarks(names + ",nose,1,2,3\n").fault() == "2:1: a landmark needs an object and a name");
    CHECK(ReadLandmarks(names + "a,nose,1,2,3\nb,nose,1,2,3\na,nose,4,5,6\n").fault() ==
          "4:1: object a has landmark nose twice");
}
