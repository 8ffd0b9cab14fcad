#include "app/check/text_check.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "experiment/session/observer_form.h"
#include "experiment/session/session_screens.h"
#include "render/presenter/screen_text.h"

namespace overt {

namespace {

struct ShownText {
    std::string key; ///< for its place
    const std::string* text;
    std::string what = key; ///< in messages
};

/// The texts of a list of which each has the same key, counted from 1.
void add_numbered(std::vector<ShownText>& texts, const std::string& key, std::string_view noun,
                  const std::vector<std::string>& list) {
    for (std::size_t i = 0; i < list.size(); ++i)
        texts.push_back({key, &list[i], fmt::format("{} {}", noun, i + 1)});
}

std::vector<ShownText> shown_texts(const Protocol& protocol) {
    std::vector<ShownText> texts{{"screens.welcome_text", &protocol.screens.welcome_text},
                                 {"screens.response_text", &protocol.screens.response_text},
                                 {"screens.farewell_text", &protocol.screens.farewell_text},
                                 {"consent.text", &protocol.consent.text},
                                 {"breaks.text", &protocol.breaks.text},
                                 {"operator.pause_text", &protocol.operators.pause_text}};
    for (const Key& key : protocol_keys().section("words").keys)
        texts.push_back({fmt::format("words.{}", key.rule.name), key.get_if<std::string>(&protocol.words)});
    add_numbered(texts, "operator.skip_reasons", "skip reason", protocol.operators.skip_reasons);
    add_numbered(texts, "instructions.pages", "page", protocol.instructions.pages);
    for (std::size_t i = 0; i < protocol.tasks.size(); ++i)
        texts.push_back({fmt::format("task[{}].question", i), &protocol.tasks[i].question,
                         fmt::format("the question of task \"{}\"", protocol.tasks[i].id)});
    for (std::size_t i = 0; i < protocol.blocks.size(); ++i)
        texts.push_back({fmt::format("block[{}].instructions", i), &protocol.blocks[i].instructions,
                         fmt::format("the instructions of block \"{}\"", protocol.blocks[i].id)});
    for (std::size_t i = 0; i < protocol.practice.size(); ++i)
        texts.push_back(
            {fmt::format("practice[{}].feedback", i), &protocol.practice[i].feedback, "the feedback"});
    for (std::size_t i = 0; i < protocol.observer_fields.size(); ++i) {
        const ObserverFieldSettings& field = protocol.observer_fields[i];
        const std::string entry = fmt::format("observer_field[{}]", i);
        texts.push_back({entry + ".title", &field.title, fmt::format("the title of field \"{}\"", field.id)});
        texts.push_back({entry + ".note", &field.note, fmt::format("the note of field \"{}\"", field.id)});
        if (field.kind == FieldKind::choice)
            add_numbered(texts, entry + ".choices", "choice", field.choices);
        add_numbered(texts, entry + ".ends", "end", field.ends);
    }
    return texts;
}

} // namespace

namespace {

/// The form as a whole, as it is asked at a time.
void check_form(const Protocol& protocol, const std::string& when, const ScreenGeometry& geometry,
                Diagnostics& diagnostics) {
    const std::vector<ObserverFieldSettings> fields = fields_asked(protocol.observer_fields, when);
    const ObserverForm form(fields, {}, protocol.words);
    const ScreenTextFit fit = fit_screen(form.screen(), geometry, protocol.screens.text_height_deg);
    const auto first = std::ranges::find(protocol.observer_fields, when, &ObserverFieldSettings::when);
    const Place place =
        protocol.places.of(fmt::format("observer_field[{}]", first - protocol.observer_fields.begin()));
    constexpr const char* remedy =
        "ask for less, shorten titles and choices, or set [screens] text_height_deg";
    if (!fit.fits)
        diagnostics.error(protocol.file.string(), place,
                          fmt::format("the form is too large for the screen even in letters of {} pixels: "
                                      "its end would be cut off",
                                      fit.line_height_px),
                          remedy);
    // A form is set somewhat smaller than texts without harm.
    else if (fit.line_height_px < 0.75 * protocol.screens.text_height_deg * geometry.px_per_deg_at_centre())
        diagnostics.warning(protocol.file.string(), place,
                            fmt::format("the form is too large for the screen: it will be set in {} pixels",
                                        fit.line_height_px),
                            remedy);
}

/// Screens on which trials are answered, as a whole. Throws InputError for a text or picture that cannot be
/// shown.
void check_answers(const Protocol& protocol, const ScreenGeometry& geometry, Diagnostics& diagnostics) {
    constexpr const char* remedy =
        "shorten labels, ask for less on one screen (per_screen, or further steps), "
        "or set [screens] text_height_deg";
    for (const auto& [task, name, screen] : screens::answers_of_tasks(protocol)) {
        const Place place = protocol.places.of(fmt::format("task[{}].answer[0]", task));
        const ScreenTextFit fit = fit_screen(screen, geometry, protocol.screens.text_height_deg);
        if (fit.measure.unknown_glyphs > 0)
            diagnostics.warning(
                protocol.file.string(), place,
                fmt::format("the screen of answers \"{}\": no font of this machine has {} of its "
                            "characters: boxes will stand for them",
                            name, fit.measure.unknown_glyphs),
                "install a font for this script, say fonts-noto");
        if (!fit.fits)
            diagnostics.error(protocol.file.string(), place,
                              fmt::format("the screen of answers \"{}\" is too large even in letters of {} "
                                          "pixels: its end would be cut off",
                                          name, fit.line_height_px),
                              remedy);
        else if (fit.line_height_px <
                 0.5 * protocol.screens.text_height_deg * geometry.px_per_deg_at_centre())
            diagnostics.warning(
                protocol.file.string(), place,
                fmt::format(
                    "the screen of answers \"{}\" is too large: it will be set in letters of {} pixels", name,
                    fit.line_height_px),
                remedy);
    }
}

/// Letters that are hard to read. WCAG 2.1 (success criterion 1.4.3) asks for large letters that (brighter +
/// 0.05) / (darker + 0.05) of the two is 3 or more, 0.05 being what the room adds to a display's black.
void check_contrast(const Protocol& protocol, Diagnostics& diagnostics) {
    constexpr double room = 0.05, least = 3.0;
    const auto [darker, brighter] = std::minmax(protocol.screens.text_grey, protocol.display.background);
    const double ratio = (brighter + room) / (darker + room);
    if (ratio >= least)
        return;
    diagnostics.warning(
        protocol.file.string(), protocol.places.of("screens.text_grey"),
        fmt::format("texts of grey {} on a background of {} have a contrast of {:.1f} : 1, with "
                    "what a room adds to both; letters are read with ease from {:.0f} : 1 on",
                    protocol.screens.text_grey, protocol.display.background, ratio, least),
        "set [screens] text_grey farther from [display] background");
}

} // namespace

void check_texts(const Protocol& protocol, Diagnostics& diagnostics) {
    const ScreenGeometry geometry = screen_geometry_of(protocol);
    check_contrast(protocol, diagnostics);
    for (const ShownText& shown : shown_texts(protocol)) {
        if (shown.text->empty())
            continue;
        const Place place = protocol.places.of(shown.key);
        try {
            const ScreenTextFit fit = fit_screen({.kind = Screen::Kind::text, .text = *shown.text}, geometry,
                                                 protocol.screens.text_height_deg);
            if (fit.measure.unknown_glyphs > 0)
                diagnostics.warning(
                    protocol.file.string(), place,
                    fmt::format("{}: no font of this machine has {} of its characters: boxes will "
                                "stand for them",
                                shown.what, fit.measure.unknown_glyphs),
                    "install a font for this script, say fonts-noto");
            if (!fit.fits)
                diagnostics.error(protocol.file.string(), place,
                                  fmt::format("{}: too long for the screen even in letters of {} pixels: its "
                                              "end would be cut off",
                                              shown.what, fit.line_height_px),
                                  "shorten it, or spread it over pages");
            else if (fit.is_shrunk)
                diagnostics.warning(protocol.file.string(), place,
                                    fmt::format("{}: too long for the screen: it will be set in {} pixels",
                                                shown.what, fit.line_height_px),
                                    "shorten it, or spread it over pages");
        } catch (const InputError& error) {
            diagnostics.error(protocol.file.string(), place, error.what());
        }
    }
    if (diagnostics.error_count() == 0)
        for (const std::string& when : moments_asked(protocol.observer_fields))
            check_form(protocol, when, geometry, diagnostics);
    if (diagnostics.error_count() == 0)
        check_answers(protocol, geometry, diagnostics);
}

} // namespace overt
