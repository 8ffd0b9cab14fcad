// Scales: points or a line between their ends.
#include <algorithm>
#include <cmath>

#include "render/presenter/answer_parts.h"

namespace overt {

namespace {

using ScaleShape = AnswerDrawing::Shape;

// Shares of a letter's height.
constexpr double label_size = 0.75, point_radius = 0.36, least_step = 1.8, widest_step = 6.0;
constexpr double longest_scale = 26.0, end_gap = 1.0, least_end = 4.0;

double stroke_of(const AnswerLetters& letters) { return std::max(1.0, letters.body.line_height_px / 20.0); }

void put_point(AnswerDrawing& sheet, glm::dvec2 middle, bool is_chosen, const AnswerLetters& letters) {
    const double radius = point_radius * letters.body.line_height_px, line = stroke_of(letters);
    const auto around = [&](double r) { return InkBox{middle.x - r, middle.y - r, 2.0 * r, 2.0 * r}; };
    sheet.shapes.push_back(
        {ScaleShape::Kind::ring, around(radius), is_chosen ? 1.0 : 0.6, is_chosen ? 1.5 * line : line, 0.0});
    if (is_chosen)
        sheet.shapes.push_back({ScaleShape::Kind::disc, around(0.62 * radius), 1.0, 1.0, 0.0});
}

/// The words below a point: its label, and its key unless that is what the label says.
AnswerDrawing words_below(const AnswerOption& option, int wrap_px, const AnswerLetters& letters) {
    AnswerDrawing sheet;
    if (!option.label.empty())
        sheet.size_px = sheet.write(option.label, letters.plain(label_size, wrap_px), {0, 0},
                                    option.is_chosen ? 1.0 : 0.8);
    if (option.key.empty() || option.key == option.label)
        return sheet;
    AnswerDrawing cap = lay_out_key_cap(option.key, letters, 0.7);
    const int wide = std::max(sheet.size_px.x, cap.size_px.x), top = sheet.size_px.y + letters.ems(0.15);
    for (AnswerDrawing::Text& text : sheet.texts)
        text.origin_px.x = (wide - text.size_px.x) / 2;
    const glm::ivec2 size = cap.size_px;
    sheet.add(std::move(cap), {(wide - size.x) / 2, top});
    sheet.size_px = {wide, top + size.y};
    return sheet;
}

/// Below each other, each point before its label.
AnswerDrawing lay_out_list(const AnswerItem& item, int index, const AnswerLetters& letters) {
    AnswerDrawing sheet;
    const int beside = letters.ems(1.3);
    const TextStyle style = letters.plain(0.85, letters.width_px - 2 * beside);
    struct Row {
        AnswerDrawing cap;
        glm::ivec2 words{0};
        int top = 0, high = 0;
    };
    std::vector<Row> rows;
    int top = 0, wide = 0;
    for (const AnswerOption& option : item.options) {
        Row row{option.key == option.label ? AnswerDrawing() : lay_out_key_cap(option.key, letters, 0.7),
                size_of(option.label, style), top, 0};
        row.high = std::max({row.words.y, row.cap.size_px.y, letters.ems(1.3)});
        wide = std::max(wide, beside + row.words.x +
                                  (row.cap.size_px.x > 0 ? row.cap.size_px.x + letters.ems(0.5) : 0));
        top += row.high;
        rows.push_back(std::move(row));
    }
    const bool is_mirrored = !item.options.empty() && begins_at_the_right(item.options.front().label);
    const auto left_of = [&](int start, int width) { return is_mirrored ? wide - start - width : start; };
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const AnswerOption& option = item.options[i];
        Row& row = rows[i];
        const int radius = letters.ems(0.5);
        put_point(sheet, {left_of(0, 2 * radius) + radius, row.top + 0.5 * row.high}, option.is_chosen,
                  letters);
        if (!option.label.empty())
            sheet.write(option.label, style,
                        {left_of(beside, row.words.x), row.top + (row.high - row.words.y) / 2},
                        option.is_chosen ? 1.0 : 0.8);
        const glm::ivec2 cap = row.cap.size_px;
        sheet.add(std::move(row.cap), {left_of(beside + row.words.x + letters.ems(0.5), cap.x),
                                       row.top + (row.high - cap.y) / 2});
        sheet.targets.push_back(
            {{0.0, static_cast<double>(row.top), static_cast<double>(wide), static_cast<double>(row.high)},
             {.item = index, .option = static_cast<int>(i)},
             {},
             {}});
    }
    sheet.size_px = {wide, top};
    return sheet;
}

} // namespace

