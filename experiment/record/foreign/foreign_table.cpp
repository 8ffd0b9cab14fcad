#include "experiment/record/foreign/foreign_table.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zlib.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

constexpr std::string_view utf8_mark = "\xef\xbb\xbf";
/// A line that is longer is no row of a table.
constexpr std::size_t longest_line = std::size_t{1} << 20;

std::string_view trimmed_cell(std::string_view cell) {
    while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t'))
        cell.remove_prefix(1);
    while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t'))
        cell.remove_suffix(1);
    return cell;
}

/// Without a unit in brackets at its end.
std::string_view without_unit(std::string_view name) {
    const std::size_t bracket = name.find_first_of("[(");
    return trimmed_cell(name.substr(0, bracket));
}

} // namespace

struct ForeignTable::Packed {
    gzFile file = nullptr;
    std::array<char, 65536> bytes{};
    std::size_t at = 0, end = 0;
    Packed() = default;
    Packed(const Packed&) = delete;
    Packed& operator=(const Packed&) = delete;
    ~Packed() {
        if (file)
            gzclose(file);
    }
};

ForeignTable::ForeignTable(const std::filesystem::path& file, std::vector<std::string> names)
    : file_(file), packed_(std::make_unique<Packed>()), columns_(std::move(names)) {
    if (!std::filesystem::is_regular_file(file))
        throw InputError(fmt::format("{}: there is no such file", file.string()));
    packed_->file = gzopen(file.c_str(), "rb");
    if (!packed_->file)
        throw InputError(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
    if (!columns_.empty()) {
        separator_ = '\t';
        return;
    }
    for (std::string line; read_line(line);) {
        if (line.starts_with(utf8_mark))
            line.erase(0, utf8_mark.size());
        if (line.starts_with("#"))
            comments_.push_back(line);
        else if (!trimmed_cell(line).empty()) {
            const auto count = [&](char c) { return std::ranges::count(line, c); };
            separator_ = count('\t') > 0 ? '\t' : count(';') > count(',') ? ';' : ',';
            split(line);
            break;
        }
    }
    for (const std::string& cell : cells_)
        columns_.emplace_back(trimmed_cell(cell));
    if (columns_.size() < 2)
        throw InputError(fmt::format("{}: is no table: its first line has to name columns, with tabs, commas "
                                     "or semicolons between them",
                                     file.string()));
}

ForeignTable::~ForeignTable() = default;
ForeignTable::ForeignTable(ForeignTable&&) noexcept = default;

std::optional<std::size_t> ForeignTable::find(std::string_view name) const {
    if (const auto exact = std::ranges::find(columns_, name); exact != columns_.end())
        return static_cast<std::size_t>(exact - columns_.begin());
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        if (without_unit(columns_[i]) != name)
            continue;
        if (found)
            return std::nullopt; // nobody knows which
        found = i;
    }
    return found;
}

std::size_t ForeignTable::require(const std::string& name, std::string_view what) const {
    if (const auto found = find(name))
        return *found;
    throw InputError(fmt::format("{}: has no column \"{}\" for {}; its columns are: {}", file_.string(), name,
                                 what, columns_in_words()));
}

std::string ForeignTable::columns_in_words() const {
    constexpr std::size_t shown = 40;
    const std::size_t count = std::min(shown, columns_.size());
    const std::string names = fmt::format(
        "{}", fmt::join(columns_.begin(), columns_.begin() + static_cast<std::ptrdiff_t>(count), ", "));
    return columns_.size() > count ? fmt::format("{} and {} more", names, columns_.size() - count) : names;
}

std::string ForeignTable::place() const { return fmt::format("{}:{}", file_.string(), row_line_); }

