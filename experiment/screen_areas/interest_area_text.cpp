#include "experiment/screen_areas/interest_area_text.h"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "experiment/base/text_number.h"

namespace overt {

namespace {

constexpr std::string_view blanks = " \t\r\n";

/// Takes the next word from the text; empty if there is none.
std::string_view take_word(std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    const std::size_t length = std::min(text.find_first_of(blanks), text.size());
    const std::string_view word = text.substr(0, length);
    text.remove_prefix(length);
    return word;
}

std::string_view without_blanks(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::optional<double> place_in(std::string_view word) {
    const std::optional<double> number = number_in<double>(word);
    return number && std::isfinite(*number) ? number : std::nullopt;
}

/// "x,y".
std::optional<ScreenPoint> point_in(std::string_view word) {
    const std::size_t comma = word.find(',');
    if (comma == std::string_view::npos)
        return std::nullopt;
    const std::optional<double> x = place_in(word.substr(0, comma)), y = place_in(word.substr(comma + 1));
    return x && y ? std::optional(ScreenPoint{*x, *y}) : std::nullopt;
}

std::optional<ScreenArea::Shape> shape_in(std::string_view word) {
    if (word == "RECTANGLE")
        return ScreenArea::Shape::rectangle;
    if (word == "ELLIPSE")
        return ScreenArea::Shape::ellipse;
    if (word == "FREEHAND")
        return ScreenArea::Shape::polygon;
    return std::nullopt;
}

/// Takes the corners of a box; what is wrong, or empty.
std::string take_box(std::string_view& text, ScreenArea& area) {
    double edges[4] = {};
    for (double& edge : edges) {
        const std::string_view word = take_word(text);
        const std::optional<double> number = place_in(word);
        if (!number)
            return fmt::format("\"{}\" is no place in pixels; after the id come left, top, right and bottom",
                               word);
        edge = *number;
    }
    if (!(edges[0] < edges[2] && edges[1] < edges[3]))
        return fmt::format("left {} and top {} are not less than right {} and bottom {}", edges[0], edges[1],
                           edges[2], edges[3]);
    area.points = {{edges[0], edges[1]}, {edges[2], edges[3]}};
    return {};
}

std::string take_corners(std::string_view& text, ScreenArea& area) {
    for (;;) {
        std::string_view rest = text;
        const std::optional<ScreenPoint> point = point_in(take_word(rest));
        if (!point)
            break;
        area.points.push_back(*point);
        text = rest;
    }
    return area.points.size() < 3 ? "a FREEHAND area has at least three corners, each as x,y" : std::string();
}

} // namespace

InterestArea interest_area(std::string_view text, double after_s) {
    ScreenArea area;
    std::string_view word = take_word(text);
    if (const std::optional<long> from_ms = number_in<long>(word)) {
        const std::string_view second = take_word(text);
        const std::optional<long> until_ms = number_in<long>(second);
        if (!until_ms)
            return fmt::format("after {}, when it begins, \"{}\" does not say when it ends", word, second);
        area.from_s = after_s + 1e-3 * static_cast<double>(std::abs(*from_ms));
        area.until_s = after_s + 1e-3 * static_cast<double>(std::abs(*until_ms));
        if (!(area.from_s < area.until_s))
            return fmt::format("it ends at {} ms, which is not after {} ms", std::abs(*until_ms),
                               std::abs(*from_ms));
        word = take_word(text);
    }
    const std::optional<ScreenArea::Shape> shape = shape_in(word);
    if (!shape)
        return fmt::format("\"{}\" is none of RECTANGLE, ELLIPSE and FREEHAND", word);
    area.shape = *shape;
    const std::string_view id = take_word(text);
    if (id.empty())
        return std::string("it has no id");
    std::string fault =
        *shape == ScreenArea::Shape::polygon ? take_corners(text, area) : take_box(text, area);
    if (!fault.empty())
        return fault;
    const std::string_view label = without_blanks(text);
    area.name = label.empty() ? id : label;
    return area;
}

std::optional<std::string_view> interest_area_words(std::string_view message) {
    std::string_view word = take_word(message);
    if (number_in<long>(word))
        word = take_word(message);
    if (word != "!V" || take_word(message) != "IAREA")
        return std::nullopt;
    return message;
}

std::optional<std::string> interest_area_file(std::string_view text) {
    if (take_word(text) != "FILE")
        return std::nullopt;
    return std::string(without_blanks(text));
}

} // namespace overt
