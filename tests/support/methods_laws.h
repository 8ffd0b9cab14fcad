/// What holds of the text on methods of any study, beside its study.json.
#pragma once

#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace overt::test {

/// All paragraphs of study.json's text on methods, one behind the other.
inline std::string methods_of(const nlohmann::json& study) {
    std::string text;
    for (const auto& paragraph : study.at("methods"))
        text += (text.empty() ? "" : "\n") + paragraph.at("text").get<std::string>();
    return text;
}

namespace methods_laws {

/// Numbers that stand for themselves: not those of "S2S", "cd/m2" or "v4.51".
inline std::vector<std::string> numbers_in(const std::string& text) {
    static const std::regex number(R"((^|[^A-Za-z0-9_.,/-])(-?\d[\d,]*(\.\d+)?)(?![A-Za-z0-9_.]*[A-Za-z_]))");
    std::vector<std::string> found;
    for (auto at = std::sregex_iterator(text.begin(), text.end(), number); at != std::sregex_iterator();
         ++at) {
        std::string digits = (*at)[2];
        std::erase(digits, ',');
        found.push_back(digits);
    }
    return found;
}

/// Of all members but the text itself.
inline void collect_numbers(const nlohmann::json& json, std::vector<double>& numbers) {
    if (json.is_number())
        numbers.push_back(json.get<double>());
    else if (json.is_string())
        for (const std::string& digits : numbers_in(json.get<std::string>()))
            numbers.push_back(std::stod(digits));
    else if (json.is_structured())
        for (const auto& [name, value] : json.items())
            if (name != "methods")
                collect_numbers(value, numbers);
}

/// Whether a number as it is written, with its decimals, is one of these, or of these shares in percent.
inline bool is_one_of(const std::string& digits, const std::vector<double>& numbers) {
    const std::size_t point = digits.find('.');
    const auto decimals = point == std::string::npos ? 0.0 : static_cast<double>(digits.size() - point - 1);
    const double written = std::stod(digits), scale = std::pow(10.0, decimals);
    // Three significant digits at least are written, of counts all.
    const auto is_rounded = [&](double number) { return std::abs(written - number) <= 0.5001 / scale; };
    for (const double number : numbers)
        if (is_rounded(number) || is_rounded(100.0 * number))
            return true;
    return false;
}

} // namespace methods_laws

/// Whole sentences without a hole, and no number in them that study.json does not have.
inline void check_methods(const nlohmann::json& study) {
    const std::string text = methods_of(study);
    INFO(text);
    REQUIRE(!study.at("methods").empty());
    for (const auto& paragraph : study.at("methods")) {
        const std::string words = paragraph.at("text");
        INFO(words);
        REQUIRE(!words.empty());
        CHECK(!paragraph.at("topic").get<std::string>().empty());
        CHECK((words.ends_with('.') || words.ends_with('"')));
        CHECK_FALSE(std::islower(static_cast<unsigned char>(words.front())));
        static const std::regex lower(R"([.] [a-z])");
        CHECK_FALSE(std::regex_search(words, lower));
    }
    static const std::regex hole(
        R"([{}<>]|\bnan\b|\binf\b|n/a|\bnull\b|  | [.,;:)]|\(\)|\( |""|\.\.|,,|; ?\.|\b(of|by|at|with|in|from|was|were|had) ?[.,;])");
    std::smatch found;
    const std::string empty_place = std::regex_search(text, found, hole) ? found.str() : std::string();
    CHECK(empty_place == "");
    // Singular and plural.
    static const std::regex one_of_many(
        R"((^|[^\d.,])1 (trials|sessions|observers|simulated observers|fixations|maps|objects|materials|refreshes|times|questions|samples|calibrations|were)\b)");
    CHECK_FALSE(std::regex_search(text, one_of_many));
    static const std::regex many_of_one(
        R"(\b([02-9]|\d{2,}) (trial|session|observer|simulated observer|fixation|map|object|material|time|question)\b(?! of))");
    CHECK_FALSE(std::regex_search(text, many_of_one));

    std::vector<double> numbers;
    methods_laws::collect_numbers(study, numbers);
    // The least that is written of a quantity is no result.
    const std::string results = std::regex_replace(text, std::regex(R"(below 0\.0*1\b)"), "");
    for (const std::string& digits : methods_laws::numbers_in(results)) {
        INFO("number " << digits);
        CHECK(methods_laws::is_one_of(digits, numbers));
    }

    // What is said of where gaze comes from, and of exclusions, is so.
    bool is_measured = false;
    for (const auto& gaze : study.at("setup").at("gaze"))
        is_measured |= gaze.at("origin") == "measured";
    CHECK((text.find("eye was measured at") != text.npos ||
           text.find("analysed, was measured at") != text.npos) == is_measured);
    CHECK((text.find("simulated observer") != text.npos) == (study.at("simulated_observers") > 0));
    CHECK(text.find("recorded by") == text.npos);
    bool has_rule = study.at("trials_without_gaze") > 0;
    for (const auto& parameter : study.at("parameters"))
        has_rule |=
            parameter.at("name").get<std::string>().starts_with("most-") && parameter.at("value") != "none";
    CHECK((text.find("exclu") != text.npos) == has_rule);
    CHECK((text.find(" excluded, ") != text.npos || text.find(" excluded. ") != text.npos ||
           text.ends_with(" excluded.") || text.find(" excluded.\n") != text.npos) ==
          (study.at("excluded_trials") > 0));
}

} // namespace overt::test
