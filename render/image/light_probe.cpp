#include "render/image/light_probe.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/base/random.h"
#include "render/image/gallery_probe.h"

namespace overt {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

glm::vec3 direction_of(int column, int row, glm::ivec2 size_px) {
    const float azimuth =
        2.0f * pi * ((static_cast<float>(column) + 0.5f) / static_cast<float>(size_px.x) - 0.5f);
    const float from_zenith = pi * (static_cast<float>(row) + 0.5f) / static_cast<float>(size_px.y);
    return {std::sin(from_zenith) * std::sin(azimuth), std::sin(from_zenith) * std::cos(azimuth),
            std::cos(from_zenith)};
}

template <class Radiance> LightProbe probe_of(glm::ivec2 size_px, const Radiance& radiance) {
    LightProbe probe{LinearImage(size_px), 0};
    parallel_for(size_px.y, [&](int row) {
        for (int column = 0; column < size_px.x; ++column) {
            probe.radiance.at(column, row) = glm::vec4(radiance(direction_of(column, row, size_px)), 1.0f);
        }
    });
    return probe;
}

/// One house along the horizon.
struct House {
    float azimuth_from, azimuth_to, height; ///< radians
    float shade;
};

std::vector<House> row_of_houses() {
    RandomStream random(2019, "houses on the horizon");
    std::vector<House> houses;
    float azimuth = -pi;
    while (azimuth < pi) {
        const auto width = static_cast<float>(random.uniform(0.12, 0.42));
        const bool gap = random.uniform() < 0.18;
        const float height = gap ? 0.02f : static_cast<float>(random.uniform(0.12, 0.42));
        houses.push_back({azimuth, azimuth + width, height, static_cast<float>(random.uniform(0.05, 0.22))});
        azimuth += width;
    }
    return houses;
}

/// Brighter and darker stretches of cloud, mean about 1: a few waves of unequal direction and length.
float cloud_cover(glm::vec3 direction) {
    // Clouds lie in a flat layer above: near the horizon they are foreshortened.
    const glm::vec2 place = glm::vec2(direction.x, direction.y) / (direction.z + 0.25f);
    const float broad =
        std::sin(1.9f * place.x + 0.7f * place.y + 1.0f) * std::sin(1.3f * place.y - 0.8f * place.x + 2.0f);
    const float fine =
        std::sin(4.3f * place.y + 2.9f * place.x) * std::sin(3.7f * place.x - 1.9f * place.y + 0.5f);
    return 1.0f + 0.35f * broad + 0.15f * fine;
}

/// Paving slabs of unequal shade, seen from 1.2 m above; darker near the foot, where the stand is in the way.
float pavement(glm::vec3 direction) {
    const glm::vec2 place = 1.2f * glm::vec2(direction.x, direction.y) / std::max(-direction.z, 0.02f);
    const glm::vec2 slab = glm::floor(place / 0.8f);
    const float shade = std::sin(12.9f * slab.x + 78.2f * slab.y) * 0.5f + 0.5f;
    const glm::vec2 within = glm::abs(place / 0.8f - slab - 0.5f);
    const float joint = std::max(within.x, within.y) > 0.47f ? 0.55f : 1.0f;
    const float far = glm::length(place), open_sky = far / (far + 0.6f);
    // Too fine to be seen far away: there only the mean is left.
    return glm::mix(joint * (0.6f + 0.8f * shade), 0.97f, glm::clamp(far / 12.0f, 0.0f, 1.0f)) *
           (0.25f + 0.9f * open_sky);
}

/// Two low-discrepancy numbers in [0, 1): Martin Roberts' R2 sequence (2018).
glm::vec2 r2_point(int i) {
    const double x = 0.5 + 0.7548776662466927 * i, y = 0.5 + 0.5698402909980532 * i;
    return {static_cast<float>(x - std::floor(x)), static_cast<float>(y - std::floor(y))};
}

struct Frame {
    glm::vec3 tangent, bitangent;
    explicit Frame(glm::vec3 normal) {
        const glm::vec3 side = std::abs(normal.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
        tangent = glm::normalize(glm::cross(side, normal));
        bitangent = glm::cross(normal, tangent);
    }
};

} // namespace

glm::vec3 LightProbe::towards(glm::vec3 direction) const {
    const glm::ivec2 size = radiance.size_px;
    const float u =
        (std::atan2(direction.x, direction.y) / (2.0f * pi) + 0.5f) * static_cast<float>(size.x) - 0.5f;
    const float v = std::acos(glm::clamp(direction.z, -1.0f, 1.0f)) / pi * static_cast<float>(size.y) - 0.5f;
    const float column = std::floor(u), row = std::floor(v);
    const auto texel = [&](int x, int y) {
        return glm::vec3(radiance.at((x + size.x) % size.x, glm::clamp(y, 0, size.y - 1)));
    };
    const int x = static_cast<int>(column), y = static_cast<int>(row);
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), u - column),
                    glm::mix(texel(x, y + 1), texel(x + 1, y + 1), u - column), v - row);
}

