#include "experiment/protocol/protocol_starter.h"

#include <algorithm>
#include <map>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "experiment/protocol/protocol_keys.h"
#include "experiment/protocol/protocol_schema.h"

namespace overt {

namespace {

using Values = std::map<std::string_view, std::string_view>; ///< by key, as TOML

/// What a beginner has to look at: an ordinary monitor, two sculptures in two materials, two questions.
const std::map<std::string_view, std::vector<Values>>& starter_values() {
    static const std::map<std::string_view, std::vector<Values>> values{
        {"protocol", {{{"title", "\"A new experiment\""}}}},
        {"display",
         {{{"width_px", "1920"},
           {"height_px", "1080"},
           {"refresh_hz", "60"},
           {"width_mm", "531"},
           {"height_mm", "299"},
           {"viewing_distance_mm", "600"},
           {"output", "\"native-8bit\""},
           {"gamma", "2.2"}}}},
        {"tracker", {{{"rate_hz", "1000"}}}},
        {"consent",
         {{{"text", "\"You will look at sculptures on a screen, and your eyes are recorded.\\n"
                    "You may stop at any time.\\n\\nDo you agree to take part?    Y: yes    N: no\""}}}},
        {"instructions",
         {{{"pages", "[\"Before each sculpture you read what to look for.\", "
                     "\"Look at the dot when it appears. Answer aloud, then press the space bar.\"]"}}}},
        {"answers", {{{"record", "\"optional\""}}}},
        {"observer_field",
         {{{"id", "\"age\""}}, {{"id", "\"sex\""}}, {{"id", "\"vision\""}}, {{"id", "\"handedness\""}}}},
        {"animation", {{{"duration_s", "4"}}}},
        {"schedule", {{{"observers", "4"}, {"max_sculpture_run", "2"}}}},
        {"task",
         {{{"id", "\"free\""}, {"question", "\"Look at the sculpture as you like.\""}},
          {{"id", "\"age\""},
           {"question", "\"How old is this person?\""},
           {"stimuli", "\"once-per-sculpture\""}}}},
        {"sculpture",
         {{{"id", "\"muse\""}, {"title", "\"Muse\""}, {"shipped", "\"muse\""}},
          {{"id", "\"scholar\""}, {"title", "\"Scholar\""}, {"shipped", "\"scholar\""}}}},
        {"material",
         {{{"id", "\"gold\""}, {"title", "\"Gold\""}, {"kind", "\"smooth-conductor\""}, {"metal", "\"Au\""}},
          {{"id", "\"clay\""},
           {"title", "\"Clay\""},
           {"kind", "\"diffuse\""},
           {"reflectance", "[0.52, 0.30, 0.20]"}}}}};
    return values;
}

/// Lines of a comment of at most 78 columns.
std::string comment(std::string_view text) {
    std::string lines, line = "#";
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string_view word = text.substr(begin, end - begin);
        if (line.size() + 1 + word.size() > 78 && line.size() > 1) {
            lines += line + "\n";
            line = "#";
        }
        line += " ";
        line += word;
        begin = end + 1;
    }
    return lines + line + "\n";
}

/// A value as a comment shows it: the default, or what kind of value goes there.
std::string placeholder(const nlohmann::ordered_json& schema) {
    if (const auto standard = schema.find("default"); standard != schema.end())
        return standard->dump();
    return "…";
}

/// What kind of value goes there; where there is a range, that says the unit.
template <class Struct> std::string expected_kind(const Key<Struct>& key) {
    Key<Struct> plain = key;
    if (!range_text(key.rule).empty())
        plain.rule.unit = {};
    return expected_value(plain);
}

std::string described(const KeyRule& rule, const std::string& expected) {
    std::string text(rule.explanation);
    const std::string range = range_text(rule);
    text += fmt::format(" {}{}.", static_cast<char>(std::toupper(static_cast<unsigned char>(expected[0]))),
                        expected.substr(1) + (range.empty() ? "" : ", " + range));
    if (!rule.if_left_out.empty())
        text += fmt::format(" Left out: {}.", rule.if_left_out);
    return text;
}

template <class Struct>
void add_keys(std::string& text, const Section<Struct>& section, const Values& values, bool is_idle,
              bool with_comments, const nlohmann::ordered_json& schema) {
    for (const Key<Struct>& key : section.keys) {
        const auto value = values.find(key.rule.name);
        if (value == values.end() && !with_comments)
            continue;
        if (with_comments)
            text += "\n" + comment(without_links(described(key.rule, expected_kind(key))));
        if (value != values.end() && !is_idle)
            text += fmt::format("{} = {}\n", key.rule.name, value->second);
        else
            text += fmt::format("# {} = {}\n", key.rule.name,
                                placeholder(schema.at("properties").at(std::string(key.rule.name))));
    }
    for (const Section<Struct>& table : section.tables) {
        if (!with_comments)
            continue;
        text += "\n" + comment(table.explanation);
        std::string keys;
        for (const Key<Struct>& key : table.keys)
            keys += fmt::format("{}{} = …", keys.empty() ? "" : ", ", key.rule.name);
        text += fmt::format("# {} = {{ {} }}\n", table.name, keys);
    }
}

template <class Struct>
void add_section(std::string& text, const Section<Struct>& section, std::string_view name,
                 const nlohmann::ordered_json& whole) {
    const auto& found = whole.at("properties").at(std::string(section.name));
    const auto& schema = section.many ? found.at("items") : found;
    const auto known = starter_values().find(section.name);
    std::vector<Values> entries = known == starter_values().end() ? std::vector<Values>{{}} : known->second;
    const bool is_idle = section.many && known == starter_values().end();
    const std::string quoted = fmt::format("\"{}\"", name);
    if (section.name == "protocol")
        entries.front()["name"] = quoted;
    text += "\n# " + std::string(76, '-') + "\n" + comment(without_links(section.explanation)) + "\n";
    for (std::size_t entry = 0; entry < entries.size(); ++entry) {
        if (entry > 0)
            text += "\n";
        const std::string heading =
            section.many ? fmt::format("[[{}]]", section.name) : fmt::format("[{}]", section.name);
        text += (is_idle ? "# " : "") + heading + "\n";
        add_keys(text, section, entries[entry], is_idle, entry == 0, schema);
    }
}

} // namespace

std::string protocol_starter(std::string_view name) {
    std::string text =
        fmt::format("# {}: a protocol of overt, to be made your own.\n#\n"
                    "#   overt check {}.toml       what this file amounts to, and what is wrong with it\n"
                    "#   overt run {}.toml --observer P01 --simulate-observer 1\n#\n"
                    "# Lines that begin with # are comments; a key that is left out has its default.\n"
                    "# The end of a key's name is its unit: _px, _mm, _deg, _hz, _s.\n\n"
                    "# What belongs to the rig can stand in a file of its own:\n# include = \"rig.toml\"\n",
                    name, name, name);
    const nlohmann::ordered_json schema = protocol_schema();
    for_each_section([&](const auto& section) { add_section(text, section, name, schema); });
    return text;
}

} // namespace overt
