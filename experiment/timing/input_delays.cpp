#include "experiment/timing/input_delays.h"

#include <algorithm>

namespace overt {

std::optional<InputDelays> summary_of(std::vector<double> delays_s) {
    if (delays_s.empty())
        return std::nullopt;
    std::ranges::sort(delays_s);
    const std::size_t count = delays_s.size(), half = count / 2;
    const auto most = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(count) - 1e-9));
    return InputDelays{static_cast<int>(count),
                       count % 2 == 1 ? delays_s[half] : 0.5 * (delays_s[half - 1] + delays_s[half]),
                       delays_s[std::max<std::size_t>(most, 1) - 1], delays_s.back()};
}

} // namespace overt
