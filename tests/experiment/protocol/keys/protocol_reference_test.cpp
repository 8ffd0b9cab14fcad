#include "experiment/protocol/keys/protocol_keys.h"

#include <algorithm>
#include <cstdlib>
#include <set>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr std::string_view introduction = R"(# Protocol files

A protocol file says all that an experiment consists of: the rig, the stimuli, the questions and their order.
It is a [TOML](https://toml.io/en/v1.0.0) file, to be edited with any text editor:

```toml
[section]
key = 12.5                # a number, in the unit at the end of the key's name
other_key = "a text"

[[list]]                  # two brackets begin one entry of a list; repeat them for the next
id = "first"
```

`overt check FILE` finds everything that is wrong with a file, with line and column, and shows what the
experiment amounts to. To begin with, read [protocols/overt_2019.toml](../protocols/overt_2019.toml), which
is the experiment of the 2019 paper with every choice explained;
[protocols/quick_look.toml](../protocols/quick_look.toml) is the smallest that runs. How to use laser scans
and other meshes of your own is in [laser_scans.md](laser_scans.md); blocks, limits, squares, groups, breaks and repeated
trials are shown by examples in [design.md](design.md); the form, the operator's keys and spoken answers in
[sitting.md](sitting.md). `overt new FILE` writes a protocol to begin with.

Editors that know TOML (Visual Studio Code with Even Better TOML, say) complete keys, explain them and mark mistakes as you write,
by a JSON Schema: write it once with `overt schema > protocol.schema.json`, and begin each protocol with the line
`#:schema ./protocol.schema.json`. What one key has to do with another, and with files, only `overt check` knows.

- A key that is left out has its default.
- `include = "rig.toml"`, or a list of files, before the first section completes a protocol by other files, say that of
  the rig. Keys of the same section are put together, and those of the including file hold; two files included side by
  side may not set the same key. Entries of lists are put together, included ones first. Includes may be nested; a file
  that is included twice counts once, and one that includes itself is refused. A session keeps the texts of all files.
- Units are part of the names: `_mm`, `_deg` (degrees of visual angle or of turn), `_px`, `_hz`, `_s`, `_ms`.
- A whole number may stand where a number is expected, never the other way round.
- Paths count from the folder of the file that they stand in.
- The stimulus is shown pixel for pixel, in the middle of the screen unless `[view]` says where.

This page is written from the program's own table of keys.
)";

/// What stands in the column of defaults.
std::string default_of(const Key& key) {
    if (key.rule.is_required)
        return "required";
    return key.rule.if_left_out.empty() ? fmt::format("`{}`", key.default_text())
                                        : std::string(key.rule.if_left_out);
}

std::string value_of(const Key& key) {
    if (!key.rule.choices.empty())
        return fmt::format("`\"{}\"`", fmt::join(key.rule.choices, "\"`, `\""));
    const std::string range = range_text(key.rule);
    return expected_kind(key) + (range.empty() ? "" : ", " + range);
}

void add_section(std::string& text, const Section& section, std::string_view parent) {
    const std::string heading =
        parent.empty()              ? section.is_never_empty()
                                          ? fmt::format("{}` or `{}", section.heading(), section.list_heading())
                                          : section.heading()
                     : section.home.is_by_name() ? fmt::format("{} = {{ NAME = {{ … }} }} in [[{}]]", section.name, parent)
        : section.is_list()         ? fmt::format("[[{}.{}]]", parent, section.name)
                                    : fmt::format("{} = {{ … }} in [[{}]]", section.name, parent);
    text += fmt::format("\n## `{}`\n\n{}\n\n| key | value | default | meaning |\n| --- | --- | --- | --- |\n",
                        heading, section.explanation);
    for (const Key& key : section.keys)
        text += fmt::format("| `{}` | {} | {} | {} |\n", key.rule.name, value_of(key), default_of(key),
                            key.rule.explanation);
    for (const Section& table : section.tables)
        add_section(text, table, section.name);
}

/// The page docs/protocols.md.
std::string protocol_reference_markdown() {
    std::string text(introduction);
    for (const Section& section : protocol_keys())
        add_section(text, section, "");
    return text;
}

} // namespace

TEST_CASE("docs/protocols.md is what the table of keys says", "[unit]") {
    const auto file = source_path("docs/protocols.md");
    // OVERT_WRITE_REFERENCE=1 writes the page anew after a change of the table.
    if (std::getenv("OVERT_WRITE_REFERENCE"))
        std::ofstream(file, std::ios::binary) << protocol_reference_markdown();
    CHECK(text_of_file(file) == protocol_reference_markdown());
}

TEST_CASE("every key is explained in a sentence, once in its section, with its unit in its name", "[unit]") {
    for (const Section& section : protocol_keys()) {
        std::set<std::string_view> names;
        for (const Key& key : section.keys) {
            CAPTURE(section.name, key.rule.name);
            CHECK(names.insert(key.rule.name).second);
            CHECK(key.rule.explanation.ends_with('.'));
            CHECK(key.rule.low < key.rule.high);
            if (!key.rule.unit.empty()) {
                std::string suffix = fmt::format("_{}", key.rule.unit);
                std::transform(suffix.begin(), suffix.end(), suffix.begin(), [](char letter) {
                    return letter == '/'                    ? '_'
                           : letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter + 32)
                                                            : letter;
                });
                CHECK(key.rule.name.ends_with(suffix));
            }
        }
    }
}

TEST_CASE("the defaults are in the ranges of their keys", "[unit]") {
    const auto check = [](const KeyRule& rule, double value) {
        CHECK(value >= rule.low);
        CHECK(value <= rule.high);
    };
    for (const Section& section : protocol_keys()) {
        for (const Key& key : section.keys) {
            CAPTURE(section.name, key.rule.name);
            const void* const object = section.home.left_out_struct();
            if (const int* whole = key.get_if<int>(object))
                check(key.rule, *whole);
            if (const auto* number = key.get_if<double>(object))
                check(key.rule, *number);
            if (const auto* angle = key.get_if<Degrees>(object))
                check(key.rule, angle->value);
        }
    }
}
