#include <set>

#include <catch2/catch.hpp>

#include "tests/fuzz/more_inputs.h"
#include "tests/fuzz/view_lines.h"
#include "tests/support/damaged_bytes.h"

namespace {

std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

int replay(const char* target, void (*take)(std::string_view)) {
    const std::filesystem::path corpus =
        std::filesystem::path(OVERT_SOURCE_DIR) / "tests/fuzz/corpus" / target;
    std::set<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(corpus))
        files.insert(entry.path());
    for (const std::filesystem::path& file : files) {
        INFO(file.string());
        const std::string bytes = bytes_of(file);
        CHECK_NOTHROW(take(bytes));
        CHECK_NOTHROW(take(std::string_view(bytes).substr(0, bytes.size() / 2)));
    }
    return static_cast<int>(files.size());
}

} // namespace

TEST_CASE("protocols that fuzzers found worth keeping are read or refused", "[unit]") {
    CHECK(replay("protocol", overt::fuzz::take_protocol) > 0);
}

TEST_CASE("EyeLink recordings that fuzzers found worth keeping are imported or refused", "[unit]") {
    CHECK(replay("asc", [](std::string_view bytes) { overt::fuzz::take_asc(bytes); }) > 0);
}

TEST_CASE("session files that fuzzers found worth keeping are exported or refused", "[unit]") {
    CHECK(replay("session", overt::fuzz::take_session) > 0);
}

TEST_CASE("meshes, maps, included texts and shards, whole and damaged, are read or refused", "[unit]") {
    using namespace overt::fuzz;
    CHECK(replay("mesh", [](std::string_view bytes) { overt::test::each_damage(bytes, 60, take_mesh); }) > 0);
    CHECK(replay("labels", [](std::string_view bytes) { overt::test::each_damage(bytes, 40, take_labels); }) >
          0);
    CHECK(replay("gltf", [](std::string_view bytes) { overt::test::each_damage(bytes, 40, take_gltf); }) > 0);
    CHECK(replay("map", [](std::string_view bytes) { overt::test::each_damage(bytes, 15, take_map); }) > 0);
    CHECK(replay("texts", [](std::string_view bytes) { overt::test::each_damage(bytes, 40, take_texts); }) >
          0);
    CHECK(replay("shard", [](std::string_view bytes) { overt::test::each_damage(bytes, 40, take_shard); }) >
          0);
    for (const char* const target : {"mesh", "labels", "gltf", "map", "texts", "shard"})
        CHECK(replay(target, target == std::string_view("mesh")     ? take_mesh
                             : target == std::string_view("labels") ? take_labels
                             : target == std::string_view("gltf")   ? take_gltf
                             : target == std::string_view("map")    ? take_map
                             : target == std::string_view("texts")  ? take_texts
                                                                    : take_shard) > 0);
}

TEST_CASE("what goes through the operator's socket is understood or left out, whole and damaged", "[unit]") {
    CHECK(replay("view", [](std::string_view bytes) {
              overt::test::each_damage(bytes, 2000, overt::fuzz::take_view);
          }) > 0);
    CHECK(replay("view", overt::fuzz::take_view) > 0);
}
