/// Laws of the figures' layout, over studies of many sizes and with names of any kind.
#include <catch2/catch.hpp>

#include <algorithm>
#include <set>

#include "render/figures/axes.h"
#include "render/figures/legend.h"
#include "render/figures/row_chart.h"
#include "render/figures/study_figures.h"
#include "tests/experiment/report/made_up_study.h"

using namespace overt;

namespace {

struct Box {
    glm::dvec2 low, high;
    std::string text;
};

/// Remembers where things are drawn, by the extents that every pen uses.
class MeasuringPen final : public FigurePen {
  public:
    void line(glm::dvec2 from, glm::dvec2 to, FigureColour colour, double width_mm) override {
        path({from, to}, colour, width_mm, {});
    }
    void path(const std::vector<glm::dvec2>& points, FigureColour colour, double,
              const std::vector<double>& dash_mm) override {
        polygon(points, colour);
        for (const double dash : dash_mm)
            drawn += fmt::format(" dash {}", dash);
    }
    void polygon(const std::vector<glm::dvec2>& corners, FigureColour colour) override {
        drawn += fmt::format("; {:.3f} {:.3f}", colour[0], colour[1]);
        for (const glm::dvec2& corner : corners)
            mark(corner, corner);
    }
    void box(glm::dvec2 corner, glm::dvec2 size, FigureColour) override { mark(corner, corner + size); }
    void dot(glm::dvec2 centre, double radius_mm, FigureColour colour, double) override {
        polygon({centre - radius_mm, centre + radius_mm}, colour);
    }
    void text(glm::dvec2 at, std::string_view text, double points, TextAlign align, FigureColour,
              bool upwards) override {
        const TextExtent extent = extent_of(text, points);
        const double from = extent.width * (align == TextAlign::left     ? 0.0
                                            : align == TextAlign::centre ? -0.5
                                                                         : -1.0);
        const double to = from + extent.width;
        if (upwards)
            texts.push_back(
                {{at.x - extent.above, at.y - to}, {at.x + extent.below, at.y - from}, std::string(text)});
        else
            texts.push_back(
                {{at.x + from, at.y - extent.above}, {at.x + to, at.y + extent.below}, std::string(text)});
        all_text += text;
    }
    std::vector<Box> texts, marks;
    std::string all_text, drawn;

  private:
    void mark(glm::dvec2 a, glm::dvec2 b) {
        marks.push_back({glm::min(a, b), glm::max(a, b), {}});
        drawn += fmt::format(" {:.2f},{:.2f}", a.x, a.y);
    }
};

std::string without_spaces(std::string text) {
    std::erase(text, ' ');
    return text;
}

/// How names of levels are made from a number.
using Naming = std::string (*)(int);

/// A study with so many levels of each of some factors.
StudyResults study_with(int factors, int levels, Naming name, double value) {
    StudyResults study;
    const std::vector<std::string> columns{"task", "material", "the_hand_that_writes",
                                           "age",  "lamp",     "block"};
    study.by.assign(columns.begin(), columns.begin() + factors);
    study.objects = {test::made_up::object(name(0), 50.0)};
    for (int level = 0; level < levels; ++level) {
        std::vector<StudyKey> keys;
        for (const std::string& column : study.by)
            keys.push_back({column, name(level + static_cast<int>(keys.size()))});
        study.groups.push_back({keys, {}, 12, 400});
        for (const StudyKey& key : keys)
            study.area_rows.push_back({.area = {},
                                       .keys = {key},
                                       .by_count = Estimate::of(1.0, Interval{0.0, 1.0}),
                                       .by_duration = {},
                                       .corrected = {},
                                       .pooled = {},
                                       .pooled_interval = {},
                                       .planted = {},
                                       .observers = 12,
                                       .trials = 6,
                                       .fixations = 40,
                                       .of_observers = {0.0, 0.5, 1.0}});
        DistributionRow row;
        row.group = level;
        row.wss_mm2 = level % 5 == 4 ? Estimate::none("one fixation only")
                                     : Estimate::of(value, Interval{-0.5 * value, 3.7 * value});
        row.variance_mm2 = {value, 1.0 / 3.0, -1234567.0};
        row.map_peak = 1e-14 * value;
        study.distributions.push_back(row);
        PairRow pair;
        pair.keys = keys;
        pair.column = "object";
        pair.a = name(level);
        pair.b = name(level + 1);
        pair.wss_difference_deg2 = Estimate::of(-value, Interval{-2.0 * value, value});
        pair.maps_cc = value;
        pair.maps_p = 0.00012345;
        pair.cc.value = Estimate::of(0.123456, Interval{-0.998, 0.997});
        study.pairs.push_back(pair);
        for (int second = 0; second < 8; ++second)
            study.time_course.push_back(
                {"", keys.front(), 1.0 * second, second + 1.0, Estimate::of(1.0, Interval{0.0, 1.0}), 12});
        StudyQuality quality;
        quality.accuracy_deg = value;
        quality.lost = quality.samples = 1.0;
        study.session_quality.push_back(quality);
    }
    study.trials.emplace_back();
    study.traces.emplace_back();
    for (int i = 1; i <= 300; ++i)
        study.traces.back().events.push_back({GazeEvent::Kind::saccade, 0.1 * i, 0.04, 0.05 * i,
                                              i % 3 ? std::optional(20.0 * i) : std::nullopt});
    StudyFixation fixation;
    fixation.duration_s = 0.2;
    study.fixations.assign(100000, fixation);
    return study;
}

std::string short_name(int number) { return fmt::format("{}", number); }
std::string long_name(int number) {
    return fmt::format("look for the person who has been here before, number {}, and for nothing else",
                       number);
}
std::string endless_name(int number) { return std::string(180, 'W') + fmt::format("{}", number); }
std::string foreign_name(int number) {
    return fmt::format("雕塑的头部与身体之间的差别{} صورة الرأس", number);
}
std::string broken_name(int number) { return fmt::format("\xff\xfe line\nbreak\t\x01{}", number); }

} // namespace

