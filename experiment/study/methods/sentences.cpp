#include "experiment/study/methods/sentences.h"

#include <cctype>
#include <cmath>

#include <fmt/format.h>

namespace overt {

namespace {

int decimals_of(double number, int most_decimals) {
    if (number == 0.0 || !std::isfinite(number))
        return 0;
    const int leading = static_cast<int>(std::floor(std::log10(std::abs(number))));
    return std::clamp(2 - leading, 0, most_decimals);
}

/// Without zeros at the end, which digits that somebody measured may have and counted ones not.
std::string fixed(double number, int decimals) {
    std::string text = fmt::format("{:.{}f}", number, decimals);
    // No minus before a zero.
    if (text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos)
        text.erase(0, 1);
    return text;
}

bool is_zero(const std::string& text) { return text.find_first_not_of("-0.") == std::string::npos; }

std::string fixed_or_below(double number, int decimals, int most_decimals) {
    const std::string text = fixed(number, decimals);
    if (number == 0.0 || !is_zero(text))
        return number == 0.0 ? "0" : text;
    return fmt::format("below {}", fixed(std::pow(10.0, -most_decimals), most_decimals));
}

} // namespace

std::string joined_words(std::span<const std::string> words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += fmt::format("{}{}", i == 0 ? "" : i + 1 == words.size() ? " and " : ", ", words[i]);
    return text;
}

void add_sentence(std::string& text, std::string_view clause) {
    if (clause.empty())
        return;
    if (!text.empty())
        text += ' ';
    const std::size_t first = text.size();
    text += clause;
    text[first] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[first])));
    // A question at the end brings its own.
    if (!text.ends_with('.') && !text.ends_with(".\"") && !text.ends_with("?\"") && !text.ends_with("!\""))
        text += '.';
}

std::string as_set(double number) { return fmt::format("{:.6g}", number); }

std::string as_measured(double number, int most_decimals) {
    return fixed_or_below(number, decimals_of(number, most_decimals), most_decimals);
}

std::string as_count(std::int64_t number) {
    std::string text = fmt::format("{}", number);
    for (int at = static_cast<int>(text.size()) - 3; at > (number < 0 ? 1 : 0); at -= 3)
        text.insert(static_cast<std::size_t>(at), ",");
    return text;
}

std::string as_counted(std::int64_t number, std::string_view one) {
    return fmt::format("{} {}{}", as_count(number), one, number == 1 ? "" : "s");
}

std::string as_spread(const Spread& spread, std::string_view unit, int most_decimals) {
    const double leading = spread.median != 0.0 ? spread.median : spread.most;
    const int decimals = decimals_of(leading, most_decimals);
    const auto text = [&](double number) { return fixed_or_below(number, decimals, most_decimals); };
    const std::string middle = fmt::format("{} {}", text(spread.median), unit);
    if (spread.trials == 1)
        return fmt::format("{} (1 {})", middle, spread.thing);
    if (text(spread.least) == text(spread.most))
        return fmt::format("{} (the same in {})", middle, as_counted(spread.trials, spread.thing));
    return fmt::format("{} (median over {}; {} to {} {})", middle, as_counted(spread.trials, spread.thing),
                       text(spread.least), text(spread.most), unit);
}

std::string share_of(int part, int all, std::string_view thing) {
    if (part == all)
        return all == 1 ? fmt::format("the one {}", thing) : fmt::format("all {} {}s", as_count(all), thing);
    return fmt::format("{} of {}", as_count(part),
                       all == 1 ? fmt::format("1 {}", thing) : fmt::format("{} {}s", as_count(all), thing));
}

void add_over_sessions(std::string& text, const StudyResults& results,
                       const std::function<std::string(const StudySession&)>& clause) {
    const auto clauses = over_sessions(results, clause);
    const int sessions = static_cast<int>(results.sessions.size());
    for (const auto& [words, count] : clauses) {
        if (words.empty())
            continue;
        if (clauses.size() == 1)
            add_sentence(text, words);
        else
            add_sentence(text, fmt::format("in {}, {}", share_of(count, sessions, "session"), words));
    }
}

} // namespace overt