LightProbe overcast_city_probe() {
    const std::vector<House> houses = row_of_houses();
    // Horizontal illuminance of the sky is 7 pi / 9 Lz; what the ground sends back is that times albedo / pi.
    const float ground = 0.2f * 7.0f / 9.0f;
    return probe_of({1024, 512}, [&](glm::vec3 direction) {
        const float elevation = std::asin(glm::clamp(direction.z, -1.0f, 1.0f));
        if (elevation < 0.0f)
            return ground * pavement(direction) * glm::vec3(1.0f, 0.97f, 0.92f);
        const float azimuth = std::atan2(direction.x, direction.y);
        for (const House& house : houses) {
            if (azimuth < house.azimuth_from || azimuth >= house.azimuth_to || elevation > house.height)
                continue;
            const float across = (azimuth - house.azimuth_from) / 0.035f, up = elevation / 0.05f;
            const bool window =
                across - std::floor(across) > 0.45f && up - std::floor(up) > 0.5f && house.height > 0.1f;
            return glm::vec3(window ? 2.2f * house.shade + 0.12f : house.shade) *
                   glm::vec3(1.0f, 0.96f, 0.9f);
        }
        return cloud_cover(direction) * (1.0f + 2.0f * direction.z) / 3.0f * glm::vec3(0.97f, 1.0f, 1.04f);
    });
}

LightProbe load_light_probe(const LightSettings& light) {
    LightProbe probe;
    if (light.probe == "overcast") {
        probe = overcast_city_probe();
    } else if (light.probe == "gallery") {
        probe = gallery_probe();
    } else if (light.probe == "dark") {
        probe.radiance = LinearImage({64, 32});
    } else {
        probe.radiance = read_linear_image(light.probe, FrameEncoding::linear, FileColours::as_rec709);
        const glm::ivec2 size = probe.radiance.size_px;
        if (size.x != 2 * size.y) {
            throw InputError(
                fmt::format("{}: a latitude-longitude probe is twice as wide as high, this is {} x {}",
                            light.probe, size.x, size.y));
        }
        for (glm::vec4& pixel : probe.radiance.pixels) {
            probe.negative_texels += glm::any(glm::lessThan(glm::vec3(pixel), glm::vec3(0.0f))) ? 1 : 0;
            pixel = glm::max(pixel, glm::vec4(0.0f));
        }
    }
    if (light.rotation_deg == 0.0)
        return probe;
    const float angle = static_cast<float>(to_radians({light.rotation_deg}).value);
    const float c = std::cos(angle), s = std::sin(angle);
    LightProbe turned = probe_of(probe.radiance.size_px, [&](glm::vec3 d) {
        return probe.towards({c * d.x + s * d.y, -s * d.x + c * d.y, d.z});
    });
    turned.negative_texels = probe.negative_texels;
    return turned;
}