TEST_CASE("no text of a figure lies on another one, and nothing leaves its page, whatever a study holds",
          "[unit]") {
    std::vector<StudyResults> studies{test::made_up_study()};
    for (const Naming name : {short_name, long_name, endless_name, foreign_name, broken_name}) {
        for (const auto& [factors, levels] : {std::pair(1, 1), {1, 12}, {3, 7}, {6, 40}})
            studies.push_back(study_with(factors, levels, name, factors == 1 ? 2.88e-14 : 98765.4321));
    }
    for (std::size_t i = 0; i < studies.size(); ++i) {
        const std::vector<StudyFigure> figures = study_figures(studies[i]);
        std::string names;
        for (const StudyFigure& figure : figures)
            names += figure.name + " ";
        CAPTURE(i, names);
        CHECK(figures.size() >= 7);
        for (const StudyFigure& figure : figures) {
            MeasuringPen pen;
            figure.draw(pen);
            INFO("study " << i << ", " << figure.name << ", " << figure.size_mm.x << " x "
                          << figure.size_mm.y);
            std::string faults;
            const auto leaves = [&](const Box& box) {
                return box.low.x < 0.0 || box.low.y < 0.0 || box.high.x > figure.size_mm.x ||
                       box.high.y > figure.size_mm.y;
            };
            for (const Box& mark : pen.marks)
                if (leaves(mark))
                    faults += fmt::format("a mark leaves the page at {}, {}\n", mark.high.x, mark.high.y);
            constexpr double touch_mm = 0.05;
            for (std::size_t a = 0; a < pen.texts.size(); ++a) {
                const Box& one = pen.texts[a];
                if (leaves(one))
                    faults += fmt::format("'{}' leaves the page\n", one.text);
                for (std::size_t b = 0; b < a; ++b) {
                    const Box& other = pen.texts[b];
                    const glm::dvec2 common = glm::min(one.high, other.high) - glm::max(one.low, other.low);
                    if (common.x > touch_mm && common.y > touch_mm)
                        faults += fmt::format("'{}' lies on '{}'\n", one.text, other.text);
                }
            }
            CHECK(faults == "");
        }
    }
}

TEST_CASE("names in figures are whole, however long they are", "[unit]") {
    for (const Naming name : {short_name, long_name, endless_name}) {
        const StudyResults study = study_with(2, 12, name, 5.0);
        for (const std::string of : {"figure_4", "figure_5", "table_1", "time_course"}) {
            std::string all;
            for (const StudyFigure& figure : study_figures(study)) {
                MeasuringPen pen;
                figure.draw(pen);
                if (figure.name.starts_with(of))
                    all += pen.all_text;
            }
            for (int level = 0; level < 12; ++level) {
                INFO(of << ": " << name(level));
                CHECK(without_spaces(all).find(without_spaces(name(level))) != std::string::npos);
            }
        }
    }
}

TEST_CASE("each number of the figures of rows stands below a head that says what it is", "[unit]") {
    // Right of the first number's left edge, all that is right-aligned in a column ends where its head ends.
    const StudyResults study = study_with(2, 3, short_name, 1234.5);
    for (const StudyFigure& figure : study_figures(study)) {
        if (figure.name != "figure_5" && figure.name != "table_1")
            continue;
        MeasuringPen pen;
        figure.draw(pen);
        double rule = 1e9;
        for (const Box& mark : pen.marks)
            rule = std::min(rule, mark.low.y);
        std::set<int> heads, cells;
        for (const Box& text : pen.texts) {
            const bool is_number = text.text.find_first_not_of("-−0123456789.e[], n/a") == std::string::npos;
            const int right = static_cast<int>(std::lround(100.0 * text.high.x));
            if (text.high.y <= rule + 0.01)
                heads.insert(right);
            else if (is_number && text.text.size() > 2)
                cells.insert(right);
        }
        INFO(figure.name);
        CHECK(cells.size() >= 6);
        if (figure.name == "table_1")
            CHECK(std::ranges::includes(heads, cells));
    }
}

