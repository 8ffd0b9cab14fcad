#include "experiment/screen_areas/screen_areas_file.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/number_table.h"
#include "experiment/screen_areas/interest_area_text.h"

namespace overt {

namespace {

constexpr std::array<std::string_view, 4> edge_columns{"left_px", "top_px", "right_px", "bottom_px"};
constexpr std::string_view header_hint = "write area,shape,left_px,top_px,right_px,bottom_px; shape is "
                                         "rectangle, ellipse or polygon, which has corners_px";

class AreaTable {
  public:
    AreaTable(std::string file, std::string_view text, Diagnostics& diagnostics)
        : file_(std::move(file)), lines_(text), diagnostics_(diagnostics) {}

    std::vector<ChosenScreenArea> read() {
        if (!lines_.next()) {
            error({}, "the table is empty", header_hint);
            return {};
        }
        if (!read_names())
            return {};
        while (lines_.next())
            read_row();
        if (areas_.empty() && !diagnostics_.has_errors())
            error({}, "the table has no areas");
        return std::move(areas_);
    }

  private:
    void error(Place place, std::string message, std::string_view hint = {}) {
        diagnostics_.error(file_, place, std::move(message), std::string(hint));
    }

    bool read_names() {
        for (const TableCell& cell : lines_.cells()) {
            const std::string name(cell.text);
            if (name.empty())
                error(cell.place, "a column has no name", header_hint);
            else if (std::ranges::find(names_, name) != names_.end())
                error(cell.place, fmt::format("there are two columns {}", name));
            names_.push_back(name);
        }
        for (const std::string_view needed : {"area", "shape"})
            if (std::ranges::find(names_, needed) == names_.end())
                error({lines_.number(), 1}, fmt::format("there is no column {}", needed), header_hint);
        return !diagnostics_.has_errors();
    }

    /// The cell of a column in this row; null where there is no such column.
    const TableCell* cell(std::string_view column) const {
        const auto found = std::ranges::find(names_, column);
        return found == names_.end() ? nullptr
                                     : &lines_.cells()[static_cast<std::size_t>(found - names_.begin())];
    }
    std::string_view text_of(std::string_view column) const {
        const TableCell* const own = cell(column);
        return own ? own->text : std::string_view();
    }

    std::optional<double> number(std::string_view column, std::string_view what) {
        const TableCell* const own = cell(column);
        const std::optional<double> value = own ? own->number() : std::nullopt;
        if (!value && own)
            error(own->place, fmt::format("\"{}\" is no {}", own->text, what));
        else if (!value)
            error({lines_.number(), 1}, fmt::format("there is no column {}", column), header_hint);
        return value;
    }

    void read_row() {
        if (lines_.cells().size() != names_.size()) {
            error({lines_.number(), 1},
                  fmt::format("{} cells in a row under {} names", lines_.cells().size(), names_.size()));
            return;
        }
        ChosenScreenArea chosen;
        ScreenArea& area = chosen.area;
        area.name = text_of("area");
        if (area.name.empty())
            return error(cell("area")->place, "the area has no name");
        if (!read_shape(area))
            return;
        for (const auto& [column, time] :
             {std::pair{"from_s", &ScreenArea::from_s}, std::pair{"until_s", &ScreenArea::until_s}}) {
            if (text_of(column).empty())
                continue;
            const std::optional<double> value = number(column, "time in seconds");
            if (!value)
                return;
            area.*time = *value;
        }
        if (!(area.from_s < area.until_s))
            return error(cell("until_s") ? cell("until_s")->place : cell("from_s")->place,
                         fmt::format("area {} ends before it begins", area.name));
        for (const std::string& name : names_) {
            if (!is_own(name) && !text_of(name).empty())
                chosen.trials.emplace_back(name, text_of(name));
        }
        areas_.push_back(std::move(chosen));
    }

    static bool is_own(std::string_view name) {
        return name == "area" || name == "shape" || name == "corners_px" || name == "from_s" ||
               name == "until_s" || std::ranges::find(edge_columns, name) != edge_columns.end();
    }