int length_for_ends(const std::vector<std::string>& ends, int wanted_px, const AnswerLetters& letters) {
    if (ends.size() < 2)
        return std::min(wanted_px, letters.width_px - letters.ems(1.0));
    const TextStyle style = letters.plain(label_size, letters.ems(12.0));
    int widest = 0;
    for (const std::string& end : ends)
        widest = std::max(widest, size_of(end, style).x);
    const int gaps = static_cast<int>(ends.size()) - 1;
    const int apart = gaps * (widest + letters.ems(end_gap));
    // Half of an end stands beyond the line on each side.
    const int most =
        letters.width_px - std::min(widest, std::max(letters.ems(least_end), letters.width_px / 4));
    return std::clamp(std::max(wanted_px, apart), 1, std::max(1, most));
}

int put_ends(AnswerDrawing& sheet, const std::vector<std::string>& ends, int left_px, int length_px,
             int top_px, const AnswerLetters& letters) {
    if (ends.empty())
        return 0;
    const int gaps = std::max(1, static_cast<int>(ends.size()) - 1);
    const int beyond = std::max(0, letters.width_px - length_px);
    const int wrap = std::max(letters.ems(1.5),
                              std::min({letters.ems(12.0), beyond, length_px / gaps - letters.ems(0.4)}));
    const TextStyle style = letters.plain(label_size, wrap);
    int high = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        if (ends[i].empty())
            continue;
        const int width = size_of(ends[i], style).x;
        const int middle =
            left_px +
            static_cast<int>(std::lround(static_cast<double>(length_px) * static_cast<double>(i) / gaps));
        high = std::max(high, sheet.write(ends[i], style, {middle - width / 2, top_px}, 0.8).y);
    }
    return high;
}

AnswerDrawing lay_out_steps(const AnswerItem& item, int index, const AnswerLetters& letters) {
    const int count = static_cast<int>(item.options.size());
    AnswerDrawing sheet;
    if (count == 0)
        return sheet;
    const TextStyle style = letters.plain(label_size, letters.width_px);
    int widest_label = 0, widest_word = 0;
    for (const AnswerOption& option : item.options) {
        widest_label = std::max(widest_label, size_of(option.label, style).x);
        widest_word = std::max(widest_word, widest_word_px(option.label, style));
        widest_word = std::max(widest_word, lay_out_key_cap(option.key, letters, 1.0).size_px.x);
    }
    const int gap = letters.ems(0.4), most = letters.width_px / count;
    if (widest_word + gap > most || most < letters.ems(1.0))
        return lay_out_list(item, index, letters);
    int step = std::clamp(widest_label + gap, std::min(most, letters.ems(least_step)),
                          std::min(most, std::max(widest_word + gap, letters.ems(widest_step))));
    if (count > 1)
        step = std::clamp(length_for_ends(item.ends, step * (count - 1), letters) / (count - 1), 1, most);
    const int length = step * (count - 1), row = letters.ems(1.2);
    const double middle = 0.5 * row;
    // From point to point, so that it is not seen within them.
    const double radius = point_radius * letters.body.line_height_px;
    for (int i = 0; i + 1 < count && step > 2.0 * radius; ++i)
        sheet.shapes.push_back({ScaleShape::Kind::line,
                                {i * step + radius, middle, step - 2.0 * radius, 0.0},
                                0.35,
                                stroke_of(letters),
                                0.0});
    int words_high = 0;
    for (int i = 0; i < count; ++i) {
        const AnswerOption& option = item.options[static_cast<std::size_t>(i)];
        put_point(sheet, {static_cast<double>(i * step), middle}, option.is_chosen, letters);
        AnswerDrawing words = words_below(option, std::max(8, step - gap / 2), letters);
        const glm::ivec2 size = words.size_px;
        words_high = std::max(words_high, size.y);
        sheet.add(std::move(words), {i * step - size.x / 2, row});
    }
    int high = row + words_high;
    if (const int ends = put_ends(sheet, item.ends, 0, length, high + letters.ems(0.1), letters); ends > 0)
        high += letters.ems(0.1) + ends;
    for (int i = 0; i < count; ++i)
        sheet.targets.push_back(
            {{(i - 0.5) * step, 0.0, static_cast<double>(step), static_cast<double>(row + words_high)},
             {.item = index, .option = i},
             {},
             {}});
    // All of it to the right of its left edge: half of the outer words stand beyond the points.
    int left = -step / 2, right = length + step / 2;
    for (const AnswerDrawing::Text& text : sheet.texts) {
        left = std::min(left, text.origin_px.x);
        right = std::max(right, text.origin_px.x + text.size_px.x);
    }
    // The middle of the scale is the middle of the sheet.
    const int half = std::max(length / 2 - left, right - length / 2);
    AnswerDrawing whole;
    whole.add(std::move(sheet), {half - length / 2, 0});
    whole.size_px = {2 * half, high};
    return whole;
}

