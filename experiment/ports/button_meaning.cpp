#include "experiment/ports/button_meaning.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

using Key = ResponsePress::Key;

struct WordOfKey {
    std::string_view word;
    Key key;
};
constexpr WordOfKey words_of_observer[] = {
    {"next", Key::next}, {"back", Key::back}, {"yes", Key::yes}, {"no", Key::no}};
constexpr WordOfKey words_of_operator[] = {{"pause", Key::pause},   {"recalibrate", Key::recalibrate},
                                           {"repeat", Key::repeat}, {"reject", Key::reject},
                                           {"skip", Key::skip},     {"abort", Key::abort},
                                           {"yes", Key::yes},       {"no", Key::no}};

constexpr std::string_view answer_word = "answer";

std::string_view without_blanks(std::string_view text) {
    const std::size_t first = text.find_first_not_of(' ');
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

[[noreturn]] void refuse_meaning(std::string_view text, bool is_operators) {
    throw InputError(fmt::format(
        "\"{}\" says no meaning of a button: write its name and {}", text,
        is_operators
            ? "pause, recalibrate, repeat, reject, skip, abort, yes, no or a digit, such as \"1 pause\""
            : "next, back, yes, no or answer with the answer's words, such as \"1 answer gold\""));
}

} // namespace

ButtonMeaning parse_button_meaning(std::string_view text, bool is_operators) {
    const std::string_view whole = without_blanks(text);
    // Names of buttons may have blanks in them, such as "key 57": the meaning's word ends the name.
    for (std::size_t blank = whole.find(' '); blank != std::string_view::npos;
         blank = whole.find(' ', blank + 1)) {
        const std::string_view rest = without_blanks(whole.substr(blank));
        ButtonMeaning meaning;
        meaning.button = std::string(without_blanks(whole.substr(0, blank)));
        meaning.words = std::string(rest);
        const auto named = [&](const auto& words) {
            const auto found = std::ranges::find(words, rest, &WordOfKey::word);
            if (found == std::ranges::end(words))
                return false;
            meaning.key = found->key;
            return true;
        };
        if (is_operators ? named(words_of_operator) : named(words_of_observer))
            return meaning;
        if (is_operators && rest.size() == 1 && rest[0] >= '1' && rest[0] <= '9') {
            // "key 5" alone is a button without a meaning, unless a meaning follows.
            if (meaning.button == "key")
                continue;
            meaning.key = Key::character;
            meaning.character = static_cast<char32_t>(rest[0]);
            return meaning;
        }
        if (!is_operators && rest.starts_with(answer_word) && rest.size() > answer_word.size() &&
            rest[answer_word.size()] == ' ') {
            meaning.answer = std::string(without_blanks(rest.substr(answer_word.size())));
            return meaning;
        }
    }
    refuse_meaning(text, is_operators);
}

} // namespace overt
