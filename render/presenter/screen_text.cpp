#include "render/presenter/screen_text.h"
#include "render/presenter/setup_screens.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>

#include "render/image/text_markup.h"
#include "render/presenter/answer_layout.h"
#include "render/presenter/form_layout.h"
#include "render/presenter/validation_layout.h"

namespace overt {

namespace {

// Shares of the screen's size. What stands in the middle ends above the keys, and these above the meter.
constexpr double safe_width = 0.8, highest = 0.05, lowest = 0.79, keys_middle = 0.86, pages_middle = 0.93;
constexpr double widest_keys = 0.9, lowest_answer = 0.93;
constexpr double frame_inset = 0.025;
constexpr double meter_width = 0.2, meter_height = 0.05; // a text's margin below is a twentieth of the screen

/// Of a line, in letters' heights: some sixty letters, of which eyes find the next line's beginning.
constexpr double longest_line = 34.0;
// Of the letters of a text.
constexpr double title_size = 1.35, form_size = 0.8, keys_size = 0.75, pages_size = 0.65;
// Of the screen's height, at most: what stands below must not meet.
constexpr double largest_keys = 0.033, largest_pages = 0.022;

constexpr int smallest_line_px = 8;

/// The rows that what stands in the middle has for itself.
struct Rows {
    int first = 0, end = 0;
};

TextStyle style_of(const ScreenGeometry& geometry, double text_height_deg) {
    TextStyle style;
    style.line_height_px =
        std::max(smallest_line_px, static_cast<int>(text_height_deg * geometry.px_per_deg_at_centre()));
    style.has_marks = true;
    return style;
}

TextStyle scaled(TextStyle style, double factor) {
    style.line_height_px = std::max(smallest_line_px, static_cast<int>(factor * style.line_height_px));
    return style;
}

/// The parts of a screen above each other, for one size of letters.
class Middle {
  public:
    Middle(const Screen& screen, const ScreenGeometry& geometry, const TextStyle& letters,
           AnswerPictures& pictures)
        : words_(split_title(screen.text)), body_(letters), title_(scaled(letters, title_size)),
          below_(scaled(letters, form_size)) {
        const int widest = static_cast<int>(safe_width * geometry.screen_px.x);
        body_.wrap_width_px =
            std::min(widest, static_cast<int>(longest_line * letters.line_height_px)) / 2 * 2;
        title_.wrap_width_px = below_.wrap_width_px = widest / 2 * 2;
        title_.bold = true;
        gap_px_ = static_cast<int>(0.7 * letters.line_height_px);
        if (!words_.title.empty())
            add(measure_text(words_.title, title_), title_height_px_);
        if (screen.kind == Screen::Kind::form) {
            TextStyle of_form = below_;
            of_form.has_marks = false;
            of_form.wrap_width_px = widest / 2 * 2;
            form_.emplace(screen.rows, of_form);
            measure_.size_px = glm::ivec2(std::max(measure_.size_px.x, form_->size_px().x),
                                          measure_.size_px.y + form_->size_px().y + gap_px_);
            measure_.widest_line_px = std::max(measure_.widest_line_px, form_->size_px().x);
            measure_.unknown_glyphs += form_->unknown_glyphs();
            // The same room whatever is said there, so that the form stays in its place.
            measure_.size_px.y += 2 * measure_text("Xg", below_).size_px.y + gap_px_;
        } else if (!words_.body.empty()) {
            const TextMeasure centred = measure_text(words_.body, body_);
            body_.centred = centred.longest_paragraph <= 2;
            add(centred, body_height_px_);
        }
        if (screen.kind == Screen::Kind::answers) {
            answers_.emplace(lay_out_answers(screen.answers, {letters, widest / 2 * 2, &pictures}));
            TextMeasure measure;
            measure.size_px = answers_->size_px;
            measure.widest_line_px = answers_->size_px.x;
            measure.unknown_glyphs = answers_->unknown_glyphs;
            measure.lines = 1;
            int height = 0;
            add(measure, height);
            up_px_ = screen.answers.up_deg
                         ? std::optional(*screen.answers.up_deg * geometry.px_per_deg_at_centre())
                         : std::nullopt;
        }
    }

