#include "render/bake/light_sources.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/bake/microfacets.h"

namespace overt {

namespace {

constexpr float pi_of_lamp = std::numbers::pi_v<float>;
constexpr float endless = std::numeric_limits<float>::infinity();

/// 1 - cos a of a small angle by its sine squared, without cancellation.
float cap_height(float sine_squared) {
    return sine_squared / (1.0f + std::sqrt(std::max(0.0f, 1.0f - sine_squared)));
}

float cone_density(float height) { return 1.0f / (2.0f * pi_of_lamp * height); }

/// Evenly in a cone about `axis` whose cosines go down to 1 - height.
glm::vec3 direction_in_cone(glm::vec3 axis, float height, glm::vec2 place) {
    const float down = height * place.x; // 1 - cosine
    const float sine = std::sqrt(std::max(0.0f, down * (2.0f - down))), around = 2.0f * pi_of_lamp * place.y;
    return NormalFrame(axis).to_world({sine * std::cos(around), sine * std::sin(around), 1.0f - down});
}

float sine_squared_of_sphere(glm::vec3 to_middle, float radius) {
    return radius * radius / glm::dot(to_middle, to_middle);
}

float sun_cap(float radius_rad) {
    const float sine = std::sin(radius_rad);
    return cap_height(sine * sine);
}

glm::dvec3 colour_of_luminance_1(const std::array<double, 3>& colour) {
    const glm::dvec3 rgb(colour[0], colour[1], colour[2]);
    return rgb / glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722));
}

LightSource sun_of(const LightSettings& light, double unit) {
    const double azimuth = to_radians({light.sun_azimuth_deg}).value,
                 elevation = to_radians({light.sun_elevation_deg}).value,
                 radius = to_radians({light.sun_radius_deg}).value;
    LightSource sun;
    // What faces it gets pi sin^2(radius) times its luminance.
    const double luminance = *light.sun_lux / (std::numbers::pi * std::sin(radius) * std::sin(radius)) / unit;
    sun.light = glm::vec3(luminance * colour_of_luminance_1(light.sun_colour));
    sun.place = glm::vec3(glm::dvec3(std::sin(azimuth) * std::cos(elevation),
                                     -std::cos(azimuth) * std::cos(elevation), std::sin(elevation)));
    sun.radius = static_cast<float>(radius);
    return sun;
}

LightSource source_of(const LampSettings& lamp, double unit) {
    LightSource source;
    const glm::dvec3 place = lamp.position.value_or(glm::dvec3(0.0));
    source.light = glm::vec3(*lamp.cd_m2 / unit * colour_of_luminance_1(lamp.colour));
    source.place = glm::vec3(place);
    source.radius = static_cast<float>(lamp.radius);
    source.half_width = static_cast<float>(0.5 * lamp.width);
    source.half_height = static_cast<float>(0.5 * lamp.height);
    source.shape = lamp.shape == LampShape::sphere ? LightSource::Shape::sphere
                   : lamp.shape == LampShape::disc ? LightSource::Shape::disc
                                                   : LightSource::Shape::rectangle;
    const glm::dvec3 way = lamp.faces.value_or(glm::dvec3(0.0)) - place;
    const glm::dvec3 facing = glm::length(way) > 0.0 ? glm::normalize(way) : glm::dvec3(0.0, 0.0, -1.0);
    source.facing = glm::vec3(facing);
    // The width is level, as that of a picture on a wall; of one that lies, along x.
    const glm::dvec3 level = glm::cross(glm::dvec3(0.0, 0.0, 1.0), facing);
    source.across = glm::vec3(glm::length(level) > 1e-9 ? glm::normalize(level) : glm::dvec3(1.0, 0.0, 0.0));
    return source;
}

} // namespace

