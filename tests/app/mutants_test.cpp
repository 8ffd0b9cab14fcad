/// The list of changes that the tests must notice (tests/mutants) fits the source as it is.
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>

#include "experiment/keys/toml_tree.h"

using namespace overt;
namespace fs = std::filesystem;

namespace {

std::string text_in(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

/// How often a part stands in a text.
int occurrences(const std::string& text, const std::string& part) {
    int count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

} // namespace

TEST_CASE("each change that the tests must notice has its place in the source, once", "[unit]") {
    const fs::path root = OVERT_SOURCE_DIR, list = root / "tests/mutants/mutants.toml";
    Diagnostics diagnostics;
    const TomlFile toml = parse_toml(text_in(list), list.string(), diagnostics);
    REQUIRE(toml.is_whole);
    REQUIRE(toml.root.size() == 1);
    const TomlList& changes = *toml.root.front().value.list();
    CHECK(changes.size() >= 100);
    for (const TomlValue& change : changes) {
        std::map<std::string, std::string> keys;
        for (const TomlEntry& entry : *change.table())
            keys[entry.key] = std::get<std::string>(entry.value.content);
        INFO(keys["file"] << ": " << keys["is"]);
        CHECK(occurrences(text_in(root / keys["file"]), keys["from"]) == 1);
        CHECK(keys["from"] != keys["to"]);
        CHECK_FALSE(keys["tests"].empty());
    }
}