    const TextMeasure& measure() const { return measure_; }

    void put_on(InkCanvas& canvas, const Rows& rows) {
        const glm::ivec2 screen = canvas.size_px();
        const int up = static_cast<int>(up_px_.value_or(0.0));
        int top = std::min((screen.y - measure_.size_px.y) / 2 - up, rows.end - measure_.size_px.y);
        top = std::max(top, rows.first);
        if (!words_.title.empty()) {
            put_centred(canvas, words_.title, title_, top);
            top += title_height_px_ + gap_px_;
        }
        if (form_) {
            form_->put_on(canvas, {(screen.x - form_->size_px().x) / 2, top});
            top += form_->size_px().y + gap_px_;
            if (!words_.body.empty())
                put_centred(canvas, words_.body, below_, top);
        } else if (!words_.body.empty()) {
            put_centred(canvas, words_.body, body_, top);
            top += body_height_px_ + gap_px_;
        }
        if (answers_) {
            answers_corner_px_ = {(screen.x - answers_->size_px.x) / 2, top};
            answers_->put_on(canvas, answers_corner_px_);
        }
    }

    /// Of answers, once they were put there: what else is to be drawn, and what can be touched.
    void finish(PlacedPicture& placed, float grey, float background, AnswerPictures& pictures) const {
        if (!answers_)
            return;
        answers_->colour(placed.picture, placed.origin_px, answers_corner_px_, grey, background, pictures);
        AnswerDrawing on_screen;
        on_screen.add(*answers_, answers_corner_px_);
        placed.targets = std::move(on_screen.targets);
    }

  private:
    void add(const TextMeasure& part, int& height_px) {
        height_px = part.size_px.y;
        measure_.size_px =
            glm::ivec2(std::max(measure_.size_px.x, part.size_px.x),
                       measure_.size_px.y + part.size_px.y + (measure_.lines > 0 ? gap_px_ : 0));
        measure_.lines += part.lines;
        measure_.widest_line_px = std::max(measure_.widest_line_px, part.widest_line_px);
        measure_.longest_paragraph = std::max(measure_.longest_paragraph, part.longest_paragraph);
        measure_.unknown_glyphs += part.unknown_glyphs;
    }

    static void put_centred(InkCanvas& canvas, const std::string& text, const TextStyle& style, int top) {
        const int width = measure_text(text, style).size_px.x;
        put_text(canvas, text, style, {(canvas.size_px().x - width) / 2, top});
    }

    TitledText words_;
    TextStyle body_, title_, below_;
    std::optional<FormLayout> form_;
    std::optional<AnswerDrawing> answers_;
    glm::ivec2 answers_corner_px_{0};
    std::optional<double> up_px_; ///< of the middle of all of it, from the middle of the screen
    TextMeasure measure_;
    int gap_px_ = 0, title_height_px_ = 0, body_height_px_ = 0;
};

/// Keys as caps, each with what it does, in a line at the foot; in several where one is too short even for
/// the smallest letters.
class KeyLines {
  public:
    KeyLines(const std::vector<KeyHint>& keys, glm::ivec2 screen_px, TextStyle style)
        : keys_(&keys), screen_px_(screen_px), style_(style) {
        style_.wrap_width_px = static_cast<int>(widest_keys * screen_px.x);
        style_.one_line = true;
        for (;;) {
            lay_out();
            if (lines_.size() <= 1 || style_.line_height_px <= smallest_line_px)
                break;
            style_ = scaled(style_, 0.9);
        }
        // The last line stands where the only one would.
        top_ = static_cast<int>(keys_middle * screen_px.y) - line_px_ / 2 -
               static_cast<int>(std::max<std::size_t>(lines_.size(), 1) - 1) * line_px_;
    }

    int top() const { return top_; }
    int end() const { return top_ + static_cast<int>(lines_.size()) * line_px_; }

    void put_on(InkCanvas& canvas, bool at_the_right) const {
        for (std::size_t i = 0; i < lines_.size(); ++i)
            put_line(canvas, lines_[i], top_ + static_cast<int>(i) * line_px_, at_the_right);
    }

