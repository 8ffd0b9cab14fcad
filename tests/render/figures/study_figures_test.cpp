#include <set>

#include <catch2/catch.hpp>

#include "experiment/base/whole_file.h"
#include "render/figures/axes.h"
#include "render/figures/study_figures.h"
#include "tests/experiment/report/made_up_study.h"
#include "tests/support/temporary_folder.h"

using namespace overt;

TEST_CASE("each figure is written as SVG and PDF of the stated width, the same every time", "[unit]") {
    const test::TemporaryFolder folder;
    const StudyResults study = test::made_up_study();
    const std::vector<std::string> names = write_figures(study, folder.path() / "a");
    CHECK(names.size() == 7);
    REQUIRE(write_figures(study, folder.path() / "b") == names);
    for (const std::string& name : names) {
        CAPTURE(name);
        const std::string svg = read_whole_file(folder.path() / "a" / fmt::format("{}.svg", name));
        const std::string pdf = read_whole_file(folder.path() / "a" / fmt::format("{}.pdf", name));
        // 85 mm and 170 mm in points.
        CHECK((svg.find("width=\"240.94") != svg.npos || svg.find("width=\"481.88") != svg.npos));
        CHECK(svg.find("<image") == svg.npos);
        CHECK(pdf.starts_with("%PDF-1."));
        CHECK(svg == read_whole_file(folder.path() / "b" / fmt::format("{}.svg", name)));
        CHECK(pdf == read_whole_file(folder.path() / "b" / fmt::format("{}.pdf", name)));
    }
}

TEST_CASE("figure 4 shows each observer", "[unit]") {
    const test::TemporaryFolder folder;
    StudyResults study = test::made_up_study();
    for (AreaRow& row : study.area_rows)
        row.of_observers = {0.25, 0.5};
    const auto dots_with = [&](const std::string& name) {
        write_figures(study, folder.path() / name);
        const std::string svg = read_whole_file(folder.path() / name / "figure_4.svg");
        std::size_t curves = 0;
        for (std::size_t at = svg.find(" C "); at != std::string::npos; at = svg.find(" C ", at + 1))
            ++curves;
        return curves;
    };
    const std::size_t two = dots_with("two");
    for (AreaRow& row : study.area_rows)
        row.of_observers.clear();
    CHECK(two > dots_with("none"));
}

TEST_CASE("a study without anything has no figures", "[unit]") {
    const test::TemporaryFolder folder;
    CHECK(write_figures({}, folder.path() / "figures").empty());
}

TEST_CASE("ticks are round numbers within the axis", "[unit]") {
    CHECK(tick_values(0.0, 1.0, 5) == std::vector<double>{0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0});
    for (const double high : {0.013, 7.0, 950.0, 123456.0}) {
        const std::vector<double> ticks = tick_values(0.0, high, 6);
        CHECK(ticks.size() >= 3);
        CHECK(ticks.size() <= 7);
        CHECK(ticks.back() <= high);
        CHECK(ticks.back() > 0.7 * high);
    }
    CHECK(tick_values(2.0, 2.0, 5) == std::vector<double>{2.0});
    // However small or large they are, no two of an axis have the same text.
    for (const double high : {3e-14, 0.013, 950.0, 123456.0, 4e12}) {
        std::set<std::string> texts;
        const std::vector<double> ticks = tick_values(-high, high, 6);
        for (const double tick : ticks)
            texts.insert(tick_text(tick));
        CHECK(texts.size() == ticks.size());
        CHECK(texts.contains("0"));
    }
}
