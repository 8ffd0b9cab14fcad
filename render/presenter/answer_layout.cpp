#include "render/presenter/answer_layout.h"

#include <algorithm>

namespace overt {

namespace {

// Shares of a letter's height.
constexpr double below_question = 0.7, between_items = 0.6, above_accept = 0.7;
constexpr double band_padding = 0.5, message_size = 0.75;

bool is_answered_with_keys(const AnswerItem& item) {
    return item.kind != AnswerItem::Kind::keys && item.kind != AnswerItem::Kind::notice;
}

AnswerDrawing means_of(const AnswerItem& item, int index, const AnswerLetters& letters) {
    switch (item.kind) {
    case AnswerItem::Kind::keys:
    case AnswerItem::Kind::choice:
        return lay_out_choice(item, index, letters);
    case AnswerItem::Kind::steps:
        return lay_out_steps(item, index, letters);
    case AnswerItem::Kind::line:
        return lay_out_line(item, index, letters);
    case AnswerItem::Kind::number:
    case AnswerItem::Kind::text:
        return lay_out_entry(item, index, letters);
    case AnswerItem::Kind::notice:
        break;
    }
    return {};
}

/// Parts below each other, in the middle of the width.
class Column {
  public:
    explicit Column(int width_px) { sheet_.size_px.x = width_px; }

    void put(AnswerDrawing part, int gap_px) {
        if (part.size_px.y == 0)
            return;
        if (sheet_.size_px.y > 0)
            sheet_.size_px.y += gap_px;
        const glm::ivec2 size = part.size_px;
        sheet_.add(std::move(part), {(sheet_.size_px.x - size.x) / 2, sheet_.size_px.y});
        sheet_.size_px.y += size.y;
    }
    void leave(int gap_px) { sheet_.size_px.y += gap_px; }
    AnswerDrawing& sheet() { return sheet_; }

  private:
    AnswerDrawing sheet_;
};

/// The question, how it is answered, and what is missing.
AnswerDrawing lay_out_item(const AnswerItem& item, int index, const AnswerLetters& letters) {
    Column column(letters.width_px);
    column.put(lay_out_words(item.question, letters, item.colour), 0);
    column.put(means_of(item, index, letters), letters.ems(below_question));
    if (is_answered_with_keys(item)) {
        // Room for a line, also while nothing is missing; what is too long for it is set smaller.
        TextStyle style = letters.plain(message_size, letters.width_px);
        const int high = measure_text("Xg", style).size_px.y;
        while (size_of(item.message, style).y > high && style.line_height_px > 8)
            style.line_height_px = style.line_height_px * 9 / 10;
        AnswerDrawing message;
        message.size_px = {size_of(item.message, style).x, high};
        if (!item.message.empty())
            message.write(item.message, style, {0, 0});
        column.put(std::move(message), letters.ems(0.1));
    }
    return std::move(column.sheet());
}

/// Which of several items is answered now: a band behind it, and a bar where its words begin.
void mark_item(AnswerDrawing& sheet, const AnswerItem& item, int left, int width, int top, int height,
               const AnswerLetters& letters) {
    const double em = letters.body.line_height_px, bar = 0.14 * em;
    const InkBox band{static_cast<double>(left), static_cast<double>(top), static_cast<double>(width),
                      static_cast<double>(height)};
    const bool is_mirrored = !item.question.empty() && begins_at_the_right(item.question);
    sheet.shapes.push_back({AnswerDrawing::Shape::Kind::fill, band, 0.06, 1.0, 0.25 * em});
    sheet.shapes.push_back({AnswerDrawing::Shape::Kind::fill,
                            {is_mirrored ? band.x + band.width - bar : band.x, band.y, bar, band.height},
                            0.9,
                            1.0,
                            0.0});
}

} // namespace

AnswerDrawing lay_out_answers(const AnswerView& view, const AnswerLetters& letters) {
    const auto answered = std::ranges::count_if(view.items, is_answered_with_keys);
    const bool marks_items = answered > 1;
    Column column(letters.width_px);
    AnswerLetters inner = letters;
    const int padding = marks_items ? letters.ems(band_padding) : 0;
    inner.width_px -= 2 * padding;
    for (std::size_t i = 0; i < view.items.size(); ++i) {
        const AnswerItem& item = view.items[i];
        AnswerDrawing part = lay_out_item(item, static_cast<int>(i), inner);
        if (i > 0)
            column.leave(letters.ems(between_items));
        const int top = column.sheet().size_px.y;
        if (marks_items && item.is_here && is_answered_with_keys(item))
            mark_item(column.sheet(), item, 0, letters.width_px, top - padding / 2, part.size_px.y + padding,
                      letters);
        column.put(std::move(part), 0);
    }
    if (!view.accept.empty())
        column.put(lay_out_accept(view.accept, view.can_accept, letters), letters.ems(above_accept));
    return std::move(column.sheet());
}

} // namespace overt
