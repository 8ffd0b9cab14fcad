#include "app/check/text_check.h"

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/protocol/protocol_keys.h"
#include "render/presenter/screen_text.h"

namespace overt {

namespace {

struct ShownText {
    std::string key; ///< for its place
    const std::string* text;
    bool is_form = false;
    std::string what = key; ///< in messages
};

/// The texts of a list of which each has the same key, counted from 1.
void add_numbered(std::vector<ShownText>& texts, const std::string& key, std::string_view noun,
                  const std::vector<std::string>& list, bool is_form) {
    for (std::size_t i = 0; i < list.size(); ++i)
        texts.push_back({key, &list[i], is_form, fmt::format("{} {}", noun, i + 1)});
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
    add_numbered(texts, "operator.skip_reasons", "skip reason", protocol.operators.skip_reasons, false);
    add_numbered(texts, "instructions.pages", "page", protocol.instructions.pages, false);
    for (std::size_t i = 0; i < protocol.tasks.size(); ++i)
        texts.push_back({fmt::format("task[{}].question", i), &protocol.tasks[i].question, false,
                         fmt::format("the question of task \"{}\"", protocol.tasks[i].id)});
    for (std::size_t i = 0; i < protocol.blocks.size(); ++i)
        texts.push_back({fmt::format("block[{}].instructions", i), &protocol.blocks[i].instructions, false,
                         fmt::format("the instructions of block \"{}\"", protocol.blocks[i].id)});
    for (std::size_t i = 0; i < protocol.practice.size(); ++i)
        texts.push_back(
            {fmt::format("practice[{}].feedback", i), &protocol.practice[i].feedback, false, "the feedback"});
    for (std::size_t i = 0; i < protocol.observer_fields.size(); ++i) {
        const ObserverFieldSettings& field = protocol.observer_fields[i];
        const std::string entry = fmt::format("observer_field[{}]", i);
        texts.push_back(
            {entry + ".title", &field.title, true, fmt::format("the title of field \"{}\"", field.id)});
        texts.push_back(
            {entry + ".note", &field.note, true, fmt::format("the note of field \"{}\"", field.id)});
        add_numbered(texts, entry + ".choices", "choice", field.choices, true);
    }
    return texts;
}

} // namespace

void check_texts(const Protocol& protocol, Diagnostics& diagnostics) {
    const ScreenGeometry geometry = screen_geometry_of(protocol);
    for (const ShownText& shown : shown_texts(protocol)) {
        if (shown.text->empty())
            continue;
        const Place place = protocol.places.of(shown.key);
        try {
            const ScreenTextFit fit =
                fit_screen_text(*shown.text, shown.is_form, geometry, protocol.screens.text_height_deg);
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
}

} // namespace overt