bool ForeignTable::read_line(std::string& line) {
    line.clear();
    for (;;) {
        if (packed_->at == packed_->end) {
            const int count =
                gzread(packed_->file, packed_->bytes.data(), static_cast<unsigned>(packed_->bytes.size()));
            if (count < 0)
                throw InputError(fmt::format("{}: is damaged: it cannot be unpacked (gzip)", file_.string()));
            if (count == 0)
                break;
            packed_->at = 0;
            packed_->end = static_cast<std::size_t>(count);
        }
        const char* const begin = packed_->bytes.data() + packed_->at;
        const std::size_t left = packed_->end - packed_->at;
        const void* const found = std::memchr(begin, '\n', left);
        const std::size_t take =
            found ? static_cast<std::size_t>(static_cast<const char*>(found) - begin) : left;
        line.append(begin, take);
        packed_->at += take + (found ? 1 : 0);
        if (line.size() > longest_line || line.find('\0') != std::string::npos)
            throw InputError(fmt::format("{}:{}: is no text of rows: export the recording as text (UTF-8)",
                                         file_.string(), line_ + 1));
        if (found) {
            ++line_;
            if (!line.empty() && line.back() == '\r')
                line.pop_back();
            return true;
        }
    }
    if (line.empty())
        return false;
    ++line_;
    return true;
}

void ForeignTable::split(const std::string& line) {
    cells_.clear();
    std::string cell;
    bool in_quotes = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (in_quotes && c == '"' && i + 1 < line.size() && line[i + 1] == '"')
            cell += line[++i];
        else if (c == '"' && (in_quotes || cell.empty()))
            in_quotes = !in_quotes;
        else if (c == separator_ && !in_quotes)
            cells_.push_back(std::exchange(cell, {}));
        else
            cell += c;
    }
    cells_.push_back(std::move(cell));
}

bool ForeignTable::next() {
    for (std::string line; read_line(line);) {
        row_line_ = line_;
        // A quoted cell may go on over several lines.
        std::string more;
        while (separator_ != '\t' && std::ranges::count(line, '"') % 2 == 1 && line.size() < longest_line &&
               read_line(more))
            line += '\n' + more;
        if (trimmed_cell(line).empty())
            continue;
        split(line);
        return true;
    }
    return false;
}

bool is_missing_cell(std::string_view cell) {
    constexpr std::array<std::string_view, 12> words{"",   ".",    "n/a",  "N/A", "NaN", "nan",
                                                     "NA", "None", "null", "-",   "--",  "NULL"};
    return std::ranges::find(words, trimmed_cell(cell)) != words.end();
}

std::optional<double> number_in_cell(std::string_view cell) {
    std::string text(trimmed_cell(cell));
    if (text.starts_with('+'))
        text.erase(0, 1);
    if (const std::size_t comma = text.find(','); comma != std::string::npos)
        text[comma] = '.';
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() && std::isfinite(number)
               ? std::optional(number)
               : std::nullopt;
}

std::vector<std::pair<std::string, std::string>> column_words(const std::vector<std::string>& given,
                                                              const std::vector<std::string_view>& known,
                                                              std::string_view option) {
    std::vector<std::pair<std::string, std::string>> words;
    const auto take = [&](const std::string& word) {
        const std::size_t at = word.find('=');
        const std::string key = word.substr(0, at);
        if (at == std::string::npos || at + 1 == word.size())
            throw InputError(fmt::format("{} {}: is no KEY=COLUMN", option, word));
        if (!known.empty() && std::ranges::find(known, key) == known.end())
            throw InputError(fmt::format("{} {}: there is no such key; there are {}", option, word,
                                         fmt::join(known, ", ")));
        words.emplace_back(key, word.substr(at + 1));
    };
    for (const std::string& list : given) {
        std::string word;
        for (std::size_t i = 0; i < list.size(); ++i) {
            if (list[i] == '\\' && i + 1 < list.size() && list[i + 1] == ',')
                word += list[++i];
            else if (list[i] == ',')
                take(std::exchange(word, {}));
            else
                word += list[i];
        }
        take(word);
    }
    return words;
}

} // namespace overt
