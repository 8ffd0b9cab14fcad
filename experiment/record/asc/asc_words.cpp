#include "experiment/record/asc/asc_words.h"

namespace overt {

std::optional<std::int64_t> asc_time_us(std::string_view text) {
    constexpr std::int64_t latest_ms = 900'000'000'000; // 28 years
    std::int64_t ms = 0;
    const char* const last = text.data() + text.size();
    auto [end, error] = std::from_chars(text.data(), last, ms);
    if (error != std::errc() || ms < 0 || ms > latest_ms || text.front() == '-')
        return std::nullopt;
    if (end == last)
        return 1000 * ms;
    if (*end != '.' && *end != ',')
        return std::nullopt;
    std::int64_t fraction_us = 0, weight = 100;
    for (const char* digit = end + 1; digit != last; ++digit, weight /= 10) {
        if (!is_digit(*digit))
            return std::nullopt;
        fraction_us += weight * (*digit - '0');
    }
    return 1000 * ms + fraction_us;
}

} // namespace overt
