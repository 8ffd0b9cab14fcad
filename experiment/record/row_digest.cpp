#include "experiment/record/row_digest.h"

#include <bit>
#include <cstring>
#include <memory>
#include <span>

#include <SQLiteCpp/Database.h>
#include <fmt/format.h>
#include <sqlite3.h>

namespace overt {
namespace {

/// Rows are handed to SHA-256 in pieces of about this size: it is set up anew for each.
constexpr std::size_t piece_bytes = 1 << 16;

/// FNV-1a: each step can be undone, so that no single changed byte goes unseen.
std::uint64_t short_hash(const char* bytes, std::size_t count) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (std::size_t i = 0; i < count; ++i)
        hash = (hash ^ static_cast<unsigned char>(bytes[i])) * 0x100000001b3u;
    return hash;
}

template <class T> void append(std::string& bytes, T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes.append(raw, sizeof(T));
}

void append_value(std::string& bytes, sqlite3_stmt* row, int column) {
    const int type = sqlite3_column_type(row, column);
    bytes.push_back(static_cast<char>(type));
    switch (type) {
    case SQLITE_INTEGER:
        return append(bytes, static_cast<std::int64_t>(sqlite3_column_int64(row, column)));
    case SQLITE_FLOAT:
        return append(bytes, sqlite3_column_double(row, column));
    case SQLITE_NULL:
        return;
    default: // text and blobs, byte for byte
        const void* const data = sqlite3_column_blob(row, column);
        const auto count = static_cast<std::size_t>(sqlite3_column_bytes(row, column));
        append(bytes, static_cast<std::uint64_t>(count));
        if (count > 0)
            bytes.append(static_cast<const char*>(data), count);
    }
}

struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};

} // namespace

void RowLocator::add(std::uint64_t row_hash) {
    const auto number = static_cast<std::uint64_t>(rows_++);
    words_.resize(std::max(words_.size(), static_cast<std::size_t>(std::bit_width(number)) + 1));
    words_[0] ^= row_hash;
    for (std::size_t bit = 0; bit + 1 < words_.size(); ++bit)
        if ((number >> bit) & 1u)
            words_[bit + 1] ^= row_hash;
}

std::string RowLocator::bytes() const {
    std::string bytes;
    for (const std::uint64_t word : words_)
        append(bytes, word);
    return bytes;
}

std::optional<std::int64_t> RowLocator::differing_row(const std::string& recorded) const {
    if (recorded.size() != words_.size() * sizeof(std::uint64_t))
        return std::nullopt;
    std::uint64_t all = 0;
    std::int64_t number = 0;
    for (std::size_t i = 0; i < words_.size(); ++i) {
        std::uint64_t word = 0;
        std::memcpy(&word, recorded.data() + i * sizeof(word), sizeof(word));
        const std::uint64_t difference = word ^ words_[i];
        if (i == 0)
            all = difference;
        else if (difference == all)
            number |= std::int64_t{1} << (i - 1);
        else if (difference != 0)
            return std::nullopt; // more than one row
    }
    return all != 0 && number < rows_ ? std::optional(number) : std::nullopt;
}

RowDigest digest_rows(const SQLite::Database& database, const RowChoice& rows, std::int64_t first_parameter,
                      std::int64_t second_parameter) {
    const std::string sql = fmt::format("SELECT {} FROM \"{}\"{}{} ORDER BY {}", rows.columns, rows.table,
                                        rows.condition.empty() ? "" : " WHERE ", rows.condition, rows.order);
    sqlite3_stmt* raw = nullptr;
    database.check(sqlite3_prepare_v2(database.getHandle(), sql.c_str(), -1, &raw, nullptr));
    const std::unique_ptr<sqlite3_stmt, Finalize> statement(raw);
    const int parameters = sqlite3_bind_parameter_count(raw);
    if (parameters > 0)
        database.check(sqlite3_bind_int64(raw, 1, first_parameter));
    if (parameters > 1)
        database.check(sqlite3_bind_int64(raw, 2, second_parameter));

    RowDigest digest;
    ContentHasher hasher;
    std::string bytes;
    const int columns = sqlite3_column_count(raw);
    int result = SQLITE_ROW;
    for (; (result = sqlite3_step(raw)) == SQLITE_ROW; ++digest.rows) {
        const std::size_t begin = bytes.size();
        for (int column = 0; column < columns; ++column)
            append_value(bytes, raw, column);
        digest.locator.add(short_hash(bytes.data() + begin, bytes.size() - begin));
        if (bytes.size() >= piece_bytes) {
            hasher.add_bytes(std::as_bytes(std::span(bytes)));
            bytes.clear();
        }
    }
    if (result != SQLITE_DONE)
        database.check(result);
    hasher.add_bytes(std::as_bytes(std::span(bytes)));
    digest.sha256 = hasher.finish();
    return digest;
}

} // namespace overt
