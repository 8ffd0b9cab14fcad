/// Words and numbers of a line of text.
#pragma once

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

/// A finite number that takes up the whole word.
inline std::optional<double> number_of(std::string_view word) {
    double number = 0.0;
    if (!word.empty() && word.front() == '+')
        word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number))
        return std::nullopt;
    return number;
}

/// How edf2asc writes what is missing: a point, or what its -miss names, which many have be NaN.
inline bool is_missing(std::string_view word) {
    return word == "." || word == "NaN" || word == "nan" || word == "NAN";
}

/// What stands after a sample's values: points, and letters for what was wrong.
inline bool is_status(std::string_view word) {
    return word.size() >= 3 && word.find_first_not_of(".CRIMANFTBL") == std::string_view::npos;
}

/// Microseconds of a time in milliseconds, such as "7196720" or "7196720.5"; nothing if it is none.
std::optional<std::int64_t> asc_time_us(std::string_view text);

} // namespace overt
