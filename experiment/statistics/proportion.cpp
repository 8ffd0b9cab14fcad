#include "experiment/statistics/proportion.h"

#include <algorithm>
#include <cmath>

#include "experiment/statistics/distributions.h"

namespace overt {

std::optional<Interval> wilson_interval(double hits, double events, double confidence) {
    if (!(events > 0.0))
        return std::nullopt;
    const double z = normal_quantile(0.5 + 0.5 * confidence), share = hits / events;
    const double spread = 1.0 + z * z / events;
    const double centre = (share + z * z / (2.0 * events)) / spread;
    const double half =
        z / spread * std::sqrt(share * (1.0 - share) / events + z * z / (4.0 * events * events));
    return Interval{std::max(centre - half, 0.0), std::min(centre + half, 1.0)};
}

} // namespace overt
