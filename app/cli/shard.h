/// One of several machines that share work.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace overt {

/// Counted from 1.
struct Shard {
    int number = 1;
    int count = 1;
};

/// "3/16". Throws InputError for anything else than 1/n … n/n, n up to 100,000.
Shard shard_called(const std::string& text);

/// The whole text as a number of at most six digits; nothing if it is something else.
std::optional<int> digits_in(std::string_view text);

} // namespace overt
