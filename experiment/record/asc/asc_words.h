/// Words and numbers of a line of text.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

namespace overt {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t'; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes words from a line, separated by blanks and tabs.
class Words {
  public:
    explicit Words(std::string_view line) : rest_(line) {}

    /// The next word; empty if there is none.
    std::string_view next() {
        skip_blanks();
        std::size_t length = 0;
        while (length < rest_.size() && !is_blank(rest_[length]))
            ++length;
        const std::string_view word = rest_.substr(0, length);
        rest_.remove_prefix(length);
        return word;
    }
    /// All that is left, without the blank before it.
    std::string_view rest() const { return rest_.empty() ? rest_ : rest_.substr(1); }

  private:
    void skip_blanks() {
        while (!rest_.empty() && is_blank(rest_.front()))
            rest_.remove_prefix(1);
    }
    std::string_view rest_;
};

/// Takes columns from a line, separated by tabs, without the blanks at their ends: they may hold blanks, or
/// nothing.
class Columns {
  public:
    explicit Columns(std::string_view line) : rest_(line), is_over_(line.empty()) {}

    bool are_over() const { return is_over_; }
    std::string_view next() {
        const std::size_t end = std::min(rest_.find('\t'), rest_.size());
        std::string_view column = rest_.substr(0, end);
        is_over_ = end == rest_.size();
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        column.remove_prefix(std::min(column.find_first_not_of(' '), column.size()));
        return column.substr(0, column.find_last_not_of(' ') + 1);
    }

  private:
    std::string_view rest_;
    bool is_over_;
};

/// A finite number that takes up the whole word. A comma in place of the point is one of its decimals:
/// programs that open a recording where that is usual save it so.
inline std::optional<double> number_of(std::string_view word) {
    double number = 0.0;
    if (!word.empty() && word.front() == '+')
        word.remove_prefix(1);
    std::array<char, 64> with_point; // NOLINT: filled in below
    if (const std::size_t comma = word.find(','); comma != std::string_view::npos) {
        if (word.size() > with_point.size() || word.find_first_of(".,") != comma ||
            word.find_first_of(".,", comma + 1) != std::string_view::npos)
            return std::nullopt;
        std::copy(word.begin(), word.end(), with_point.begin());
        with_point[comma] = '.';
        word = std::string_view(with_point.data(), word.size());
    }
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number))
        return std::nullopt;
    return number;
}

/// How edf2asc writes what is missing: a point, or what its -miss names, which many have be NaN.
inline bool is_missing(std::string_view word) {
    return word == "." || word == "NaN" || word == "nan" || word == "NAN";
}

/// What stands after a sample's values: a letter in its place for each thing that was wrong, else a point.
/// Three of one eye (interpolated, reflection missing, reflection coming back), five of both, and more of the
/// target on the head in remote mode.
inline bool is_status(std::string_view word) {
    constexpr std::string_view of_one = "ICR", of_both = "ICRCR", of_target = "MANCFTBLRI";
    const auto has_letters_of = [&](std::string_view letters) {
        return std::equal(word.begin(), word.end(), letters.begin(), letters.end(),
                          [](char c, char letter) { return c == '.' || c == ',' || c == letter; });
    };
    return has_letters_of(of_one) || has_letters_of(of_both) ||
           (word.size() > of_both.size() && std::all_of(word.begin(), word.end(), [&](char c) {
                return c == '.' || c == ',' || of_target.find(c) != std::string_view::npos;
            }));
}

/// Lines that are there for people, as the tracker's manual has them.
inline bool is_comment(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t");
    return first != std::string_view::npos &&
           (line[first] == '#' || line[first] == ';' || line[first] == '/');
}

/// Microseconds of a time in milliseconds, such as "7196720" or "7196720.5"; nothing if it is none.
std::optional<std::int64_t> asc_time_us(std::string_view text);

} // namespace overt