LightSource::Aim LightSource::aim(glm::vec3 from, glm::vec2 at) const {
    Aim aim;
    if (shape == Shape::sun) {
        const float height = sun_cap(radius);
        return {direction_in_cone(place, height, at), endless, cone_density(height)};
    }
    const glm::vec3 to_middle = place - from;
    if (shape == Shape::sphere) {
        const float sine_squared = sine_squared_of_sphere(to_middle, radius);
        if (sine_squared >= 1.0f)
            return aim;
        const float height = cap_height(sine_squared);
        aim.direction = direction_in_cone(glm::normalize(to_middle), height, at);
        aim.distance = met_at(from, aim.direction);
        if (aim.distance < 0.0f) // at the very edge, by rounding: as far as the edge is
            aim.distance = std::sqrt(std::max(0.0f, glm::dot(to_middle, to_middle) - radius * radius));
        aim.density = cone_density(height);
        return aim;
    }
    const glm::vec3 up = glm::cross(facing, across);
    glm::vec3 to_it = to_middle;
    if (shape == Shape::disc) {
        const float out = radius * std::sqrt(at.x), around = 2.0f * pi_of_lamp * at.y;
        to_it += out * (std::cos(around) * across + std::sin(around) * up);
    } else {
        to_it += half_width * (2.0f * at.x - 1.0f) * across + half_height * (2.0f * at.y - 1.0f) * up;
    }
    aim.distance = glm::length(to_it);
    if (!(aim.distance > 0.0f))
        return aim;
    aim.direction = to_it / aim.distance;
    aim.density = density(from, aim.direction, aim.distance);
    return aim;
}

float LightSource::density(glm::vec3 from, glm::vec3 direction, float distance) const {
    if (shape == Shape::sun)
        return cone_density(sun_cap(radius));
    if (shape == Shape::sphere) {
        const float sine_squared = sine_squared_of_sphere(place - from, radius);
        return sine_squared < 1.0f ? cone_density(cap_height(sine_squared)) : 0.0f;
    }
    const float cosine = -glm::dot(direction, facing);
    const float area = shape == Shape::disc ? pi_of_lamp * radius * radius : 4.0f * half_width * half_height;
    return cosine > 0.0f ? distance * distance / (area * cosine) : 0.0f;
}

float LightSource::met_at(glm::vec3 from, glm::vec3 direction) const {
    constexpr float nowhere = -1.0f;
    if (shape == Shape::sun) {
        const glm::vec3 aside = glm::cross(place, direction); // its length is the sine of the angle between
        const float sine = std::sin(radius);
        return glm::dot(place, direction) > 0.0f && glm::dot(aside, aside) <= sine * sine ? endless : nowhere;
    }
    const glm::vec3 to_middle = place - from;
    if (shape == Shape::sphere) {
        const float along = glm::dot(to_middle, direction);
        const glm::vec3 aside = to_middle - along * direction;
        const float in_squared = radius * radius - glm::dot(aside, aside);
        if (in_squared < 0.0f || along <= 0.0f || glm::dot(to_middle, to_middle) <= radius * radius)
            return nowhere;
        return along - std::sqrt(in_squared);
    }
    const float cosine = -glm::dot(direction, facing);
    if (!(cosine > 0.0f))
        return nowhere;
    const float distance = -glm::dot(to_middle, facing) / cosine;
    if (!(distance > 0.0f))
        return nowhere;
    const glm::vec3 off = distance * direction - to_middle;
    const float x = glm::dot(off, across), y = glm::dot(off, glm::cross(facing, across));
    const bool is_on = shape == Shape::disc ? x * x + y * y <= radius * radius
                                            : std::abs(x) <= half_width && std::abs(y) <= half_height;
    return is_on ? distance : nowhere;
}

std::vector<LightSource> light_sources(const LightSettings& light) {
    std::vector<LightSource> sources;
    const double unit = light.unit_cd_m2.value_or(1.0);
    if (light.sun_lux)
        sources.push_back(sun_of(light, unit));
    for (const LampSettings& lamp : light.shining)
        sources.push_back(source_of(lamp, unit));
    return sources;
}

std::vector<LightSource> moved(std::span<const LightSource> sources, const glm::dmat3& rotation,
                               glm::dvec3 shift) {
    std::vector<LightSource> moved(sources.begin(), sources.end());
    for (LightSource& source : moved) {
        const bool is_far = source.shape == LightSource::Shape::sun;
        source.place = glm::vec3(rotation * glm::dvec3(source.place) + (is_far ? glm::dvec3(0.0) : shift));
        source.across = glm::vec3(rotation * glm::dvec3(source.across));
        source.facing = glm::vec3(rotation * glm::dvec3(source.facing));
    }
    return moved;
}

