/// The tables of output modes and of kinds of material.
#include <fstream>
#include <set>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/protocol/keys/protocol_keys.h"

using namespace overt;

TEST_CASE("each output mode is found by its name, and stands in docs/output.md with what a pixel carries",
          "[unit]") {
    std::ifstream file(std::string(OVERT_SOURCE_DIR) + "/docs/output.md");
    const std::string docs{std::istreambuf_iterator<char>(file), {}};
    std::set<std::string_view> names;
    for (const OutputModeRow& row : output_modes) {
        CAPTURE(row.name);
        CHECK(names.insert(row.name).second);
        CHECK(output_mode_called(row.name) == row.mode);
        CHECK(docs.find(fmt::format("| `{}` | {} |", row.name, row.explanation)) != std::string::npos);
        CHECK((!row.is_packed || row.framebuffer_bits == 8)); // codes are put together of bytes
    }
    CHECK(output_mode_called("mono") == std::nullopt);
    CHECK(output_mode_called("") == std::nullopt);
}

TEST_CASE("names are listed as a sentence has them", "[unit]") {
    CHECK(listed({}).empty());
    CHECK(listed({"mono++"}) == "mono++");
    CHECK(listed({"mono++", "color++"}) == "mono++ or color++");
    CHECK(listed({"mono++", "color++", "bits++"}) == "mono++, color++ or bits++");
}

TEST_CASE("every key of a material is some kind's, and every kind's keys are keys of a material", "[unit]") {
    std::set<std::string_view> of_kinds, of_section;
    for (const MaterialKindRow& row : material_kinds) {
        for (const std::string_view key : row.keys) {
            if (!key.empty())
                of_kinds.insert(key);
        }
    }
    for (const auto& key : protocol_keys().section("material").keys)
        of_section.insert(key.rule.name);
    for (const std::string_view everybodys : {"id", "title", "columns", "series", "kind"})
        CHECK(of_section.erase(everybodys) == 1);
    CHECK(of_kinds == of_section);
}
