#include <filesystem>
#include <fstream>
#include <iterator>

#include <catch2/catch.hpp>

#include "tests/devices/opengaze/any_opengaze.h"
#include "tests/devices/pupil/any_pupil.h"
#include "tests/support/damaged_bytes.h"

namespace {

/// Each file of a corpus, whole and damaged. Gives their number.
int replay_messages(const char* target, void (*take)(std::string_view)) {
    int files = 0;
    const auto corpus = std::filesystem::path(OVERT_SOURCE_DIR) / "tests/fuzz/corpus" / target;
    for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
        INFO(entry.path().string());
        std::ifstream stream(entry.path(), std::ios::binary);
        const std::string bytes(std::istreambuf_iterator<char>(stream), {});
        take(bytes);
        overt::test::each_damage(bytes, 2000, take);
        ++files;
    }
    return files;
}

} // namespace

TEST_CASE("no damage to what a tracker on the network says does any harm", "[unit]") {
    CHECK(replay_messages("opengaze", overt::test::take_any_opengaze) > 0);
    CHECK(replay_messages("pupil", overt::test::take_any_pupil) > 0);
}
