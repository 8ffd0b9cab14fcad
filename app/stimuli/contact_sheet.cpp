#include "app/stimuli/contact_sheet.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/parallel.h"
#include "experiment/protocol/all_stimuli.h"
#include "render/image/text_layout.h"

namespace overt {

namespace {

constexpr int gap_px = 8;

/// Smaller by a whole factor, so that it is at most so wide and high; each pixel the mean of those it covers.
LinearImage reduced_to(const LinearImage& picture, int most_px) {
    const int factor = (std::max(picture.size_px.x, picture.size_px.y) + most_px - 1) / most_px;
    LinearImage small(glm::max(picture.size_px / factor, glm::ivec2(1)));
    for (int y = 0; y < small.size_px.y; ++y) {
        for (int x = 0; x < small.size_px.x; ++x) {
            glm::vec4 sum(0.0f);
            for (int i = 0; i < factor * factor; ++i)
                sum += picture.at(std::min(x * factor + i % factor, picture.size_px.x - 1),
                                  std::min(y * factor + i / factor, picture.size_px.y - 1));
            small.at(x, y) = sum / static_cast<float>(factor * factor);
        }
    }
    return small;
}

void paste(LinearImage& onto, const LinearImage& picture, glm::ivec2 origin) {
    for (int y = 0; y < picture.size_px.y; ++y) {
        for (int x = 0; x < picture.size_px.x; ++x) {
            const glm::ivec2 place = origin + glm::ivec2(x, y);
            if (glm::any(glm::lessThan(place, glm::ivec2(0))) ||
                glm::any(glm::greaterThanEqual(place, onto.size_px)))
                continue;
            const glm::vec4& top = picture.at(x, y);
            glm::vec4& below = onto.at(place.x, place.y);
            below = glm::vec4(glm::vec3(top) + (1.0f - top.w) * glm::vec3(below), 1.0f);
        }
    }
}

LinearImage label(const std::string& text, int width_px, int line_px) {
    TextStyle style;
    style.line_height_px = line_px;
    style.wrap_width_px = width_px & ~1;
    return draw_text(text, style);
}

} // namespace

LinearImage contact_sheet(const Protocol& protocol, const StimulusLibrary& library, int frame, int cell_px) {
    const std::vector<Stimulus> stimuli = all_stimuli(protocol);
    // A row for each object; materials, and what else there is a choice of, side by side.
    const int rows = static_cast<int>(protocol.objects.size()),
              columns = static_cast<int>(stimuli.size()) / rows;
    std::vector<LinearImage> cells(stimuli.size());
    parallel_for(columns * rows, [&](int i) {
        const Stimulus& stimulus = stimuli[static_cast<std::size_t>(i)];
        const std::vector<int> pages = library.page_of_frame(stimulus);
        const int page = pages[std::min(static_cast<std::size_t>(frame), pages.size() - 1)];
        cells[static_cast<std::size_t>(i)] = reduced_to(library.page_on_screen(stimulus, page), cell_px);
    });
    const glm::ivec2 cell = cells.front().size_px;
    const int line_px = std::clamp(cell.x / 12, 9, 28);
    // Long names take several lines, and have them.
    std::vector<LinearImage> labels;
    for (const Stimulus& stimulus : stimuli)
        labels.push_back(label(stimulus_title(protocol, stimulus), cell.x, line_px));
    int label_px = 2 * line_px;
    for (const LinearImage& text : labels)
        label_px = std::max(label_px, text.size_px.y);
    label_px += gap_px;
    LinearImage sheet({gap_px + columns * (cell.x + gap_px), rows * (cell.y + label_px) + gap_px});
    for (int i = 0; i < columns * rows; ++i) {
        const glm::ivec2 origin(gap_px + i % columns * (cell.x + gap_px), i / columns * (cell.y + label_px));
        const LinearImage& text = labels[static_cast<std::size_t>(i)];
        paste(sheet, text, origin + glm::ivec2((cell.x - text.size_px.x) / 2, gap_px / 2));
        paste(sheet, cells[static_cast<std::size_t>(i)], origin + glm::ivec2(0, label_px));
    }
    return sheet;
}

LinearImage film_strip(const StimulusLibrary& library, const Stimulus& stimulus, const FrameRange& frames,
                       int count, int cell_px) {
    const int there = frames.last - frames.first + 1;
    count = std::min(count, there);
    std::vector<int> numbers;
    for (int i = 0; i < count; ++i)
        numbers.push_back(frames.first + (count > 1 ? i * (there - 1) / (count - 1) : 0));
    const std::vector<int> pages = library.page_of_frame(stimulus);
    std::vector<LinearImage> cells(numbers.size());
    parallel_for(count, [&](int i) {
        const int page = pages[static_cast<std::size_t>(numbers[static_cast<std::size_t>(i)])];
        cells[static_cast<std::size_t>(i)] = reduced_to(library.page_on_screen(stimulus, page), cell_px);
    });
    const glm::ivec2 cell = cells.front().size_px;
    const int line_px = std::clamp(cell.x / 12, 9, 28), label_px = line_px + gap_px;
    LinearImage strip({count * (cell.x + gap_px), cell.y + label_px});
    for (int i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const LinearImage text = label(fmt::format("{}", numbers[at]), cell.x, line_px);
        const int left = i * (cell.x + gap_px);
        paste(strip, cells[at], {left, 0});
        paste(strip, text, {left + (cell.x - text.size_px.x) / 2, cell.y});
    }
    return strip;
}

} // namespace overt
