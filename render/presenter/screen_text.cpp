#include "render/presenter/screen_text.h"
#include "render/presenter/setup_screens.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>

#include "render/image/text_markup.h"
#include "render/presenter/form_layout.h"

namespace overt {

namespace {

// Shares of the screen's size. What stands in the middle ends above the keys, and these above the meter.
constexpr double safe_width = 0.8, highest = 0.05, lowest = 0.79, keys_middle = 0.86, pages_middle = 0.93;
constexpr double frame_inset = 0.025;
constexpr double meter_width = 0.2, meter_height = 0.05; // a text's margin below is a twentieth of the screen

/// Of a line, in letters' heights: some sixty letters, of which eyes find the next line's beginning.
constexpr double longest_line = 34.0;
// Of the letters of a text.
constexpr double title_size = 1.35, form_size = 0.8, keys_size = 0.75, pages_size = 0.65;
// Of the screen's height, at most: what stands below must not meet.
constexpr double largest_keys = 0.033, largest_pages = 0.022;

constexpr int smallest_line_px = 8;

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
    Middle(const Screen& screen, const ScreenGeometry& geometry, const TextStyle& letters)
        : screen_(&screen), words_(split_title(screen.text)), body_(letters),
          title_(scaled(letters, title_size)), below_(scaled(letters, form_size)) {
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
    }

    const TextMeasure& measure() const { return measure_; }

    void put_on(InkCanvas& canvas) const {
        const glm::ivec2 screen = canvas.size_px();
        const int room_end = static_cast<int>(lowest * screen.y);
        int top = std::min((screen.y - measure_.size_px.y) / 2, room_end - measure_.size_px.y);
        top = std::max(top, static_cast<int>(highest * screen.y));
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
        }
    }

    bool begins_at_the_right() const {
        return overt::begins_at_the_right(form_ ? screen_->rows.front().label : screen_->text);
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

    const Screen* screen_;
    TitledText words_;
    TextStyle body_, title_, below_;
    std::optional<FormLayout> form_;
    TextMeasure measure_;
    int gap_px_ = 0, title_height_px_ = 0, body_height_px_ = 0;
};

/// Keys as caps, each with what it does, in a line at the foot.
void put_keys(InkCanvas& canvas, const std::vector<KeyHint>& keys, TextStyle style, bool at_the_right) {
    struct Part {
        int key_px, does_px;
    };
    const glm::ivec2 screen = canvas.size_px();
    std::vector<Part> parts;
    int all = 0, height = 0;
    const auto ems = [&](double count) { return static_cast<int>(count * style.line_height_px); };
    for (;;) {
        parts.clear();
        all = 0;
        for (const KeyHint& hint : keys) {
            const TextMeasure key = measure_text(hint.key, style), does = measure_text(hint.does, style);
            parts.push_back({key.size_px.x, does.size_px.x});
            height = std::max(key.size_px.y, does.size_px.y);
            all += (hint.key.empty() ? 0 : key.size_px.x + ems(1.2)) + does.size_px.x;
        }
        all += ems(2.5) * (static_cast<int>(keys.size()) - 1);
        if (all <= 0.9 * screen.x || style.line_height_px <= smallest_line_px)
            break;
        style = scaled(style, 0.9);
    }
    const int top = static_cast<int>(keys_middle * screen.y) - height / 2;
    int start = (screen.x - all) / 2;
    const auto left_of = [&](int width) { return at_the_right ? screen.x - start - width : start; };
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (!keys[i].key.empty()) {
            const int cap = parts[i].key_px + ems(0.7);
            const double line = std::max(1.0, style.line_height_px / 20.0);
            canvas.outline({static_cast<double>(left_of(cap)), top - 0.05 * style.line_height_px,
                            static_cast<double>(cap), height + 0.1 * style.line_height_px},
                           0.6, line, 0.25 * style.line_height_px);
            put_text(canvas, keys[i].key, style, {left_of(cap) + ems(0.35), top}, 0.9);
            start += cap + ems(0.5);
        }
        put_text(canvas, keys[i].does, style, {left_of(parts[i].does_px), top}, 0.8);
        start += parts[i].does_px + ems(2.5);
    }
}

