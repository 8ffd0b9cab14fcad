#include "experiment/record/row_digest.h"

#include <bit>
#include <cstring>

#include <SQLiteCpp/SQLiteCpp.h>
#include <catch2/catch.hpp>

#include "experiment/base/content_hash.h"

using namespace overt;

namespace {

RowLocator located(const std::vector<std::uint64_t>& rows) {
    RowLocator locator;
    for (const std::uint64_t row : rows)
        locator.add(row);
    return locator;
}

/// So many rows, no two alike.
std::vector<std::uint64_t> some_rows(std::size_t count) {
    std::vector<std::uint64_t> rows;
    for (std::size_t i = 0; i < count; ++i)
        rows.push_back(0x9e3779b97f4a7c15u * (i + 1));
    return rows;
}

template <class T> std::string raw(T value) {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    return bytes;
}

SQLite::Database some_table() {
    SQLite::Database database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    database.exec("CREATE TABLE t (id INTEGER PRIMARY KEY, a, b, c); "
                  "INSERT INTO t VALUES (1, 7, 0.5, 'xyz'), (2, NULL, x'0102', ''), (3, 8, 1.5, 'q')");
    return database;
}

} // namespace

TEST_CASE("of rows of which one was changed, its number is told, whatever their count", "[unit]") {
    for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 8u, 9u, 17u, 64u, 65u}) {
        const std::vector<std::uint64_t> rows = some_rows(count);
        const std::string recorded = located(rows).bytes();
        CHECK(recorded.size() == 8 * (1 + std::bit_width(count - 1)));
        CHECK_FALSE(located(rows).differing_row(recorded));
        for (std::size_t changed = 0; changed < count; ++changed) {
            CAPTURE(count, changed);
            std::vector<std::uint64_t> others = rows;
            others[changed] ^= 0x10u;
            CHECK(located(others).differing_row(recorded) == static_cast<std::int64_t>(changed));
        }
    }
}

TEST_CASE("of two changed rows, or of another number of rows, no row is told", "[unit]") {
    const std::vector<std::uint64_t> rows = some_rows(13);
    const std::string recorded = located(rows).bytes();
    for (std::size_t a = 0; a < rows.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            std::vector<std::uint64_t> others = rows;
            others[a] ^= 0x10u;
            others[b] ^= 0x20u;
            CAPTURE(a, b);
            CHECK_FALSE(located(others).differing_row(recorded));
        }
    CHECK_FALSE(located(some_rows(17)).differing_row(recorded));
    CHECK_FALSE(located(some_rows(3)).differing_row(recorded));
    CHECK_FALSE(located({}).differing_row(recorded));
    CHECK(located({}).bytes() == std::string(8, '\0'));
    // A number beyond the rows that there are is no row's.
    RowLocator five = located(some_rows(5));
    std::string beyond = five.bytes();
    for (const std::size_t word : {0u, 1u, 2u, 3u}) // all bits of the number 7
        beyond[8 * word] ^= 1;
    CHECK_FALSE(five.differing_row(beyond));
    beyond = five.bytes();
    for (const std::size_t word : {0u, 1u, 3u}) // and of 5
        beyond[8 * word] ^= 1;
    CHECK_FALSE(five.differing_row(beyond));
    beyond[8] ^= 1; // of 4
    CHECK(five.differing_row(beyond) == 4);
}

TEST_CASE("a digest is that of each value's type, length and bytes", "[unit]") {
    const SQLite::Database database = some_table();
    const RowDigest digest = digest_rows(database, {"t", "a, b, c", "", "id"}, 0, 0);
    const std::string first = std::string("\x01") + raw(std::int64_t{7}) + "\x02" + raw(0.5) + "\x03" +
                              raw(std::uint64_t{3}) + "xyz";
    const std::string second =
        std::string("\x05") + "\x04" + raw(std::uint64_t{2}) + "\x01\x02" + "\x03" + raw(std::uint64_t{0});
    const std::string third =
        std::string("\x01") + raw(std::int64_t{8}) + "\x02" + raw(1.5) + "\x03" + raw(std::uint64_t{1}) + "q";
    CHECK(digest.rows == 3);
    CHECK(digest.sha256 == hash_of_text(first + second + third));
    const auto fnv = [](const std::string& bytes) {
        std::uint64_t hash = 0xcbf29ce484222325u;
        for (const char c : bytes)
            hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
        return hash;
    };
    CHECK(digest.locator.bytes() == located({fnv(first), fnv(second), fnv(third)}).bytes());
    CHECK(digest_rows(database, {"t", "a, b, c", "", "id DESC"}, 0, 0).sha256 ==
          hash_of_text(third + second + first));
    CHECK(digest_rows(database, {"t", "a, b, c", "id > ? AND id <= ?", "id"}, 1, 3).sha256 ==
          hash_of_text(second + third));
    CHECK(digest_rows(database, {"t", "a, b, c", "id = ?", "id"}, 1, 0).sha256 == hash_of_text(first));
    CHECK(digest_rows(database, {"t", "a, b, c", "id = ?", "id"}, 9, 0).rows == 0);
}

TEST_CASE("a digest of many bytes is that of all of them", "[unit]") {
    SQLite::Database database = some_table();
    database.exec("DELETE FROM t");
    std::string all;
    for (int i = 0; i < 40; ++i) {
        const std::string text(5000, static_cast<char>('A' + i));
        SQLite::Statement insert(database, "INSERT INTO t (id, a) VALUES (?, ?)");
        insert.bind(1, i);
        insert.bind(2, text);
        insert.exec();
        all += "\x03" + raw(std::uint64_t{5000}) + text;
    }
    CHECK(digest_rows(database, {"t", "a", "", "id"}, 0, 0).sha256 == hash_of_text(all));
}
