#include "render/presenter/form_layout.h"

#include <algorithm>
#include <string>

namespace overt {

namespace {

// Shares of a letter's height.
constexpr double panel_padding = 0.9, row_padding = 0.45, column_gap = 1.4, chip_padding = 0.4;
/// Room for what is typed, in letters' heights: some twenty letters.
constexpr double typed_width = 12.0;
constexpr double label_share = 0.42; // of the panel's inner width, at most

int even(int size) { return (size + 1) & ~1; }

} // namespace

FormLayout::FormLayout(std::span<const FormRow> rows, const TextStyle& style)
    : rows_(rows), style_(style), em_px_(style.line_height_px) {
    const auto ems = [this](double count) { return static_cast<int>(count * em_px_); };
    style_.centred = false;
    label_style_ = value_style_ = style_;
    label_style_.has_marks = true;
    label_style_.wrap_width_px = static_cast<int>(label_share * style.wrap_width_px);
    value_style_.one_line = true;
    at_the_right_ = !rows.empty() && begins_at_the_right(rows.front().label);
    line_px_ = measure_text("Xg", style_).size_px.y;
    for (const FormRow& row : rows_) {
        const TextMeasure label = measure_text(row.label, label_style_);
        label_px_ = std::max(label_px_, label.size_px.x);
        unknown_glyphs_ += label.unknown_glyphs;
    }
    const int inner = style.wrap_width_px - 2 * ems(panel_padding);
    value_px_ = std::min(inner - label_px_ - ems(column_gap), ems(typed_width));
    // Choices stand in one line if there is room for them.
    for (const FormRow& row : rows_) {
        int all = 0;
        std::vector<std::string> shown = row.choices;
        shown.insert(shown.end(), row.ends.begin(), row.ends.end());
        for (const std::string& choice : shown)
            all += measure_text(choice, style_).size_px.x + 3 * ems(chip_padding);
        value_px_ = std::clamp(all, value_px_, std::max(value_px_, inner - label_px_ - ems(column_gap)));
    }
    value_style_.wrap_width_px = value_px_;
    int top = ems(panel_padding);
    for (const FormRow& row : rows_) {
        RowPlace place;
        place.top_px = top;
        place.height_px = measure_text(row.label, label_style_).size_px.y;
        if (row.choices.empty())
            place.height_px = std::max(place.height_px, line_px_);
        else
            place_chips(row, place);
        place.height_px += 2 * ems(row_padding);
        top += place.height_px;
        places_.push_back(std::move(place));
    }
    size_px_ = {even(label_px_ + ems(column_gap) + value_px_ + 2 * ems(panel_padding)),
                even(top + ems(panel_padding))};
}

void FormLayout::place_chips(const FormRow& row, RowPlace& place) {
    const int padding = static_cast<int>(chip_padding * em_px_);
    const auto width_of = [&](const std::string& words) {
        const TextMeasure measure = measure_text(words, value_style_);
        unknown_glyphs_ += measure.unknown_glyphs;
        return measure.size_px.x + 2 * padding;
    };
    int start = 0, line = 0;
    const auto put = [&](const std::string& words, int width, bool is_end) {
        if (start > 0 && start + width > value_px_) {
            start = 0;
            ++line;
        }
        place.chips.push_back({words, start, line * line_px_ * 5 / 4, width, is_end});
        start += width + padding;
    };
    std::vector<int> widths;
    int all = -padding;
    for (const std::string& choice : row.choices)
        all += widths.emplace_back(width_of(choice)) + padding;
    const bool is_scale = row.ends.size() == 2;
    const int first_end = is_scale ? width_of(row.ends[0]) : 0,
              last_end = is_scale ? width_of(row.ends[1]) : 0;
    // A scale's words stand before its first step and after its last, or below them where there is no room.
    const bool is_in_line = is_scale && all + first_end + last_end + 2 * padding <= value_px_;
    if (is_in_line)
        put(row.ends[0], first_end, true);
    for (std::size_t i = 0; i < widths.size(); ++i)
        put(row.choices[i], widths[i], false);
    if (is_in_line) {
        put(row.ends[1], last_end, true);
    } else if (is_scale) {
        const int end = std::max(std::min(start - padding, value_px_),
                                 std::min(first_end + padding + last_end, value_px_));
        start = 0;
        ++line;
        put(row.ends[0], first_end, true);
        start = std::max(start, end - last_end);
        put(row.ends[1], last_end, true);
    }
    place.height_px = std::max(place.height_px, line * line_px_ * 5 / 4 + line_px_);
}

void FormLayout::put_on(InkCanvas& canvas, glm::ivec2 corner) const {
    const double em = em_px_, line = std::max(1.0, em / 24.0);
    canvas.outline({corner.x + line, corner.y + line, size_px_.x - 2 * line, size_px_.y - 2 * line}, 0.45,
                   line, 0.4 * em);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const FormRow& row = rows_[i];
        const RowPlace& place = places_[i];
        const double edge = 0.35 * em;
        const InkBox band{corner.x + edge, static_cast<double>(corner.y + place.top_px),
                          size_px_.x - 2 * edge, static_cast<double>(place.height_px)};
        if (row.is_here) {
            canvas.fill(band, 0.08, 0.25 * em);
            const double bar = 0.16 * em;
            canvas.fill({at_the_right_ ? band.x + band.width - bar : band.x, band.y, bar, band.height}, 1.0);
        }
        if (row.is_at_fault)
            canvas.outline(band, 0.9, 2.0 * line, 0.25 * em);
        const TextMeasure label = measure_text(row.label, label_style_);
        put_text(canvas, row.label, label_style_,
                 {corner.x + left_of(static_cast<int>(panel_padding * em), label.size_px.x),
                  corner.y + place.top_px + static_cast<int>(row_padding * em)},
                 row.is_here ? 1.0 : 0.8);
        put_value(canvas, row, place, corner);
    }
}

void FormLayout::put_value(InkCanvas& canvas, const FormRow& row, const RowPlace& place,
                           glm::ivec2 corner) const {
    const double em = em_px_, line = std::max(1.0, em / 24.0);
    const int column = static_cast<int>(panel_padding * em) + label_px_ + static_cast<int>(column_gap * em);
    const int top = corner.y + place.top_px + static_cast<int>(row_padding * em);
    for (const Chip& chip : place.chips) {
        const int left = corner.x + left_of(column + chip.start_px, chip.width_px);
        const InkBox box{static_cast<double>(left), static_cast<double>(top + chip.top_px),
                         static_cast<double>(chip.width_px), static_cast<double>(line_px_)};
        const bool is_chosen = !chip.is_end && chip.text == row.value;
        if (is_chosen)
            canvas.fill(box, 0.14, 0.3 * em);
        if (!chip.is_end)
            canvas.outline(box, is_chosen ? 1.0 : 0.35, is_chosen ? 2.0 * line : line, 0.3 * em);
        put_text(canvas, chip.text, value_style_,
                 {left + static_cast<int>(chip_padding * em), top + chip.top_px}, is_chosen ? 1.0 : 0.75);
    }
    if (!row.choices.empty())
        return;
    const std::string shown = row.value + (row.is_here ? "▏" : "");
    if (!shown.empty()) {
        const int width = measure_text(shown, value_style_).size_px.x;
        put_text(canvas, shown, value_style_, {corner.x + left_of(column, width), top});
    }
    // What is typed stands on a line, also while nothing is there yet.
    canvas.fill({static_cast<double>(corner.x + left_of(column, value_px_)),
                 static_cast<double>(top + line_px_), static_cast<double>(value_px_), line},
                0.45);
}

} // namespace overt