  private:
    struct Part {
        const KeyHint* hint;
        int key_px, does_px, all_px;
    };
    struct Line {
        std::vector<Part> parts;
        int all_px = 0;
    };

    int ems(double count) const { return static_cast<int>(count * style_.line_height_px); }

    void lay_out() {
        lines_.clear();
        line_px_ = 0;
        for (const KeyHint& hint : *keys_) {
            const TextMeasure key = measure_text(hint.key, style_), does = measure_text(hint.does, style_);
            line_px_ = std::max({line_px_, key.size_px.y, does.size_px.y});
            const Part part{&hint, key.size_px.x, does.size_px.x,
                            (hint.key.empty() ? 0 : key.size_px.x + ems(1.2)) + does.size_px.x};
            const int with_it = lines_.empty() ? 0 : lines_.back().all_px + ems(2.5) + part.all_px;
            if (lines_.empty() || with_it > widest_keys * screen_px_.x)
                lines_.push_back({{part}, part.all_px});
            else {
                lines_.back().parts.push_back(part);
                lines_.back().all_px = with_it;
            }
        }
        line_px_ += std::max(2, line_px_ / 8);
    }

    void put_line(InkCanvas& canvas, const Line& line, int top, bool at_the_right) const {
        int start = (screen_px_.x - line.all_px) / 2;
        const auto left_of = [&](int width) { return at_the_right ? screen_px_.x - start - width : start; };
        for (const Part& part : line.parts) {
            if (!part.hint->key.empty()) {
                const int cap = part.key_px + ems(0.7);
                const double stroke = std::max(1.0, style_.line_height_px / 20.0);
                canvas.outline({static_cast<double>(left_of(cap)), top - 0.05 * style_.line_height_px,
                                static_cast<double>(cap), line_px_ - 0.05 * style_.line_height_px},
                               0.6, stroke, 0.25 * style_.line_height_px);
                put_text(canvas, part.hint->key, style_, {left_of(cap) + ems(0.35), top}, 0.9);
                start += cap + ems(0.5);
            }
            put_text(canvas, part.hint->does, style_, {left_of(part.does_px), top}, 0.8);
            start += part.does_px + ems(2.5);
        }
    }

    const std::vector<KeyHint>* keys_;
    glm::ivec2 screen_px_;
    TextStyle style_;
    std::vector<Line> lines_;
    int line_px_ = 0, top_ = 0;
};

/// "2 / 5" above a line of which so much is filled.
/// Not above `first_row`.
void put_pages(InkCanvas& canvas, int page, int pages, const TextStyle& style, bool at_the_right,
               int first_row) {
    const glm::ivec2 screen = canvas.size_px();
    const std::string count = fmt::format("{} / {}", page, pages);
    const glm::ivec2 size = measure_text(count, style).size_px;
    const int middle = std::max(static_cast<int>(pages_middle * screen.y), first_row + size.y);
    put_text(canvas, count, style, {(screen.x - size.x) / 2, middle - size.y}, 0.8);
    const double width = 0.16 * screen.x, height = std::max(2.0, screen.y / 270.0),
                 left = 0.5 * (screen.x - width), done = width * page / pages;
    canvas.fill({left, middle + height, width, height}, 0.25);
    canvas.fill({at_the_right ? left + width - done : left, middle + height, done, height}, 0.8);
}

/// Around everything, with whom it is for at its top.
class TitledFrame {
  public:
    TitledFrame(const std::string& whom, glm::ivec2 screen_px, TextStyle style)
        : whom_(&whom), inset_(frame_inset * screen_px.y), style_(style) {
        style_.wrap_width_px = static_cast<int>(safe_width * screen_px.x) / 2 * 2;
        style_.one_line = true;
        size_px_ = measure_text(whom, style_).size_px;
    }

    /// Below its title.
    int end() const { return static_cast<int>(inset_) + size_px_.y; }

