#include "experiment/record/asc/asc_sample_words.h"

#include "experiment/record/asc/asc_words.h"

namespace overt {
namespace {

/// Before a status there are a place and a pupil at least.
constexpr int least_values = 3;

/// Gives true when the line's status is found: what comes after it, of the target on the head, is not kept.
bool take_word(AscSampleWords& words, std::string_view word) {
    if (words.count >= least_values && is_status(word)) {
        words.status = word;
        return true;
    }
    if (words.count < static_cast<int>(words.values.size()))
        words.values[static_cast<std::size_t>(words.count)] = word;
    else if (words.count == static_cast<int>(words.values.size()))
        words.further = word;
    ++words.count;
    return false;
}

} // namespace

AscSampleWords split_at_blanks(std::string_view line) {
    AscSampleWords words;
    Words rest(line);
    words.time = rest.next();
    for (std::string_view word = rest.next(); !word.empty(); word = rest.next())
        if (take_word(words, word))
            break;
    return words;
}

AscSampleWords split_at_tabs(std::string_view line) {
    AscSampleWords words;
    Columns columns(line);
    words.time = columns.next();
    while (!columns.are_over())
        if (take_word(words, columns.next()))
            break;
    return words;
}

} // namespace overt
