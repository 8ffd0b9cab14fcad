#include "render/presenter/validation_layout.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>

namespace overt {

namespace {

constexpr double words_width = 0.86, most_of_room = 0.35; ///< of the screen's width, of the room's height
constexpr double widest_screen = 0.94;
constexpr int smallest_px = 8;
constexpr int least_screen_px = 40; ///< of its height: a smaller picture of it tells nothing
/// Letters of errors, of those of the words and of the height of the screen that is drawn.
constexpr double error_of_letters = 0.7, error_of_screen = 0.06;
constexpr double ring_of_error = 0.45, arm_of_error = 0.35;

struct Box {
    glm::dvec2 first, end;
    bool meets(const Box& other) const {
        return first.x < other.end.x && other.first.x < end.x && first.y < other.end.y &&
               other.first.y < end.y;
    }
    bool is_within(const Box& other) const {
        return first.x >= other.first.x && first.y >= other.first.y && end.x <= other.end.x &&
               end.y <= other.end.y;
    }
};

Box around(glm::dvec2 middle, double reach) { return {middle - reach, middle + reach}; }

Box box_of(const PlacedText& text) {
    return {glm::dvec2(text.origin_px), glm::dvec2(text.origin_px + text.size_px)};
}

bool is_finite(const ScreenPoint& place) { return std::isfinite(place.x_px) && std::isfinite(place.y_px); }

/// Of two eyes, after the cross of its own.
std::string error_text(const ValidatedTarget& target, bool both_eyes) {
    const std::string cross = !both_eyes ? "" : target.eye == Eye::left ? "× " : "+ ";
    return cross +
           (target.gaze && is_finite(*target.gaze) ? fmt::format("{:.2f}°", target.error.value) : "–");
}

PlacedText fitting_words(const Screen& screen, glm::ivec2 screen_px, int room_px, TextStyle style) {
    style.wrap_width_px = static_cast<int>(words_width * screen_px.x) / 2 * 2;
    style.centred = true;
    PlacedText words{screen.text, style, {}, {}};
    if (screen.text.empty())
        return words;
    for (;;) {
        words.size_px = measure_text(words.text, words.style).size_px;
        if (words.size_px.y <= most_of_room * room_px || words.style.line_height_px <= smallest_px)
            return words;
        words.style.line_height_px = std::max(smallest_px, words.style.line_height_px * 9 / 10);
    }
}

/// Puts errors beside their targets, one by one, each where nothing stands yet.
class ErrorPlaces {
  public:
    ErrorPlaces(const std::vector<ValidatedTarget>& targets, const ValidationLayout& layout)
        : targets_(targets), layout_(layout), room_{{layout.screen.x, layout.screen.y},
                                                    {layout.screen.x + layout.screen.width,
                                                     layout.screen.y + layout.screen.height}} {
        has_both_eyes_ = std::ranges::any_of(
            targets, [&](const ValidatedTarget& target) { return target.eye != targets.front().eye; });
        // The largest error is the one to be seen; who was not seen at all comes before it.
        order_.resize(targets.size());
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        std::ranges::stable_sort(order_, [&](std::size_t a, std::size_t b) {
            const auto rank = [&](std::size_t i) {
                return targets_[i].gaze ? targets_[i].error.value : std::numeric_limits<double>::infinity();
            };
            return rank(a) > rank(b);
        });
    }

    /// As many as find a place, in letters of this height. `avoids_marks`: rings, crosses and the lines
    /// between them as well.
    std::vector<PlacedText> put(int line_height_px, bool avoids_marks) {
        TextStyle style;
        style.line_height_px = line_height_px;
        style.wrap_width_px = static_cast<int>(room_.end.x);
        std::vector<Box> taken;
        if (avoids_marks)
            taken = boxes_of_marks();
        std::vector<PlacedText> put;
        for (const std::size_t i : order_) {
            PlacedText text{error_text(targets_[i], has_both_eyes_), style, {}, {}};
            text.size_px = size_of(text);
            if (!find_place(text, layout_.marks[i], taken))
                continue;
            taken.push_back(box_of(text));
            put.push_back(std::move(text));
        }
        return put;
    }

  private:
    glm::ivec2 size_of(const PlacedText& text) {
        const auto [known, is_new] = sizes_.try_emplace({text.text, text.style.line_height_px});
        if (is_new)
            known->second = measure_text(text.text, text.style).size_px;
        return known->second;
    }

