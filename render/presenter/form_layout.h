/// A form on the screen: a panel of two columns, labels and values, of which a row is being filled in. It has
/// the same size whatever is typed and chosen. Where labels are written from right to left, so is the panel.
#pragma once

#include <span>
#include <vector>

#include "experiment/ports/presenter.h"
#include "render/image/text_layout.h"

namespace overt {

class FormLayout {
  public:
    /// `style`: of the letters; its width is what the panel may have. `rows` must outlive this.
    FormLayout(std::span<const FormRow> rows, const TextStyle& style);

    glm::ivec2 size_px() const { return size_px_; }
    int unknown_glyphs() const { return unknown_glyphs_; }

    void put_on(InkCanvas& canvas, glm::ivec2 corner) const;

  private:
    /// A choice and its place in the value's column, from the side where the form begins.
    struct Chip {
        std::string text;
        int start_px = 0, top_px = 0, width_px = 0;
        bool is_end = false; ///< of a scale: words, not a choice
    };
    struct RowPlace {
        int top_px = 0, height_px = 0;
        std::vector<Chip> chips;
    };
    void place_chips(const FormRow& row, RowPlace& place);
    void put_value(InkCanvas& canvas, const FormRow& row, const RowPlace& place, glm::ivec2 corner) const;
    /// The left edge of something `width` wide that begins `start` from where the form begins.
    int left_of(int start, int width) const { return at_the_right_ ? size_px_.x - start - width : start; }

    std::span<const FormRow> rows_;
    TextStyle style_, label_style_, value_style_;
    bool at_the_right_ = false;
    int em_px_ = 0, line_px_ = 0, label_px_ = 0, value_px_ = 0;
    glm::ivec2 size_px_{0};
    std::vector<RowPlace> places_;
    int unknown_glyphs_ = 0;
};

} // namespace overt
