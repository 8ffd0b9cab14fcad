#include "render/image/text_markup.h"

#include <array>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

constexpr std::array<std::string_view, 5> marks{"b", "i", "u", "big", "small"};
constexpr std::array<std::string_view, 3> named_characters{"&lt;", "&gt;", "&amp;"};

/// "<b>" or "</b>" at the beginning of `rest`, or nothing.
std::string_view mark_at(std::string_view rest, std::string_view& name) {
    const std::string_view inside = rest.substr(rest.starts_with("</") ? 2 : 1);
    for (const std::string_view mark : marks) {
        if (inside.starts_with(mark) && inside.substr(mark.size()).starts_with('>')) {
            name = mark;
            return rest.substr(0, rest.size() - inside.size() + mark.size() + 1);
        }
    }
    return {};
}

} // namespace

std::string pango_markup_of(std::string_view text) {
    std::string markup;
    std::vector<std::string_view> open;
    for (std::size_t i = 0; i < text.size();) {
        const std::string_view rest = text.substr(i);
        std::string_view taken = rest.substr(0, 1), name;
        if (taken == "<") {
            const std::string_view mark = mark_at(rest, name);
            if (mark.empty()) {
                markup += "&lt;";
            } else if (mark[1] != '/') {
                open.push_back(name);
                markup += taken = mark;
            } else if (!open.empty() && open.back() == name) {
                open.pop_back();
                markup += taken = mark;
            } else {
                throw InputError(fmt::format(
                    "{} closes what is not open: emphasis goes from <{}> to {}, one within the other; "
                    "for the characters themselves write &lt;/{}>",
                    mark, name, mark, name));
            }
        } else if (taken == "&") {
            for (const std::string_view character : named_characters)
                if (rest.starts_with(character))
                    taken = character;
            markup += taken == "&" ? "&amp;" : taken;
        } else {
            markup += taken == ">" ? "&gt;" : taken;
        }
        i += taken.size();
    }
    if (!open.empty())
        throw InputError(fmt::format("<{0}> is not closed: write </{0}> where its emphasis ends; for the "
                                     "characters themselves, &lt;{0}>",
                                     open.back()));
    return markup;
}

TitledText split_title(const std::string& text) {
    if (!text.starts_with("# "))
        return {{}, text};
    const std::size_t end = text.find('\n');
    if (end == std::string::npos)
        return {text.substr(2), {}};
    const std::size_t body = text.find_first_not_of('\n', end);
    return {text.substr(2, end - 2), body == std::string::npos ? std::string() : text.substr(body)};
}

} // namespace overt
