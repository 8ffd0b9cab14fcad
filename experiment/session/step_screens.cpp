#include "experiment/session/step_screens.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "experiment/base/random.h"
#include "experiment/session/session_screens.h"

namespace overt {

namespace {

void replace_all(std::string& text, std::string_view word, std::string_view by) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + by.size()))
        text.replace(at, word.size(), by);
}

std::string with_trial(std::string text, const StepCircumstances& of) {
    const auto at = [](const auto& list, int index) -> const auto& {
        return list[static_cast<std::size_t>(index)];
    };
    replace_all(text, "{question}", at(of.protocol.tasks, of.trial.task).question);
    replace_all(text, "{object}", at(of.protocol.objects, of.trial.stimulus.object).title);
    replace_all(text, "{material}", at(of.protocol.materials, of.trial.stimulus.material).title);
    return text;
}

Screen mask(const PlannedStep& step, const StepCircumstances& of) {
    RandomStream seeds(of.seed, fmt::format("mask {}", of.number),
                       static_cast<std::uint64_t>(of.trial.index));
    Screen screen{.kind = step.settings->is_scrambled ? Screen::Kind::scrambled : Screen::Kind::noise,
                  .text = ""};
    screen.noise_seed = std::uint64_t{seeds.next_bits()} << 32U;
    screen.noise_seed |= seeds.next_bits();
    screen.noise_cell = Degrees{step.settings->cell_deg};
    screen.places = step.places;
    return screen;
}

Screen feedback(const StepSettings& step, const StepCircumstances& of) {
    const std::string& known = !of.is_correct ? step.answered : *of.is_correct ? step.correct : step.wrong;
    const std::string& words = !of.is_answered ? step.missed : known.empty() ? step.answered : known;
    if (words.empty())
        return {};
    if (!step.is_coloured)
        return {.kind = Screen::Kind::text, .text = words};
    using Colour = AnswerItem::Colour;
    Screen screen{.kind = Screen::Kind::answers, .text = ""};
    AnswerItem& notice = screen.answers.items.emplace_back();
    notice.kind = AnswerItem::Kind::notice;
    notice.question = words;
    notice.colour = !of.is_answered  ? Colour::bad
                    : !of.is_correct ? Colour::plain
                    : *of.is_correct ? Colour::good
                                     : Colour::bad;
    return screen;
}

} // namespace

ScreenPoint target_of(const StepSettings& step, const ScreenGeometry& screen) {
    // On a flat screen, by the tangent of the angle.
    const auto px = [](double deg, double distance_mm, double mm_per_px) {
        return distance_mm * std::tan(deg * std::numbers::pi / 180.0) / mm_per_px;
    };
    const ScreenPoint centre = screen.centre();
    return {
        centre.x_px + px(step.right_deg, screen.viewing_distance_mm, screen.screen_mm.x / screen.screen_px.x),
        centre.y_px - px(step.up_deg, screen.viewing_distance_mm, screen.screen_mm.y / screen.screen_px.y)};
}

std::optional<Beep> tone_of(const StepSettings& step, const StepCircumstances& of) {
    if (!step.has_tone)
        return std::nullopt;
    if (!of.is_answered)
        return Beep::missed;
    return !of.is_correct ? Beep::answered : *of.is_correct ? Beep::correct : Beep::wrong;
}

Screen screen_of(const PlannedStep& step, const StepCircumstances& of) {
    switch (step.kind) {
    case StepKind::text: {
        const std::string words = with_trial(step.settings->text, of);
        return step.refreshes ? Screen{.kind = Screen::Kind::text, .text = words}
                              : screens::text(of.protocol, words);
    }
    case StepKind::fixation: {
        Screen screen{.kind = Screen::Kind::target, .text = ""};
        if (step.settings->right_deg != 0.0 || step.settings->up_deg != 0.0)
            screen.target_place = target_of(*step.settings, screen_geometry_of(of.protocol));
        return screen;
    }
    case StepKind::mask:
        return step.places.empty() ? Screen{} : mask(step, of);
    case StepKind::feedback:
        return feedback(*step.settings, of);
    case StepKind::blank:
    case StepKind::show:
    case StepKind::answer:
    case StepKind::drift_check:
        break;
    }
    return {};
}

} // namespace overt
