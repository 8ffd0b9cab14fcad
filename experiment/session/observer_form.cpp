#include "experiment/session/observer_form.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "experiment/base/utf8_text.h"

namespace overt {

namespace {

/// Longer than any answer; a key that is stuck must not fill the memory.
constexpr std::size_t longest_value = 400;

/// What was typed, in a text in which "<b>" is emphasis.
std::string as_it_is(const std::string& typed) {
    std::string text;
    for (const char letter : typed)
        text += letter == '<' ? "&lt;" : letter == '&' ? "&amp;" : std::string(1, letter);
    return text;
}

/// Neither a control character nor half of a pair: such are no text.
bool is_text(char32_t character) {
    return character >= 0x20 && (character < 0x7F || character > 0x9F) && character <= 0x10FFFF &&
           (character < 0xD800 || character > 0xDFFF);
}

} // namespace

ObserverForm::ObserverForm(std::span<const ObserverFieldSettings> fields, FieldValues given,
                           WordSettings words)
    : fields_(fields), values_(std::move(given)), words_(std::move(words)) {
    values_.resize(fields_.size());
    const auto empty = std::find(values_.begin(), values_.end(), std::string());
    if (empty != values_.end())
        focus_ = static_cast<std::size_t>(empty - values_.begin());
}

bool ObserverForm::take(const ResponsePress& press) {
    using Key = ResponsePress::Key;
    switch (press.key) {
    case Key::character:
        type(press.character);
        return false;
    case Key::erase:
        erase();
        return false;
    case Key::left:
        choose(-1);
        return false;
    case Key::right:
        choose(1);
        return false;
    case Key::up:
        message_.clear();
        focus_ = (focus_ + fields_.size() - 1) % fields_.size();
        return false;
    case Key::down:
        message_.clear();
        focus_ = (focus_ + 1) % fields_.size();
        return false;
    case Key::next:
        if (focus_ + 1 == fields_.size())
            return submit();
        values_[focus_] = trimmed(values_[focus_]);
        if (!says_fault_of(focus_))
            ++focus_;
        return false;
    default:
        return false;
    }
}

void ObserverForm::type(char32_t character) {
    message_.clear();
    if (!is_text(character))
        return;
    std::string& value = values_[focus_];
    if (!field().has_choices()) {
        if (value.size() < longest_value)
            append_utf8(value, character);
        return;
    }
    if (character == U' ') {
        choose(1);
        return;
    }
    // The next choice that begins so, round from the one that stands there.
    std::string typed;
    append_utf8(typed, character < 0x80 ? static_cast<char32_t>(std::tolower(static_cast<int>(character)))
                                        : character);
    const auto& choices = field().choices;
    const auto now = std::find(choices.begin(), choices.end(), value);
    const std::size_t first = now == choices.end() ? 0 : static_cast<std::size_t>(now - choices.begin()) + 1;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        const std::string& choice = choices[(first + i) % choices.size()];
        std::string begin = choice.substr(0, typed.size());
        if (begin.size() == 1)
            begin[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(begin[0])));
        if (begin == typed) {
            value = choice;
            return;
        }
    }
}

void ObserverForm::erase() {
    message_.clear();
    std::string& value = values_[focus_];
    if (field().has_choices()) {
        value.clear();
        return;
    }
    // The last character with all its bytes.
    while (!value.empty() && (static_cast<unsigned char>(value.back()) & 0xC0) == 0x80)
        value.pop_back();
    if (!value.empty())
        value.pop_back();
}

void ObserverForm::choose(int step) {
    message_.clear();
    if (!field().has_choices())
        return;
    const auto& choices = field().choices;
    const int count = static_cast<int>(choices.size());
    const auto now = std::find(choices.begin(), choices.end(), values_[focus_]);
    const int index = now == choices.end() ? (step > 0 ? -1 : 0) : static_cast<int>(now - choices.begin());
    values_[focus_] = choices[static_cast<std::size_t>((index + step + count) % count)];
}

bool ObserverForm::says_fault_of(std::size_t index) {
    message_.clear();
    const ObserverFieldSettings& field = fields_[index];
    if (!fault_of(field, values_[index]))
        return false;
    const std::string range = range_of(field);
    message_ = values_[index].empty() ? fmt::format("{}: {}", field.title, words_.missing)
                                      : fmt::format("{}: \"{}\": {}", field.title, as_it_is(values_[index]),
                                                    words_.not_possible);
    if (!range.empty())
        message_ += "  " + range;
    return true;
}

bool ObserverForm::submit() {
    for (std::string& value : values_)
        value = trimmed(value);
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        if (says_fault_of(i)) {
            focus_ = i;
            return false;
        }
    }
    return true;
}

Screen ObserverForm::screen() const {
    Screen screen{.kind = Screen::Kind::form, .text = {}};
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        const ObserverFieldSettings& field = fields_[i];
        screen.rows.push_back(
            {.label = field.required ? field.title : fmt::format("{} ({})", field.title, words_.optional),
             .value = values_[i],
             .choices = field.has_choices() ? field.choices : std::vector<std::string>(),
             .ends = field.ends,
             .is_here = i == focus_,
             .is_at_fault =
                 !values_[i].empty() && i != focus_ && fault_of(field, trimmed(values_[i])).has_value()});
    }
    screen.rows[focus_].is_at_fault = !message_.empty();
    screen.text = fmt::format("# {}\n{}", words_.form_title, message_.empty() ? field().note : message_);
    if (field().has_choices())
        screen.keys.push_back({"← →", words_.choose});
    const bool is_last = focus_ + 1 == fields_.size();
    if (fields_.size() > 1)
        screen.keys.push_back({"↑ ↓", words_.other_fields});
    screen.keys.push_back({words_.enter_key, is_last ? words_.done : words_.next});
    screen.page = static_cast<int>(focus_) + 1;
    screen.pages = static_cast<int>(fields_.size());
    return screen;
}

} // namespace overt
