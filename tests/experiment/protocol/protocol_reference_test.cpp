#include "experiment/protocol/protocol_reference.h"

#include <algorithm>
#include <cstdlib>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/protocol/protocol_keys.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("docs/protocols.md is what the table of keys says", "[unit]") {
    const auto file = source_path("docs/protocols.md");
    // OVERT_WRITE_REFERENCE=1 writes the page anew after a change of the table.
    if (std::getenv("OVERT_WRITE_REFERENCE"))
        std::ofstream(file, std::ios::binary) << protocol_reference_markdown();
    CHECK(text_of_file(file) == protocol_reference_markdown());
}

TEST_CASE("every key is explained in a sentence, once in its section, with its unit in its name", "[unit]") {
    for_each_section([](const auto& section) {
        std::set<std::string_view> names;
        for (const auto& key : section.keys) {
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
    });
}

TEST_CASE("the defaults are in the ranges of their keys", "[unit]") {
    const auto is_inside = [](const KeyRule& rule, double value) {
        return value >= rule.low && value <= rule.high;
    };
    for_each_section([&]<class Struct>(const Section<Struct>& section) {
        const Struct defaults{};
        for (const Key<Struct>& key : section.keys) {
            CAPTURE(section.name, key.rule.name);
            std::visit(
                [&]<class Value>(Value Struct::*member) {
                    if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, double>)
                        CHECK(is_inside(key.rule, static_cast<double>(defaults.*member)));
                    if constexpr (std::is_same_v<Value, Degrees>)
                        CHECK(is_inside(key.rule, (defaults.*member).value));
                    if constexpr (std::is_enum_v<Value>)
                        CHECK(static_cast<std::size_t>(defaults.*member) < key.rule.choices.size());
                },
                key.member);
        }
    });
}