TEST_CASE("each column of rows has its head, and so have the bars", "[unit]") {
    const RowChart chart{
        .columns = {{"material", true}, {"area (mm²)"}, {"p after Holm"}},
        .rows = {{{"gold", "12.5", "0.031"}, {3.0, {}}}, {{"clay", "9.5", "0.5"}, {2.0, {}}}},
        .bars_before = 2,
        .bars_head = "share of gaze"};
    const std::vector<StudyFigure> figures = figures_of(chart, "rows");
    REQUIRE(figures.size() == 1);
    MeasuringPen pen;
    figures.front().draw(pen);
    for (const char* const head : {"material", "area (mm²)", "p after Holm", "share of gaze"}) {
        INFO(head);
        CHECK(without_spaces(pen.all_text).find(without_spaces(head)) != std::string::npos);
    }
}

TEST_CASE("small numbers in figures are written out, and none is written as 0", "[unit]") {
    const auto texts_of = [](double value) {
        std::string all;
        const StudyResults study = study_with(2, 3, short_name, value);
        for (const StudyFigure& figure : study_figures(study)) {
            MeasuringPen pen;
            figure.draw(pen);
            for (const Box& text : pen.texts)
                all += text.text + "\n";
        }
        return all;
    };
    CHECK(texts_of(0.00043).find("0.00043") != std::string::npos);
    CHECK(texts_of(0.00043).find("4.3e-04") == std::string::npos);
    CHECK(texts_of(2.9e-5).find("0.000029") != std::string::npos);
    CHECK(texts_of(2.9e-9).find("< 0.000001") != std::string::npos);
}

TEST_CASE("a label that is longer than its axis gets several lines, and is whole", "[unit]") {
    const std::string x = "share of the time for which gaze was on the surface of the object, of all trials",
                      y = "mean time until the first fixation of the area that the task asks about (s)";
    MeasuringPen pen;
    const glm::dvec2 corner(3.0, 4.0), size(50.0, 40.0);
    ChartAxes(pen, corner, size, {0.0, 1.0, x}, {0.0, 20.0, y});
    for (const Box& text : pen.texts) {
        INFO(text.text);
        CHECK(text.low.x >= corner.x);
        CHECK(text.low.y >= corner.y);
        CHECK(text.high.x <= corner.x + size.x);
        CHECK(text.high.y <= corner.y + size.y);
    }
    CHECK(without_spaces(pen.all_text).find(without_spaces(x)) != std::string::npos);
    CHECK(without_spaces(pen.all_text).find(without_spaces(y)) != std::string::npos);
}

TEST_CASE("56 curves are unlike each other", "[unit]") {
    std::set<std::string> looks;
    for (std::size_t i = 0; i < 56; ++i) {
        MeasuringPen pen;
        CurveStyle(i).draw_marker(pen, {1.0, 1.0});
        CurveStyle(i).draw_curve(pen, {{0.0, 0.0}, {5.0, 0.0}});
        looks.insert(pen.drawn);
    }
    CHECK(looks.size() == 56);
    // Lines without markers: eight colours in four ways of dashing.
    std::set<std::string> lines;
    for (std::size_t i = 0; i < 32; ++i) {
        MeasuringPen pen;
        CurveStyle(i).draw_curve(pen, {{0.0, 0.0}, {5.0, 0.0}});
        lines.insert(pen.drawn);
    }
    CHECK(lines.size() == 32);
    // Neighbours within a round differ without colour, too, and so does each round from the one before.
    const auto without_colour = [](std::size_t i) {
        MeasuringPen pen;
        CurveStyle(i).draw_marker(pen, {1.0, 1.0});
        return std::pair(pen.marks.size(), pen.marks.front().low.x);
    };
    for (std::size_t i = 1; i < 7; ++i)
        CHECK(without_colour(i) != without_colour(i - 1));
}

TEST_CASE("the main sequence has all saccades with a recorded peak, and says of how many", "[unit]") {
    const auto title_of = [](const StudyResults& study) {
        for (const StudyFigure& figure : study_figures(study)) {
            if (figure.name != "main_sequence")
                continue;
            MeasuringPen pen;
            figure.draw(pen);
            return pen.texts.back().text;
        }
        return std::string();
    };
    StudyResults study = study_with(1, 1, short_name, 1.0);
    CHECK(title_of(study) == "200 of 300 saccades: those with a recorded peak");
    for (StudyTraceEvent& event : study.traces[0].events)
        event.peak_velocity_deg_s = 300.0;
    CHECK(title_of(study) == "300 saccades");
    for (StudyTraceEvent& event : study.traces[0].events)
        event.peak_velocity_deg_s.reset();
    CHECK(title_of(study).empty());
}

TEST_CASE("a text that is broken into lines has lost nothing but spaces, and no line is too wide", "[unit]") {
    for (const double width : {5.0, 20.0, 60.0}) {
        for (const std::string text :
             {"one two three four five six seven", "a", "", "unbreakablewordthatgoeson",
              "mean WSS / mm² of 雕塑的头部与身体之间"}) {
            std::string joined;
            for (const std::string& line : broken_into_lines(text, 6.5, width)) {
                CHECK(extent_of(line, 6.5).width <= width + 0.05);
                joined += line;
            }
            CHECK(without_spaces(joined) == without_spaces(text));
        }
    }
}
