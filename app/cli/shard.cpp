#include "app/cli/shard.h"

#include <charconv>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

std::optional<int> digits_in(std::string_view text) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || text.size() > 6 || number < 0)
        return std::nullopt;
    return number;
}

Shard shard_called(const std::string& text) {
    const std::size_t slash = text.find('/');
    if (slash != std::string::npos) {
        const auto number = digits_in(std::string_view(text).substr(0, slash)),
                   count = digits_in(std::string_view(text).substr(slash + 1));
        if (number && count && *number >= 1 && *number <= *count && *count <= 100000)
            return {*number, *count};
    }
    throw InputError(
        fmt::format("--shard {}: write the number of this machine and how many there are, 1/4 to "
                    "4/4 for four of them",
                    text));
}

} // namespace overt