AnswerDrawing lay_out_line(const AnswerItem& item, int index, const AnswerLetters& letters) {
    const int length =
        length_for_ends(item.ends, std::min(letters.width_px * 3 / 4, letters.ems(longest_scale)), letters);
    const double em = letters.body.line_height_px, line = stroke_of(letters);
    const TextStyle style = letters.plain(label_size, letters.ems(12.0));
    AnswerDrawing sheet;
    // Room above the line for the marker's value, also before it was touched.
    const int label_px = item.marker_label ? measure_text("Xg", style).size_px.y : 0,
              reach = letters.ems(0.9);
    const double middle = label_px + reach;
    const auto upright = [&](double x, double half, double strength, double width) {
        sheet.shapes.push_back(
            {ScaleShape::Kind::line, {x, middle - half, 0.0, 2.0 * half}, strength, width, 0.0});
    };
    sheet.shapes.push_back(
        {ScaleShape::Kind::line, {0.0, middle, static_cast<double>(length), 0.0}, 0.7, line, 0.0});
    for (const double end : {0.0, static_cast<double>(length)})
        upright(end, 0.4 * em, 0.7, line);
    for (int i = 0; i < item.ticks; ++i)
        upright(item.ticks == 1 ? 0.5 * length : static_cast<double>(length) * i / (item.ticks - 1),
                0.25 * em, 0.5, line);
    int high = label_px + 2 * reach;
    high += put_ends(sheet, item.ends, 0, length, high, letters);
    sheet.targets.push_back({{-em, static_cast<double>(label_px), length + 2.0 * em, 2.0 * reach},
                             {.item = index},
                             0.0,
                             static_cast<double>(length)});
    int left = -letters.ems(1.0), right = length + letters.ems(1.0);
    for (const AnswerDrawing::Text& text : sheet.texts) {
        left = std::min(left, text.origin_px.x);
        right = std::max(right, text.origin_px.x + text.size_px.x);
    }
    if (item.marker) {
        const double x = std::clamp(*item.marker, 0.0, 1.0) * length;
        const double wide = std::max(3.0, 0.24 * em);
        sheet.shapes.push_back({ScaleShape::Kind::fill,
                                {x - 0.5 * wide, middle - 0.75 * em, wide, 1.5 * em},
                                1.0,
                                1.0,
                                0.5 * wide});
        if (item.marker_label && !item.marker_label->empty()) {
            const int width = size_of(*item.marker_label, style).x;
            // It does not reach beyond what else stands there: nothing moves with it.
            sheet.write(
                *item.marker_label, style,
                {std::clamp(static_cast<int>(x) - width / 2, left, std::max(left, right - width)), 0});
        }
    }
    const int half = std::max(length / 2 - left, right - length / 2);
    AnswerDrawing whole;
    whole.add(std::move(sheet), {half - length / 2, 0});
    whole.size_px = {2 * half, high};
    return whole;
}

} // namespace overt
