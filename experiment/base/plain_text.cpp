#include "experiment/base/plain_text.h"

#include <array>
#include <utility>

namespace overt {

namespace {

constexpr std::array<std::string_view, 10> emphasis_marks{"<b>",  "</b>",  "<i>",    "</i>",    "<u>",
                                                          "</u>", "<big>", "</big>", "<small>", "</small>"};
constexpr std::array<std::pair<std::string_view, char>, 3> named_letters{
    {{"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}}};

/// How many bytes of the rest are a mark, and what stands for it.
struct Mark {
    std::size_t length = 0;
    std::string_view instead;
};

Mark mark_at_begin(std::string_view rest) {
    for (const std::string_view mark : emphasis_marks)
        if (rest.starts_with(mark))
            return {mark.size(), {}};
    for (const auto& [name, letter] : named_letters)
        if (rest.starts_with(name))
            return {name.size(), {&letter, 1}};
    return {};
}

} // namespace

std::string plain_text_of(std::string_view marked) {
    if (marked.starts_with("# "))
        marked.remove_prefix(2);
    std::string plain;
    while (!marked.empty()) {
        const Mark mark = mark_at_begin(marked);
        if (mark.length > 0)
            plain += mark.instead;
        else
            plain += marked.front();
        marked.remove_prefix(mark.length > 0 ? mark.length : 1);
    }
    return plain;
}

std::string plain_line_of(std::string_view marked) {
    std::string line;
    bool is_apart = false;
    for (const char letter : plain_text_of(marked)) {
        if (static_cast<unsigned char>(letter) <= 0x20) {
            is_apart = !line.empty();
            continue;
        }
        if (is_apart)
            line += ' ';
        is_apart = false;
        line += letter;
    }
    return line;
}

} // namespace overt
