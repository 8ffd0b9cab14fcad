#include "render/image/probe_facts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

namespace overt {

std::optional<ProbeFacts> probe_facts(const LightProbe& probe) {
    const glm::ivec2 size = probe.radiance.size_px;
    struct Part {
        double luminance = 0.0, solid_angle = 0.0;
    };
    std::vector<Part> parts;
    parts.reserve(probe.radiance.pixels.size());
    double whole = 0.0, sphere = 0.0, squares = 0.0;
    for (int y = 0; y < size.y; ++y) {
        const double band =
            std::cos(std::numbers::pi * y / size.y) - std::cos(std::numbers::pi * (y + 1) / size.y);
        const double solid_angle = band * 2.0 * std::numbers::pi / size.x;
        for (int x = 0; x < size.x; ++x) {
            const glm::dvec3 light(probe.radiance.at(x, y));
            const double luminance = 0.2126 * light.r + 0.7152 * light.g + 0.0722 * light.b;
            parts.push_back({luminance, solid_angle});
            sphere += solid_angle;
            whole += luminance * solid_angle;
            squares += luminance * luminance * solid_angle;
        }
    }
    if (!(whole > 0.0))
        return std::nullopt;
    ProbeFacts facts;
    const double mean = whole / sphere;
    facts.unevenness = squares / sphere / (mean * mean);
    std::ranges::sort(parts, std::ranges::greater(), &Part::luminance);
    facts.brightest = parts.front().luminance / mean;
    double angle = 0.0, light = 0.0;
    for (const Part& part : parts) {
        if (part.luminance >= 0.999 * parts.front().luminance)
            facts.plateau_sr += part.solid_angle;
        const double left = std::min(part.solid_angle, std::max(0.0, 0.01 * sphere - angle));
        light += left * part.luminance;
        angle += part.solid_angle;
    }
    facts.top_share = light / whole;
    double lit = 0.0, sum = 0.0;
    for (const Part& part : parts)
        if (part.luminance > 0.0) {
            lit += part.solid_angle;
            sum += part.solid_angle * std::log(part.luminance);
        }
    const double middle = sum / lit;
    double second = 0.0, third = 0.0, fourth = 0.0;
    for (const Part& part : parts)
        if (part.luminance > 0.0) {
            const double off = std::log(part.luminance) - middle, share = part.solid_angle / lit;
            second += share * off * off;
            third += share * off * off * off;
            fourth += share * off * off * off * off;
        }
    facts.sd = std::sqrt(second);
    if (second > 1e-12) {
        facts.skew = third / std::pow(second, 1.5);
        facts.kurtosis = fourth / (second * second);
    }
    return facts;
}

std::string describe(const ProbeFacts& facts) {
    return fmt::format("brightest {:.3g} times the mean, unevenness {:.3g}, {:.0f} % of the light from the "
                       "brightest hundredth; logarithm: SD {:.2f}, skew {:.2f}, kurtosis {:.1f}",
                       facts.brightest, facts.unevenness, 100.0 * facts.top_share, facts.sd, facts.skew,
                       facts.kurtosis);
}

} // namespace overt