LightProbe blurred_by_ggx(const LightProbe& probe, double alpha, glm::ivec2 size_px) {
    if (alpha <= 0.0)
        return probe;
    // A sample stands for the directions about it that no other sample stands for: it looks up a picture
    // whose texels are as large (Krivanek and Colbert 2008, "Real-time Shading with Filtered Importance
    // Sampling").
    std::array<LightProbe, 4> sources;
    for (std::size_t level = 0; level < sources.size(); ++level)
        sources[level] = reduced(probe, glm::ivec2(256, 128) / (1 << level));
    constexpr int samples = 192;
    constexpr float texel_sr = 2.0f * pi * pi / (256.0f * 128.0f);
    const auto alpha_squared = static_cast<float>(alpha * alpha);
    return probe_of(size_px, [&](glm::vec3 mirror) {
        const Frame frame(mirror);
        glm::vec3 sum(0.0f);
        float weights = 0.0f;
        for (int i = 0; i < samples; ++i) {
            const glm::vec2 point = r2_point(i);
            // Micro-normals by the GGX distribution: tan^2 = alpha^2 u / (1 - u) (Walter et al. 2007, eq.
            // 35).
            const float tan_squared = alpha_squared * point.x / (1.0f - point.x);
            const float cosine = 1.0f / std::sqrt(1.0f + tan_squared),
                        sine = std::sqrt(1.0f - cosine * cosine);
            const float turn = 2.0f * pi * point.y;
            const glm::vec3 micro = sine * std::cos(turn) * frame.tangent +
                                    sine * std::sin(turn) * frame.bitangent + cosine * mirror;
            const glm::vec3 light = 2.0f * glm::dot(mirror, micro) * micro - mirror;
            const float weight = glm::dot(light, mirror);
            if (weight <= 0.0f)
                continue;
            // Of the mirrored direction, head-on: a quarter of the micro-normals' density.
            const float spread = cosine * cosine * (alpha_squared + tan_squared);
            const float density = alpha_squared / (4.0f * pi * spread * spread);
            const float level =
                glm::clamp(0.5f * std::log2(1.0f / (static_cast<float>(samples) * density * texel_sr)) + 0.5f,
                           0.0f, static_cast<float>(sources.size() - 1));
            const auto finer = std::min(static_cast<std::size_t>(level), sources.size() - 2);
            sum += weight * glm::mix(sources[finer].towards(light), sources[finer + 1].towards(light),
                                     level - static_cast<float>(finer));
            weights += weight;
        }
        return sum / weights;
    });
}

LightProbe irradiance_over_pi(const LightProbe& probe, glm::ivec2 size_px) {
    // All of the light in directions that are few and near to one another beside a cosine: no direction is
    // drawn by lot, or the surface would show which.
    constexpr glm::ivec2 lamps_px(64, 32);
    struct Lamp {
        glm::dvec3 flux{0.0};
        double solid_angle = 0.0;
    };
    std::vector<Lamp> lamps(static_cast<std::size_t>(lamps_px.x * lamps_px.y));
    const glm::ivec2 source = probe.radiance.size_px;
    for (int y = 0; y < source.y; ++y) {
        const double band =
            std::cos(std::numbers::pi * y / source.y) - std::cos(std::numbers::pi * (y + 1) / source.y);
        const double solid_angle = band * 2.0 * std::numbers::pi / source.x;
        for (int x = 0; x < source.x; ++x) {
            const auto lamp =
                static_cast<std::size_t>(y * lamps_px.y / source.y * lamps_px.x + x * lamps_px.x / source.x);
            lamps[lamp].flux += solid_angle * glm::dvec3(probe.radiance.at(x, y));
            lamps[lamp].solid_angle += solid_angle;
        }
    }
    return probe_of(size_px, [&](glm::vec3 normal) {
        glm::dvec3 sum(0.0);
        double cosines = 0.0;
        for (int y = 0; y < lamps_px.y; ++y) {
            for (int x = 0; x < lamps_px.x; ++x) {
                const double cosine = static_cast<double>(glm::dot(normal, direction_of(x, y, lamps_px)));
                if (cosine <= 0.0)
                    continue;
                const Lamp& lamp = lamps[static_cast<std::size_t>(y * lamps_px.x + x)];
                sum += cosine * lamp.flux;
                cosines += cosine * lamp.solid_angle;
            }
        }
        // The cosines over a hemisphere sum to pi.
        return glm::vec3(sum / cosines);
    });
}

LightProbe reduced(const LightProbe& probe, glm::ivec2 size_px) {
    const glm::ivec2 source = probe.radiance.size_px;
    if (source.x % size_px.x != 0 || source.y % size_px.y != 0)
        return probe;
    const glm::ivec2 factor = source / size_px;
    LightProbe result{LinearImage(size_px), 0};
    for (int y = 0; y < source.y; ++y) {
        for (int x = 0; x < source.x; ++x)
            result.radiance.at(x / factor.x, y / factor.y) += probe.radiance.at(x, y);
    }
    for (glm::vec4& pixel : result.radiance.pixels)
        pixel /= static_cast<float>(factor.x * factor.y);
    return result;
}

} // namespace overt
