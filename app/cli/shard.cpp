#include "app/cli/shard.h"

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/text_number.h"

namespace overt {

std::optional<int> digits_in(std::string_view text) {
    const auto number = number_in<int>(text);
    return number && text.size() <= 6 && *number >= 0 ? number : std::nullopt;
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