    void put_on(InkCanvas& canvas) const {
        const glm::dvec2 screen(canvas.size_px());
        const double line = std::max(3.0, screen.y / 200.0);
        canvas.outline({inset_, inset_, screen.x - 2 * inset_, screen.y - 2 * inset_}, 0.9, line, 2 * line);
        const int left = (canvas.size_px().x - size_px_.x) / 2;
        const double padding = 0.8 * style_.line_height_px;
        canvas.fill({left - padding, inset_, size_px_.x + 2 * padding, static_cast<double>(size_px_.y)}, 0.9);
        // Its letters are left free of the ink.
        canvas.takes_away(true);
        put_text(canvas, *whom_, style_, {left, static_cast<int>(inset_)});
        canvas.takes_away(false);
    }

  private:
    const std::string* whom_;
    double inset_;
    TextStyle style_;
    glm::ivec2 size_px_{0};
};

/// What stands around the middle of a screen, and the rows that it leaves.
class Surroundings {
  public:
    /// `text_height_deg`: of the letters as the protocol has them. The screen must outlive this.
    Surroundings(const Screen& screen, const ScreenGeometry& geometry, double text_height_deg)
        : screen_(&screen), screen_px_(geometry.screen_px) {
        plain_ = style_of(geometry, text_height_deg);
        plain_.centred = false;
        plain_.wrap_width_px = 20 * screen_px_.x;
        if (!screen.keys.empty())
            keys_.emplace(screen.keys, screen_px_, at_most(keys_size, largest_keys));
        if (!screen.frame.empty())
            frame_.emplace(screen.frame, screen_px_, at_most(keys_size, largest_keys));
    }

    Rows middle() const {
        const int gap = screen_px_.y / 100;
        Rows rows{static_cast<int>(highest * screen_px_.y), static_cast<int>(lowest * screen_px_.y)};
        // Below answers there is nothing but keys and how far this is.
        if (screen_->kind == Screen::Kind::answers && !keys_ && screen_->pages <= 1)
            rows.end = static_cast<int>(lowest_answer * screen_px_.y);
        if (frame_)
            rows.first = std::max(rows.first, frame_->end() + gap);
        if (keys_)
            rows.end = std::min(rows.end, keys_->top() - gap);
        return rows;
    }

    void put_on(InkCanvas& canvas, bool at_the_right) const {
        if (keys_)
            keys_->put_on(canvas, at_the_right);
        if (screen_->pages > 1)
            put_pages(canvas, screen_->page, screen_->pages, at_most(pages_size, largest_pages), at_the_right,
                      keys_ ? keys_->end() : 0);
        if (frame_)
            frame_->put_on(canvas);
    }

  private:
    TextStyle at_most(double size, double largest) const {
        TextStyle smaller = scaled(plain_, size);
        smaller.line_height_px = std::max(
            smallest_line_px, std::min(smaller.line_height_px, static_cast<int>(largest * screen_px_.y)));
        return smaller;
    }

