#include "devices/link/text_line.h"

#include <charconv>
#include <cmath>

namespace overt {

std::optional<double> decimal_number(std::string_view text) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, value, std::chars_format::fixed);
    if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(value))
        return std::nullopt;
    return value;
}

} // namespace overt
