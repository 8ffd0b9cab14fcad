#include "experiment/study/results/template_rows.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "experiment/base/number_table.h"

namespace overt {

namespace {

constexpr std::array<std::string_view, 5> landmark_columns{"object", "landmark", "x_mm", "y_mm", "z_mm"};
constexpr const char* landmark_header = "write object,landmark,x_mm,y_mm,z_mm";

} // namespace

std::vector<Landmark> read_landmarks(const std::filesystem::path& file, Diagnostics& diagnostics) {
    std::vector<Landmark> landmarks;
    const std::string named = file.string();
    const std::optional<std::string> text = read_whole_file(file, named, {}, diagnostics);
    if (!text)
        return landmarks;
    diagnostics.quote_from(named, *text);
    TableLines lines(*text);
    if (!lines.next()) {
        diagnostics.error(named, {}, "the table is empty", landmark_header);
        return landmarks;
    }
    std::array<std::size_t, landmark_columns.size()> at{};
    for (std::size_t i = 0; i < landmark_columns.size(); ++i) {
        const auto found = std::ranges::find_if(
            lines.cells(), [&](const TableCell& cell) { return cell.text == landmark_columns[i]; });
        at[i] = static_cast<std::size_t>(found - lines.cells().begin());
        if (found == lines.cells().end())
            diagnostics.error(named, {lines.number(), 1},
                              fmt::format("there is no column {}", landmark_columns[i]), landmark_header);
    }
    const std::size_t columns = lines.cells().size();
    while (!diagnostics.has_errors() && lines.next()) {
        const std::vector<TableCell>& cells = lines.cells();
        if (cells.size() != columns) {
            diagnostics.error(named, {lines.number(), 1},
                              fmt::format("{} cells in a row under {} names", cells.size(), columns));
            break;
        }
        Landmark one{std::string(cells[at[0]].text), std::string(cells[at[1]].text), glm::dvec3(0.0)};
        if (one.object.empty() || one.name.empty())
            diagnostics.error(named, cells[at[one.object.empty() ? 0 : 1]].place,
                              "a landmark needs an object and a name");
        for (int axis = 0; axis < 3; ++axis) {
            const TableCell& cell = cells[at[static_cast<std::size_t>(2 + axis)]];
            const std::optional<double> value = cell.number();
            if (!value)
                diagnostics.error(named, cell.place, fmt::format("\"{}\" is no number", cell.text));
            one.place_mm[axis] = value.value_or(0.0);
        }
        if (std::ranges::any_of(landmarks, [&](const Landmark& other) {
                return other.object == one.object && other.name == one.name;
            }))
            diagnostics.error(named, {lines.number(), 1},
                              fmt::format("object {} has landmark {} twice", one.object, one.name));
        landmarks.push_back(std::move(one));
    }
    if (landmarks.empty() && !diagnostics.has_errors())
        diagnostics.error(named, {}, "the table has no landmarks");
    return landmarks;
}

} // namespace overt