    const Screen* screen_;
    glm::ivec2 screen_px_;
    TextStyle plain_;
    std::optional<KeyLines> keys_;
    std::optional<TitledFrame> frame_;
};

ScreenTextFit fit_middle(const Screen& screen, const ScreenGeometry& geometry, double text_height_deg,
                         const Rows& rows, AnswerPictures& pictures) {
    TextStyle style = style_of(geometry, text_height_deg);
    const int wanted = style.line_height_px, most = rows.end - rows.first;
    TextMeasure measure = Middle(screen, geometry, style, pictures).measure();
    const auto is_too_large = [&] {
        return measure.size_px.y > most || measure.size_px.x > geometry.screen_px.x;
    };
    while (is_too_large() && style.line_height_px > smallest_line_px) {
        style.line_height_px = std::max(smallest_line_px, style.line_height_px * 9 / 10);
        measure = Middle(screen, geometry, style, pictures).measure();
    }
    return {measure, style.line_height_px, style.line_height_px < wanted, !is_too_large()};
}

} // namespace

ScreenTextFit fit_screen(const Screen& screen, const ScreenGeometry& geometry, double text_height_deg) {
    AnswerPictures pictures;
    return fit_middle(screen, geometry, text_height_deg,
                      Surroundings(screen, geometry, text_height_deg).middle(), pictures);
}

PlacedPicture draw_screen(const Screen& screen, const ScreenGeometry& geometry, const ScreenSettings& screens,
                          double background) {
    AnswerPictures pictures;
    return draw_screen(screen, geometry, screens, background, pictures);
}

PlacedPicture draw_screen(const Screen& screen, const ScreenGeometry& geometry, const ScreenSettings& screens,
                          double background, AnswerPictures& pictures) {
    const auto grey = static_cast<float>(screens.text_grey), behind = static_cast<float>(background);
    if (screen.kind == Screen::Kind::target)
        return draw_target(screen, geometry, grey, behind);
    const Surroundings surroundings(screen, geometry, screens.text_height_deg);
    const Rows rows = surroundings.middle();
    TextStyle style = style_of(geometry, screens.text_height_deg);
    InkCanvas canvas(geometry.screen_px);
    std::optional<Middle> middle;
    if (screen.kind == Screen::Kind::validation) {
        put_validation(canvas, lay_out_validation(screen, geometry.screen_px, rows.first, rows.end, style));
    } else if (screen.kind != Screen::Kind::camera) {
        style.line_height_px =
            fit_middle(screen, geometry, screens.text_height_deg, rows, pictures).line_height_px;
        middle.emplace(screen, geometry, style, pictures);
        middle->put_on(canvas, rows);
    }
    surroundings.put_on(canvas,
                        begins_at_the_right(screen.rows.empty() ? screen.text : screen.rows.front().label));
    PlacedPicture placed;
    placed.texts = canvas.texts();
    if (screen.kind == Screen::Kind::camera) {
        placed.picture = canvas.tinted(grey, behind);
        put_camera(placed.picture, screen, grey);
        return placed;
    }
    placed.picture = canvas.tinted_ink(grey, behind, placed.origin_px);
    if (middle)
        middle->finish(placed, grey, behind, pictures);
    return placed;
}

LinearImage draw_level_bar(const LevelBar& bar, const ScreenGeometry& geometry, const ScreenSettings& screens,
                           double background) {
    const int width = static_cast<int>(meter_width * geometry.screen_px.x) / 2 * 2,
              height = std::max(8, static_cast<int>(meter_height * geometry.screen_px.y)) / 2 * 2;
    const auto grey_of = [](double grey) { return glm::vec4(glm::vec3(static_cast<float>(grey)), 1.0f); };
    LinearImage picture({width, height});
    std::fill(picture.pixels.begin(), picture.pixels.end(), grey_of(background));
    const int bar_height = std::max(4, height / 4), top = height - bar_height;
    const auto column = [&](double share) { return static_cast<int>(share * (width - 1)); };
    for (int y = top; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const bool is_edge = y == top || y == height - 1 || x == 0 || x == width - 1;
            const bool is_filled = x <= column(bar.mean) && bar.mean > 0.0;
            const bool is_peak = bar.peak > 0.0 && std::abs(x - column(bar.peak)) <= 1;
            if (is_edge || is_filled || is_peak)
                picture.at(x, y) = grey_of(0.5 * (screens.text_grey + background));
            if (is_peak)
                picture.at(x, y) = grey_of(screens.text_grey);
        }
    }
    if (bar.warning.empty())
        return picture;
    TextStyle style;
    style.line_height_px = std::max(smallest_line_px, (top - 2) * 2 / 3);
    style.wrap_width_px = 20 * width; // one line; what is too long is cut off
    style.grey = static_cast<float>(screens.text_grey);
    style.background = static_cast<float>(background);
    const LinearImage words = draw_text(bar.warning, style);
    const int left = std::max(0, (width - words.size_px.x) / 2);
    for (int y = 0; y < std::min(words.size_px.y, top - 1); ++y)
        for (int x = 0; x < std::min(words.size_px.x, width); ++x)
            picture.at(left + x, y) = glm::vec4(glm::vec3(words.at(x, y)), 1.0f);
    return picture;
}

glm::ivec2 level_bar_origin(const ScreenGeometry& geometry, glm::ivec2 size_px) {
    const glm::ivec2 middle = centred_origin_px(geometry.screen_px, size_px);
    return {middle.x, geometry.screen_px.y - size_px.y - geometry.screen_px.y / 200};
}

} // namespace overt