namespace {

/// Adds a source to a probe, with all of its light: evenly over the parts of texels that it is seen in, and
/// over the texel of its middle if it is smaller than any.
void add_source(LinearImage& radiance, const LightSource& source) {
    const glm::ivec2 size = radiance.size_px;
    constexpr int side = 4;
    const float across = 2.0f * pi_of_lamp / static_cast<float>(size.x * side);
    const auto height = [&](int row) { // of an edge between rows of parts
        return std::cos(pi_of_lamp * static_cast<float>(row) / static_cast<float>(size.y * side));
    };
    std::vector<float> seen(radiance.pixels.size(), 0.0f); // solid angle of it in each texel
    double all = 0.0;
    for (int row = 0; row < size.y * side; ++row) {
        const float band = height(row) - height(row + 1);
        const float v = pi_of_lamp * (static_cast<float>(row) + 0.5f) / static_cast<float>(size.y * side);
        for (int column = 0; column < size.x * side; ++column) {
            const float u = (static_cast<float>(column) + 0.5f) * across - pi_of_lamp;
            const glm::vec3 direction(std::sin(u) * std::sin(v), std::cos(u) * std::sin(v), std::cos(v));
            if (source.met_at(glm::vec3(0.0f), direction) <= 0.0f)
                continue;
            seen[static_cast<std::size_t>(row / side * size.x + column / side)] += band * across;
            all += static_cast<double>(band * across);
        }
    }
    const LightSource::Aim middle = source.aim(glm::vec3(0.0f), glm::vec2(0.5f, 0.0f));
    if (!(middle.density > 0.0f))
        return;
    // How large it is: of the sun and a sphere exactly; of what is flat and fine by its middle.
    const bool is_round =
        source.shape == LightSource::Shape::sun || source.shape == LightSource::Shape::sphere;
    const double whole = is_round || all == 0.0 ? 1.0 / static_cast<double>(middle.density) : all;
    if (all == 0.0) {
        const float u = std::atan2(middle.direction.x, middle.direction.y) / (2.0f * pi_of_lamp) + 0.5f;
        const float v = std::acos(std::clamp(middle.direction.z, -1.0f, 1.0f)) / pi_of_lamp;
        const int column = std::min(static_cast<int>(u * static_cast<float>(size.x)), size.x - 1);
        const int row = std::min(static_cast<int>(v * static_cast<float>(size.y)), size.y - 1);
        seen[static_cast<std::size_t>(row * size.x + column)] = 1.0f;
        all = 1.0;
    }
    for (int row = 0; row < size.y; ++row) {
        const float texel = (height(row * side) - height((row + 1) * side)) * across * side;
        for (int column = 0; column < size.x; ++column) {
            const float share = seen[static_cast<std::size_t>(row * size.x + column)];
            if (share > 0.0f)
                radiance.at(column, row) +=
                    glm::vec4(static_cast<float>(whole / all) * share / texel * source.light, 0.0f);
        }
    }
}

} // namespace

LightProbe distant_probe(const LightSettings& light) {
    if (light.sum.empty()) {
        LightProbe probe = load_light_probe(light);
        const double turn = to_radians({light.rotation_deg}).value;
        const glm::dmat3 turned(std::cos(turn), std::sin(turn), 0.0, -std::sin(turn), std::cos(turn), 0.0,
                                0.0, 0.0, 1.0);
        for (const LightSource& source : moved(light_sources(light), turned, glm::dvec3(0.0)))
            add_source(probe.radiance, source);
        return probe;
    }
    std::vector<LightProbe> parts;
    glm::ivec2 size(0);
    for (const LightSettings& part : light.parts) {
        parts.push_back(distant_probe(part));
        if (parts.back().radiance.size_px.x > size.x)
            size = parts.back().radiance.size_px;
    }
    LightProbe sum{LinearImage(size), 0};
    for (int row = 0; row < size.y; ++row) {
        const float v = pi_of_lamp * (static_cast<float>(row) + 0.5f) / static_cast<float>(size.y);
        for (int column = 0; column < size.x; ++column) {
            const float u =
                2.0f * pi_of_lamp * ((static_cast<float>(column) + 0.5f) / static_cast<float>(size.x) - 0.5f);
            const glm::vec3 direction(std::sin(u) * std::sin(v), std::cos(u) * std::sin(v), std::cos(v));
            glm::vec3 radiance(0.0f);
            for (std::size_t i = 0; i < parts.size(); ++i)
                radiance += static_cast<float>(light.sum[i].second) * parts[i].towards(direction);
            sum.radiance.at(column, row) = glm::vec4(radiance, 1.0f);
        }
    }
    return sum;
}

} // namespace overt