    bool read_shape(ScreenArea& area) {
        const std::string_view shape = text_of("shape");
        if (shape == "polygon") {
            area.shape = ScreenArea::Shape::polygon;
            return read_corners(area);
        }
        if (shape != "rectangle" && shape != "ellipse") {
            error(cell("shape")->place,
                  fmt::format("\"{}\" is none of rectangle, ellipse and polygon", shape));
            return false;
        }
        area.shape = shape == "ellipse" ? ScreenArea::Shape::ellipse : ScreenArea::Shape::rectangle;
        std::array<double, 4> edges{};
        bool is_whole = true;
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const std::optional<double> edge = number(edge_columns[i], "place in pixels");
            is_whole &= edge.has_value();
            edges[i] = edge.value_or(0.0);
        }
        if (!is_whole)
            return false;
        for (const std::size_t axis : {0u, 1u}) {
            if (edges[axis] < edges[axis + 2])
                continue;
            error(cell(edge_columns[axis + 2])->place,
                  fmt::format("{} is {}, which is not more than {}, {}", edge_columns[axis + 2],
                              edges[axis + 2], edge_columns[axis], edges[axis]));
            return false;
        }
        area.points = {{edges[0], edges[1]}, {edges[2], edges[3]}};
        return true;
    }

    bool read_corners(ScreenArea& area) {
        const TableCell* const own = cell("corners_px");
        if (!own) {
            error(cell("shape")->place, "a polygon needs the column corners_px", header_hint);
            return false;
        }
        std::vector<double> numbers;
        std::string_view text = own->text;
        while (!text.empty()) {
            const std::size_t length = std::min(text.find(' '), text.size());
            if (length > 0) {
                const std::optional<double> value = TableCell{text.substr(0, length), own->place}.number();
                if (!value) {
                    error(own->place, fmt::format("\"{}\" is no place in pixels", text.substr(0, length)));
                    return false;
                }
                numbers.push_back(*value);
            }
            text.remove_prefix(std::min(length + 1, text.size()));
        }
        if (numbers.size() < 6 || numbers.size() % 2 != 0) {
            error(own->place,
                  fmt::format("corners_px has {} numbers: a polygon has x and y of at least three corners, "
                              "with blanks between them",
                              numbers.size()));
            return false;
        }
        for (std::size_t i = 0; i < numbers.size(); i += 2)
            area.points.push_back({numbers[i], numbers[i + 1]});
        return true;
    }

    std::string file_;
    TableLines lines_;
    Diagnostics& diagnostics_;
    std::vector<std::string> names_;
    std::vector<ChosenScreenArea> areas_;
};

std::vector<ChosenScreenArea> interest_areas(const std::string& file, std::string_view text,
                                             Diagnostics& diagnostics) {
    std::vector<ChosenScreenArea> areas;
    TableLines lines(text);
    while (lines.next()) {
        const InterestArea area = interest_area(lines.text());
        if (const auto* const fault = std::get_if<std::string>(&area))
            diagnostics.error(
                file, lines.cells().front().place, *fault,
                "a line is RECTANGLE id left top right bottom label, ELLIPSE the same, or FREEHAND id "
                "x,y x,y x,y label");
        else
            areas.push_back({std::get<ScreenArea>(area), {}});
    }
    if (areas.empty() && !diagnostics.has_errors())
        diagnostics.error(file, {}, "the file has no interest areas");
    return areas;
}

} // namespace

std::vector<ChosenScreenArea> read_screen_areas(const std::filesystem::path& file, Diagnostics& diagnostics) {
    const std::string name = file.string();
    const std::optional<std::string> text = read_whole_file(file, name, {}, diagnostics);
    if (!text)
        return {};
    diagnostics.quote_from(name, *text);
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending == ".ias" ? interest_areas(name, *text, diagnostics)
                            : AreaTable(name, *text, diagnostics).read();
}

} // namespace overt
