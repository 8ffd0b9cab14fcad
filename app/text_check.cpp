#include "app/text_check.h"

#include <fmt/format.h>

#include "experiment/error.h"
#include "experiment/protocol/protocol_keys.h"
#include "render/screen_text.h"

namespace overt {

namespace {

struct ShownText {
    std::string key;
    const std::string* text;
    bool is_form = false;
};

std::vector<ShownText> shown_texts(const Protocol& protocol) {
    std::vector<ShownText> texts{{"screens.welcome_text", &protocol.screens.welcome_text},
                                 {"screens.response_text", &protocol.screens.response_text},
                                 {"screens.farewell_text", &protocol.screens.farewell_text},
                                 {"consent.text", &protocol.consent.text},
                                 {"breaks.text", &protocol.breaks.text},
                                 {"operator.pause_text", &protocol.operators.pause_text}};
    for_each_section([&]<class Struct>(const Section<Struct>& section) {
        if constexpr (std::is_same_v<Struct, WordSettings>)
            for (const Key<WordSettings>& key : section.keys)
                texts.push_back({fmt::format("words.{}", key.rule.name),
                                 &(protocol.words.*std::get<std::string WordSettings::*>(key.member))});
    });
    for (const std::string& page : protocol.instructions.pages)
        texts.push_back({"instructions.pages", &page});
    for (std::size_t i = 0; i < protocol.tasks.size(); ++i)
        texts.push_back({fmt::format("task[{}].question", i), &protocol.tasks[i].question});
    for (std::size_t i = 0; i < protocol.blocks.size(); ++i)
        texts.push_back({fmt::format("block[{}].instructions", i), &protocol.blocks[i].instructions});
    for (std::size_t i = 0; i < protocol.practice.size(); ++i)
        texts.push_back({fmt::format("practice[{}].feedback", i), &protocol.practice[i].feedback});
    for (std::size_t i = 0; i < protocol.observer_fields.size(); ++i)
        texts.push_back(
            {fmt::format("observer_field[{}].title", i), &protocol.observer_fields[i].title, true});
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
                                shown.key, fit.measure.unknown_glyphs),
                    "install a font for this script, say fonts-noto");
            if (fit.is_shrunk)
                diagnostics.warning(protocol.file.string(), place,
                                    fmt::format("{}: too long for the screen: it will be set in {} pixels",
                                                shown.key, fit.line_height_px),
                                    "shorten it, or spread it over pages");
        } catch (const InputError& error) {
            diagnostics.error(protocol.file.string(), place, error.what());
        }
    }
}

} // namespace overt
