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
            if (const double* number = key.get_if<double>(object))
                check(key.rule, *number);
            if (const Degrees* angle = key.get_if<Degrees>(object))
                check(key.rule, angle->value);
        }
    }
}
