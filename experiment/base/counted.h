/// Numbers of things in sentences.
#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

namespace overt {

/// "1 task", "2 tasks"; `several` where the plural is no mere s.
template <class Count> std::string counted(Count count, std::string_view one, std::string_view several = {}) {
    if (count == 1)
        return fmt::format("1 {}", one);
    return several.empty() ? fmt::format("{} {}s", count, one) : fmt::format("{} {}", count, several);
}

} // namespace overt