/// "2 / 5" above a line of which so much is filled.
void put_pages(InkCanvas& canvas, int page, int pages, const TextStyle& style, bool at_the_right) {
    const glm::ivec2 screen = canvas.size_px();
    const std::string count = fmt::format("{} / {}", page, pages);
    const glm::ivec2 size = measure_text(count, style).size_px;
    const int middle = static_cast<int>(pages_middle * screen.y);
    put_text(canvas, count, style, {(screen.x - size.x) / 2, middle - size.y}, 0.8);
    const double width = 0.16 * screen.x, height = std::max(2.0, screen.y / 270.0),
                 left = 0.5 * (screen.x - width), done = width * page / pages;
    canvas.fill({left, middle + height, width, height}, 0.25);
    canvas.fill({at_the_right ? left + width - done : left, middle + height, done, height}, 0.8);
}

/// Around everything, with whom it is for at its top.
void put_frame(InkCanvas& canvas, const std::string& whom, const TextStyle& style) {
    const glm::dvec2 screen(canvas.size_px());
    const double inset = frame_inset * screen.y, line = std::max(3.0, screen.y / 200.0);
    canvas.outline({inset, inset, screen.x - 2 * inset, screen.y - 2 * inset}, 0.9, line, 2 * line);
    const glm::ivec2 size = measure_text(whom, style).size_px;
    const int left = (canvas.size_px().x - size.x) / 2;
    const double padding = 0.8 * style.line_height_px;
    canvas.fill({left - padding, inset, size.x + 2 * padding, static_cast<double>(size.y)}, 0.9);
    // Its letters are left free of the ink.
    canvas.takes_away(true);
    put_text(canvas, whom, style, {left, static_cast<int>(inset)});
    canvas.takes_away(false);
}

} // namespace

ScreenTextFit fit_screen(const Screen& screen, const ScreenGeometry& geometry, double text_height_deg) {
    TextStyle style = style_of(geometry, text_height_deg);
    const int wanted = style.line_height_px,
              most = static_cast<int>((lowest - highest) * geometry.screen_px.y);
    TextMeasure measure = Middle(screen, geometry, style).measure();
    const auto is_too_large = [&] {
        return measure.size_px.y > most || measure.size_px.x > geometry.screen_px.x;
    };
    while (is_too_large() && style.line_height_px > smallest_line_px) {
        style.line_height_px = std::max(smallest_line_px, style.line_height_px * 9 / 10);
        measure = Middle(screen, geometry, style).measure();
    }
    return {measure, style.line_height_px, style.line_height_px < wanted, !is_too_large()};
}

PlacedPicture draw_screen(const Screen& screen, const ScreenGeometry& geometry, const ScreenSettings& screens,
                          double background) {
    TextStyle style = style_of(geometry, screens.text_height_deg);
    const TextStyle as_written = style;
    style.line_height_px = fit_screen(screen, geometry, screens.text_height_deg).line_height_px;
    InkCanvas canvas(geometry.screen_px);
    const Middle middle(screen, geometry, style);
    const bool has_marks = screen.kind == Screen::Kind::validation,
               has_camera = screen.kind == Screen::Kind::camera;
    if (has_marks)
        put_validation(canvas, screen, style);
    else if (!has_camera)
        middle.put_on(canvas);
    const bool at_the_right = middle.begins_at_the_right();
    TextStyle plain = as_written;
    plain.centred = false;
    plain.wrap_width_px = 20 * geometry.screen_px.x;
    const auto at_most = [&](double size, double largest) {
        TextStyle smaller = scaled(plain, size);
        smaller.line_height_px =
            std::max(smallest_line_px,
                     std::min(smaller.line_height_px, static_cast<int>(largest * geometry.screen_px.y)));
        return smaller;
    };
    if (!screen.keys.empty())
        put_keys(canvas, screen.keys, at_most(keys_size, largest_keys), at_the_right);
    if (screen.pages > 1)
        put_pages(canvas, screen.page, screen.pages, at_most(pages_size, largest_pages), at_the_right);
    if (!screen.frame.empty())
        put_frame(canvas, screen.frame, at_most(keys_size, largest_keys));
    PlacedPicture placed;
    if (has_camera) {
        placed.picture = canvas.tinted(static_cast<float>(screens.text_grey), static_cast<float>(background));
        put_camera(placed.picture, screen, static_cast<float>(screens.text_grey));
        return placed;
    }
    placed.picture = canvas.tinted_ink(static_cast<float>(screens.text_grey), static_cast<float>(background),
                                       placed.origin_px);
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
