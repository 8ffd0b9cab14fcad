#include "render/presenter/answer_parts.h"

#include <algorithm>
#include <sstream>

namespace overt {

namespace {

// Shares of a letter's height.
constexpr double option_size = 0.85, cap_size = 0.7, box_padding = 0.5, box_gap = 0.6;
constexpr double longest_question = 34.0; // some sixty letters, of which eyes find the next line's beginning
constexpr double widest_picture = 9.0, least_picture = 3.0;
constexpr double number_width = 9.0, text_width = 30.0;
constexpr int text_lines = 4, most_lines = 2; // of a text, and of an option with others beside it

std::string written_on(const std::string& key) {
    constexpr std::pair<std::string_view, std::string_view> arrows[] = {
        {"left", "←"}, {"right", "→"}, {"up", "↑"}, {"down", "↓"}};
    for (const auto& [name, arrow] : arrows)
        if (key == name)
            return std::string(arrow);
    if (key.size() == 1 && key[0] >= 'a' && key[0] <= 'z')
        return std::string(1, static_cast<char>(key[0] - 'a' + 'A'));
    return key;
}

/// What stands in an option's box: its picture above its key and its label.
struct OptionContent {
    AnswerDrawing sheet;
    bool fits = true; ///< no word of its label is wider than the box
    int lines = 0;    ///< of its label
};

OptionContent content_of(const AnswerOption& option, const AnswerLetters& letters, int inner_px) {
    OptionContent content;
    AnswerDrawing& sheet = content.sheet;
    const double strength = option.is_chosen ? 1.0 : 0.8;
    int top = 0;
    if (!option.picture.empty()) {
        const glm::ivec2 has = letters.pictures->of(option.picture).size_px;
        const double scale =
            std::min(inner_px, letters.ems(widest_picture)) / static_cast<double>(std::max(has.x, has.y));
        const glm::ivec2 size = glm::max(glm::ivec2(scale * glm::dvec2(has)), glm::ivec2(1));
        sheet.pictures.push_back({option.picture, {0, 0}, size});
        sheet.shapes.push_back({AnswerDrawing::Shape::Kind::outline,
                                {0.0, 0.0, static_cast<double>(size.x), static_cast<double>(size.y)},
                                0.2,
                                1.0,
                                0.0});
        sheet.size_px = size;
        top = size.y + letters.ems(option.label.empty() && option.key.empty() ? 0.0 : 0.3);
    }
    AnswerDrawing cap = lay_out_key_cap(option.key, letters, strength);
    const int beside = cap.size_px.x > 0 ? cap.size_px.x + letters.ems(option.label.empty() ? 0.0 : 0.4) : 0;
    const TextStyle style = letters.plain(option_size, std::max(8, inner_px - beside));
    const glm::ivec2 words = size_of(option.label, style);
    content.lines = option.label.empty() ? 0 : measure_text(option.label, style).lines;
    content.fits = widest_word_px(option.label, style) <= style.wrap_width_px &&
                   (option.picture.empty() || inner_px >= letters.ems(least_picture));
    const glm::ivec2 row(beside + words.x, std::max(cap.size_px.y, words.y));
    const int wide = std::max(sheet.size_px.x, row.x);
    for (AnswerDrawing::Picture& picture : sheet.pictures)
        sheet.shapes.front().box.x = picture.origin_px.x = (wide - picture.size_px.x) / 2;
    const bool is_mirrored = !option.label.empty() && begins_at_the_right(option.label);
    const int left = (wide - row.x) / 2;
    const glm::ivec2 cap_size_px = cap.size_px;
    sheet.add(std::move(cap),
              {is_mirrored ? left + row.x - cap_size_px.x : left, top + (row.y - cap_size_px.y) / 2});
    if (!option.label.empty())
        sheet.write(option.label, style, {is_mirrored ? left : left + beside, top + (row.y - words.y) / 2},
                    strength);
    sheet.size_px = {wide, top + row.y};
    return content;
}

} // namespace

TextStyle AnswerLetters::plain(double size, int wrap_px) const {
    TextStyle style = body;
    style.line_height_px = std::max(6, ems(size));
    style.wrap_width_px = wrap_px;
    style.has_marks = style.bold = style.one_line = false;
    style.centred = true;
    return style;
}

glm::ivec2 size_of(const std::string& words, const TextStyle& style) {
    return words.empty() ? glm::ivec2(0) : measure_text(words, style).size_px;
}

int widest_word_px(const std::string& words, const TextStyle& style) {
    TextStyle unwrapped = style;
    unwrapped.wrap_width_px = 100 * style.line_height_px;
    std::istringstream each(words);
    int widest = 0;
    for (std::string word; each >> word;)
        widest = std::max(widest, measure_text(word, unwrapped).size_px.x);
    return widest;
}

AnswerDrawing lay_out_key_cap(const std::string& key, const AnswerLetters& letters, double strength) {
    AnswerDrawing sheet;
    if (key.empty())
        return sheet;
    const TextStyle style = letters.plain(cap_size, letters.ems(20.0));
    const int padding = letters.ems(0.3);
    const glm::ivec2 words = sheet.write(written_on(key), style, {padding, 0}, strength);
    const int width = std::max(words.x + 2 * padding, words.y);
    sheet.texts.back().origin_px.x = (width - words.x) / 2;
    const double line = std::max(1.0, letters.body.line_height_px / 24.0);
    sheet.shapes.push_back({AnswerDrawing::Shape::Kind::outline,
                            {0.5 * line, 0.5 * line, width - line, words.y - line},
                            0.6 * strength,
                            line,
                            0.2 * letters.body.line_height_px});
    sheet.size_px = {width, words.y};
    return sheet;
}

AnswerDrawing lay_out_words(const std::string& words, const AnswerLetters& letters,
                            AnswerItem::Colour colour) {
    AnswerDrawing sheet;
    if (words.empty())
        return sheet;
    TextStyle style = letters.body;
    style.has_marks = true;
    style.wrap_width_px = std::min(letters.width_px, letters.ems(longest_question)) / 2 * 2;
    style.centred = measure_text(words, style).longest_paragraph <= 2;
    sheet.size_px = sheet.write(words, style, {0, 0});
    sheet.texts.back().colour = colour;
    return sheet;
}

AnswerDrawing lay_out_choice(const AnswerItem& item, int index, const AnswerLetters& letters) {
    const int count = static_cast<int>(item.options.size());
    const int padding = letters.ems(box_padding), gap = letters.ems(box_gap);
    const bool has_boxes = item.kind != AnswerItem::Kind::keys;
    // As many beside each other as have room for their words.
    std::vector<OptionContent> contents;
    int columns = count;
    for (; columns >= 1; --columns) {
        const int inner = (letters.width_px - (columns - 1) * gap) / columns - 2 * padding;
        contents.clear();
        bool all_fit = true;
        for (const AnswerOption& option : item.options) {
            contents.push_back(content_of(option, letters, inner));
            all_fit = all_fit && contents.back().fits && contents.back().lines <= most_lines;
        }
        const int rows = (count + columns - 1) / columns;
        // A last row with a single one looks like an afterthought.
        const bool is_even = rows == 1 || columns == 1 || count % columns != 1;
        if ((all_fit && is_even) || columns == 1)
            break;
    }
    AnswerDrawing sheet;
    if (count == 0)
        return sheet;
    glm::ivec2 inside(0);
    int all_px = 0;
    for (const OptionContent& content : contents) {
        inside = glm::max(inside, content.sheet.size_px);
        all_px += content.sheet.size_px.x + 2 * padding + gap;
    }
    // Boxes of one width, unless they only fit with their own.
    const bool is_of_one_width =
        columns < count || columns * (inside.x + 2 * padding + gap) - gap <= letters.width_px;
    const double line = std::max(1.0, letters.body.line_height_px / 24.0);
    const int high = inside.y + letters.ems(0.5);
    int left = 0, top = 0;
    for (int i = 0; i < count; ++i) {
        OptionContent& content = contents[static_cast<std::size_t>(i)];
        const AnswerOption& option = item.options[static_cast<std::size_t>(i)];
        const int wide = (is_of_one_width ? inside.x : content.sheet.size_px.x) + 2 * padding;
        if (i > 0 && i % columns == 0) {
            left = 0;
            top += high + gap;
        }
        const InkBox box{left + line, top + line, wide - 2 * line, high - 2 * line};
        const double round = 0.3 * letters.body.line_height_px;
        if (has_boxes && option.is_chosen)
            sheet.shapes.push_back({AnswerDrawing::Shape::Kind::fill, box, 0.16, 1.0, round});
        if (has_boxes)
            sheet.shapes.push_back({AnswerDrawing::Shape::Kind::outline, box, option.is_chosen ? 1.0 : 0.35,
                                    option.is_chosen ? 2.0 * line : line, round});
        sheet.targets.push_back({box, {.item = index, .option = i}, {}, {}});
        const glm::ivec2 size = content.sheet.size_px;
        sheet.add(std::move(content.sheet), {left + (wide - size.x) / 2, top + (high - size.y) / 2});
        left += wide + gap;
        sheet.size_px = glm::max(sheet.size_px, glm::ivec2(left - gap, top + high));
    }
    return sheet;
}

AnswerDrawing lay_out_entry(const AnswerItem& item, int index, const AnswerLetters& letters) {
    const bool is_number = item.kind == AnswerItem::Kind::number;
    const int padding = letters.ems(0.4);
    TextStyle unit_style = letters.plain(option_size, letters.ems(20.0));
    const glm::ivec2 unit = size_of(item.unit, unit_style);
    const int beside = unit.x > 0 ? unit.x + letters.ems(0.4) : 0;
    const int wide = std::min(letters.width_px - beside, letters.ems(is_number ? number_width : text_width));
    TextStyle style = letters.plain(option_size, std::max(8, wide - 2 * padding));
    style.centred = false;
    const int line_px = measure_text("Xg", style).size_px.y, lines = is_number ? 1 : text_lines;
    // The height of so many lines as the layout sets them.
    std::string most = "Xg";
    for (int i = 1; i < lines; ++i)
        most += "\nXg";
    const int high = std::max(line_px, measure_text(most, style).size_px.y) + letters.ems(0.4);
    AnswerDrawing sheet;
    const double line = std::max(1.0, letters.body.line_height_px / 24.0);
    const InkBox box{line, line, wide - 2 * line, high - 2 * line};
    const double round = 0.25 * letters.body.line_height_px;
    if (item.is_here)
        sheet.shapes.push_back({AnswerDrawing::Shape::Kind::fill, box, 0.1, 1.0, round});
    sheet.shapes.push_back({AnswerDrawing::Shape::Kind::outline, box, item.is_here ? 0.8 : 0.4, line, round});
    sheet.targets.push_back({box, {.item = index}, {}, {}});
    const TextPart seen = lines_around(item.typed, style, item.caret, lines);
    const std::string shown = item.typed.substr(seen.begin, seen.end - seen.begin);
    const glm::ivec2 size = size_of(shown, style);
    const bool is_at_the_right =
        begins_at_the_right(item.typed.empty() && !is_number ? item.question : item.typed);
    const int left = is_at_the_right ? wide - padding - std::max(size.x, 4) : padding;
    sheet.write(shown, style, {left, letters.ems(0.2)});
    if (item.is_here)
        sheet.texts.back().caret = item.caret - std::min(item.caret, seen.begin);
    sheet.size_px = {wide, high};
    if (unit.x > 0) {
        sheet.write(item.unit, unit_style, {wide + letters.ems(0.4), (high - unit.y) / 2}, 0.8);
        sheet.size_px.x += beside;
    }
    return sheet;
}

AnswerDrawing lay_out_accept(const std::string& words, bool can_accept, const AnswerLetters& letters) {
    AnswerDrawing sheet;
    const TextStyle style = letters.plain(option_size, letters.width_px - letters.ems(2.0));
    const glm::ivec2 inside = size_of(words, style);
    sheet.size_px = inside + glm::ivec2(letters.ems(1.8), letters.ems(0.5));
    const double line = std::max(1.0, letters.body.line_height_px / 24.0);
    const InkBox box{line, line, sheet.size_px.x - 2 * line, sheet.size_px.y - 2 * line};
    const double round = 0.35 * letters.body.line_height_px;
    if (can_accept)
        sheet.shapes.push_back({AnswerDrawing::Shape::Kind::fill, box, 0.16, 1.0, round});
    sheet.shapes.push_back({AnswerDrawing::Shape::Kind::outline, box, can_accept ? 1.0 : 0.3,
                            can_accept ? 2.0 * line : line, round});
    sheet.write(words, style, (sheet.size_px - inside) / 2, can_accept ? 1.0 : 0.45);
    sheet.targets.push_back({box, {.is_accept = true}, {}, {}});
    return sheet;
}

} // namespace overt