    std::vector<Box> boxes_of_marks() const {
        std::vector<Box> boxes;
        for (const ValidationLayout::Mark& mark : layout_.marks) {
            boxes.push_back(around(mark.target_px, layout_.ring_px + 1.0));
            if (!mark.gaze_px)
                continue;
            const glm::dvec2 way = *mark.gaze_px - mark.target_px;
            const int steps = 1 + static_cast<int>(glm::length(way) / std::max(4.0, layout_.arm_px));
            for (int step = 1; step <= steps; ++step)
                boxes.push_back(around(mark.target_px + way * (static_cast<double>(step) / steps),
                                       step == steps ? layout_.arm_px : 1.0));
        }
        return boxes;
    }

    /// Beside the target, then above and below it, then at its corners, and the same a letter farther out.
    bool find_place(PlacedText& text, const ValidationLayout::Mark& mark,
                    const std::vector<Box>& taken) const {
        const double own = mark.eye == Eye::left ? -1.0 : 1.0;
        const glm::dvec2 sides[] = {{own, 0.0}, {0.0, -1.0}, {0.0, 1.0},   {own, -1.0},
                                    {own, 1.0}, {-own, 0.0}, {-own, -1.0}, {-own, 1.0}};
        const glm::dvec2 half = 0.5 * glm::dvec2(text.size_px);
        for (const double farther : {0.0, 0.5, 1.0, 2.0}) {
            const double away = layout_.ring_px + 2.0 + farther * text.style.line_height_px;
            for (const glm::dvec2& side : sides) {
                const glm::dvec2 middle = mark.target_px + side * (half + away);
                text.origin_px = glm::ivec2(glm::round(middle - half));
                const Box box = box_of(text);
                if (box.is_within(room_) &&
                    std::ranges::none_of(taken, [&](const Box& other) { return box.meets(other); }))
                    return true;
            }
        }
        return false;
    }

    const std::vector<ValidatedTarget>& targets_;
    const ValidationLayout& layout_;
    Box room_;
    bool has_both_eyes_ = false;
    std::vector<std::size_t> order_;
    std::map<std::pair<std::string, int>, glm::ivec2> sizes_;
};

void add_marks(ValidationLayout& layout, const Screen& screen, double scale) {
    const glm::dvec2 corner(layout.screen.x, layout.screen.y),
        size(layout.screen.width, layout.screen.height);
    const auto clamped = [&](ScreenPoint place) {
        return corner + glm::clamp(scale * glm::dvec2(place.x_px, place.y_px), glm::dvec2(0.0), size);
    };
    for (const ValidatedTarget& target : screen.validated) {
        ValidationLayout::Mark mark{target.eye, clamped(target.target), {}, false};
        if (target.gaze && is_finite(*target.gaze)) {
            mark.gaze_px = clamped(*target.gaze);
            const glm::dvec2 as_it_is = corner + scale * glm::dvec2(target.gaze->x_px, target.gaze->y_px);
            mark.gaze_is_inside = glm::distance(as_it_is, *mark.gaze_px) < 0.5;
        }
        layout.marks.push_back(mark);
    }
}

} // namespace

ValidationLayout lay_out_validation(const Screen& screen, glm::ivec2 screen_px, int top_px, int bottom_px,
                                    const TextStyle& letters) {
    ValidationLayout layout;
    const int room = std::max(0, bottom_px - top_px);
    layout.words = fitting_words(screen, screen_px, room, letters);
    layout.words.origin_px = {(screen_px.x - layout.words.size_px.x) / 2,
                              std::max(top_px, bottom_px - layout.words.size_px.y)};
    const int gap = std::max(2, screen_px.y / 60);
    const int height = layout.words.origin_px.y - gap - top_px;
    if (height < least_screen_px)
        return layout;
    const double scale = std::min(static_cast<double>(height) / screen_px.y, widest_screen);
    const glm::dvec2 size = scale * glm::dvec2(screen_px);
    layout.screen = {0.5 * (screen_px.x - size.x), top_px + 0.5 * (height - size.y), size.x, size.y};
    int letters_px = std::max(
        smallest_px,
        static_cast<int>(std::min(error_of_letters * letters.line_height_px, error_of_screen * size.y)));
    layout.ring_px = ring_of_error * letters_px;
    layout.arm_px = arm_of_error * letters_px;
    add_marks(layout, screen, scale);
    ErrorPlaces places(screen.validated, layout);
    for (const bool avoids_marks : {true, false}) {
        for (int px = letters_px;; px = std::max(smallest_px, px * 9 / 10)) {
            std::vector<PlacedText> put = places.put(px, avoids_marks);
            if (put.size() > layout.errors.size() || put.size() == screen.validated.size())
                layout.errors = std::move(put);
            if (layout.errors.size() == screen.validated.size())
                return layout;
            if (px == smallest_px)
                break;
        }
    }
    layout.errors_left_out = static_cast<int>(screen.validated.size() - layout.errors.size());
    return layout;
}

} // namespace overt
