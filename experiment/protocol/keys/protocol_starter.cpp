#include "experiment/protocol/keys/protocol_starter.h"

#include <algorithm>
#include <map>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/protocol/keys/protocol_keys.h"
#include "experiment/protocol/keys/protocol_schema.h"

namespace overt {

namespace {

using Values = std::map<std::string_view, std::string_view>; ///< by key, as TOML

/// What a beginner has to look at: an ordinary monitor, two objects in two materials, two questions.
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
           {"gamma", "2.2"},
           {"linearised_by", "\"none\""}}}},
        {"tracker", {{{"rate_hz", "1000"}}}},
        {"light", {{{"probe", "\"gallery\""}}}},
        {"consent",
         {{{"text", "\"You will look at objects on a screen, and your eyes are recorded.\\n"
                    "You may stop at any time.\\n\\nDo you agree to take part?\""}}}},
        {"instructions",
         {{{"pages", "[\"Before each object you read what to look for.\", "
                     "\"Look at the dot when it appears. Answer aloud, then press the space bar.\"]"}}}},
        {"answers", {{{"record", "\"optional\""}}}},
        {"observer_field",
         {{{"id", "\"age\""}}, {{"id", "\"sex\""}}, {{"id", "\"vision\""}}, {{"id", "\"handedness\""}}}},
        {"motion", {{{"duration_s", "4"}}}},
        {"schedule", {{{"observers", "4"}, {"max_object_run", "2"}}}},
        {"task",
         {{{"id", "\"free\""}, {"question", "\"Look at the object as you like.\""}},
          {{"id", "\"age\""},
           {"question", "\"How old is this person?\""},
           {"stimuli", "\"once-per-object\""}}}},
        {"object",
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
            line.assign(1, '#');
        }
        line += " ";
        line += word;
        begin = end + 1;
    }
    return lines + line + "\n";
}

/// A value as a comment shows it: the default, or a mark where a value goes.
std::string placeholder(const Key& key) {
    std::string text = key.default_text();
    if (text.starts_with('['))
        std::erase(text, ' ');
    return text.empty() ? "…" : text;
}

/// More choices than that are not told twice.
constexpr std::size_t many_choices = 12;

/// `like`: the key before it that has the same many choices, or null.
std::string described(const Key& key, const Key* like) {
    const KeyRule& rule = key.rule;
    std::string text(rule.explanation);
    const std::string range = range_text(rule),
                      expected =
                          like ? fmt::format("one of those of {}", like->rule.name) : expected_kind(key);
    text += fmt::format(" {}{}.", static_cast<char>(std::toupper(static_cast<unsigned char>(expected[0]))),
                        expected.substr(1) + (range.empty() ? "" : ", " + range));
    if (!rule.if_left_out.empty())
        text += fmt::format(" Left out: {}.", rule.if_left_out);
    return text;
}

void add_keys(std::string& text, const Section& section, const Values& values, bool is_idle,
              bool with_comments) {
    for (auto at = section.keys.begin(); at != section.keys.end(); ++at) {
        const Key& key = *at;
        const auto value = values.find(key.rule.name);
        const auto first = std::find_if(section.keys.begin(), at, [&](const Key& before) {
            return before.rule.choices.data() == key.rule.choices.data() &&
                   key.rule.choices.size() > many_choices;
        });
        if (value == values.end() && !with_comments)
            continue;
        if (with_comments)
            text +=
                fmt::format("\n{}", comment(without_links(described(key, first == at ? nullptr : &*first))));
        if (value != values.end() && !is_idle)
            text += fmt::format("{} = {}\n", key.rule.name, value->second);
        else
            text += fmt::format("# {} = {}\n", key.rule.name, placeholder(key));
    }
    for (const Section& table : section.tables) {
        if (!with_comments)
            continue;
        text += fmt::format("\n{}", comment(without_links(table.explanation)));
        std::string keys;
        for (const Key& key : table.keys)
            keys += fmt::format("{}{} = …", keys.empty() ? "" : ", ", key.rule.name);
        text += fmt::format(fmt::runtime(table.home.is_by_name() ? "# {} = {{ NAME = {{ {} }} }}\n"
                                         : table.is_list()       ? "# {} = [{{ {} }}]\n"
                                                                 : "# {} = {{ {} }}\n"),
                            table.name, keys);
    }
}

/// Beside keys that are otherwise left as they are by mistake.
std::string_view short_remark(std::string_view key) {
    if (key == "width_mm")
        return "            # of the lit area: measure it";
    if (key == "viewing_distance_mm")
        return " # from eye to screen";
    if (key == "gamma")
        return "               # of an ordinary monitor";
    if (key == "linearised_by")
        return "    # but by overt, for that gamma; \"display\": the display itself";
    if (key == "shipped")
        return "        # your own: mesh = \"scan.ply\"";
    return {};
}

void add_starter_section(std::string& text, const Section& section, std::string_view name) {
    const auto known = starter_values().find(section.name);
    std::vector<Values> entries = known == starter_values().end() ? std::vector<Values>{{}} : known->second;
    const bool is_idle = section.is_list() && !section.is_never_empty() && known == starter_values().end();
    const std::string quoted = fmt::format("\"{}\"", name);
    if (section.name == "protocol")
        entries.front()["name"] = quoted;
    text += "\n# " + std::string(76, '-') + "\n" + comment(without_links(section.explanation)) + "\n";
    for (std::size_t entry = 0; entry < entries.size(); ++entry) {
        if (entry > 0)
            text += "\n";
        text += (is_idle ? "# " : "") + section.heading() + "\n";
        add_keys(text, section, entries[entry], is_idle, entry == 0);
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
    for (const Section& section : protocol_keys())
        add_starter_section(text, section, name);
    return text;
}

std::string short_protocol_starter(std::string_view name) {
    std::string text = fmt::format("# {0}: overt check {0}.toml, then overt run {0}.toml --observer P01 "
                                   "--simulate-observer 1\n# All keys: overt new, or docs/protocols.md\n",
                                   name);
    const std::string quoted = fmt::format("\"{}\"", name);
    // What a session needs, and what has no default that fits most.
    constexpr std::string_view kept[] = {"protocol", "display",  "motion", "schedule",
                                         "object",   "material", "task"};
    for (const Section& section : protocol_keys()) {
        if (std::find(std::begin(kept), std::end(kept), section.name) == std::end(kept))
            continue;
        std::vector<Values> entries = starter_values().at(section.name);
        if (section.name == "protocol")
            entries.front() = {{"name", quoted}};
        for (const Values& entry : entries) {
            text += "\n" + section.heading() + "\n";
            for (const Key& key : section.keys) {
                const auto value = entry.find(key.rule.name);
                if (value == entry.end() || (section.is_list() && key.rule.name == "title"))
                    continue;
                text += fmt::format("{} = {}{}\n", key.rule.name, value->second, short_remark(key.rule.name));
            }
        }
    }
    return text;
}

} // namespace overt
