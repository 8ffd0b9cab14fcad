#include "experiment/base/whole_file.h"

#include <cerrno>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace std::string_literals;
using overt::test::TemporaryFolder;
namespace fs = std::filesystem;

TEST_CASE("a text comes back as it was written, with nothing beside it", "[unit]") {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "a.txt";
    // Longer than one piece, with bytes that text streams would change.
    const std::string text = std::string(200'000, 'x') + "\r\n\0\x1a end"s;
    write_whole_file(file, "before");
    write_whole_file(file, text);
    CHECK(read_whole_file(file) == text);
    CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 1);
}

TEST_CASE("what cannot be read says why, by its name", "[unit]") {
    const TemporaryFolder folder;
    const auto error_of = [](const fs::path& file, std::size_t most_bytes) {
        int error = 0;
        CHECK_FALSE(read_whole_file(file, most_bytes, error));
        return error;
    };
    const fs::path file = folder.path() / "a.txt";
    CHECK(error_of(file, 100) == ENOENT);
    CHECK(error_of(folder.path(), 100) == EISDIR);
    write_whole_file(file, std::string(101, 'x'));
    CHECK(error_of(file, 100) == EFBIG);
    int error = -1;
    CHECK(read_whole_file(file, 101, error) == std::string(101, 'x'));
    CHECK(error == 0);
    CHECK_THROWS_WITH(read_whole_file(folder.path() / "b.txt"),
                      Catch::Contains("b.txt: cannot be read: No such"));
}

TEST_CASE("a file that cannot be replaced stays, and the reason has its remedy", "[unit]") {
    const TemporaryFolder folder;
    const fs::path taken = folder.path() / "taken";
    fs::create_directories(taken / "inside");
    CHECK_THROWS_WITH(write_whole_file(taken, "text", ". Move it away."),
                      Catch::Contains("taken: cannot be written: ") && Catch::EndsWith(". Move it away."));
    CHECK(fs::exists(taken / "inside"));
    CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 1);
}
