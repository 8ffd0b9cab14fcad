#include "render/image/gallery_probe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "experiment/base/parallel.h"
#include "render/image/lattice_noise.h"

namespace overt {

namespace {

using Colour = glm::dvec3;
using Place = glm::dvec3;

// The object's middle is the origin; +y is away from the camera, +x to its right, lengths in metres.
constexpr Place room_low(-5.0, -6.0, -1.5), room_high(7.0, 5.0, 3.5);
constexpr std::uint64_t texture_seed = 2004;

constexpr Colour sky_blue(0.72, 0.94, 1.30), sun_colour(1.25, 0.97, 0.62), lamp_colour(1.30, 0.95, 0.55);
constexpr Colour plaster(0.60, 0.57, 0.51), wood(0.20, 0.115, 0.06), ceiling(0.62, 0.61, 0.58);

/// A window in the wall at low x (`along` is y), or at low y (`along` is x).
struct Window {
    bool is_left;
    double middle, half_width, low, high;
    double area() const { return 2.0 * half_width * (high - low); }
    Place centre() const {
        const double z = 0.5 * (low + high);
        return is_left ? Place(room_low.x, middle, z) : Place(middle, room_low.y, z);
    }
    glm::dvec3 inward() const { return is_left ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0); }
};
constexpr std::array<Window, 4> windows{{{true, -4.0, 0.75, -0.6, 2.9},
                                         {true, -1.1, 0.75, -0.6, 2.9},
                                         {true, 1.8, 0.75, -0.6, 2.9},
                                         {false, 2.6, 0.9, -0.2, 2.7}}};

/// A round lamp: on the ceiling, or standing.
struct Lamp {
    Place middle;
    double radius, radiance;
};
constexpr std::array<Lamp, 6> lamps{{{{1.8, -3.4, 3.3}, 0.16, 55.0},
                                     {{3.6, -1.2, 3.3}, 0.13, 85.0},
                                     {{3.4, 1.6, 3.3}, 0.15, 40.0},
                                     {{-1.0, 2.2, 3.3}, 0.12, 65.0},
                                     {{-0.8, -2.0, 3.3}, 0.09, 110.0},
                                     {{5.6, -4.4, 0.35}, 0.30, 11.0}}};

/// The sun stands in a pane of the first window.
glm::dvec3 sun_direction() { return glm::normalize(Place(-5.0, -4.38, 1.85)); }
constexpr double sun_radiance = 400.0, sun_radius = 0.024;

/// 0 on a bar of the window's frame, else 1; less than 0: not in the window.
double glass_at(const Window& window, double along, double z) {
    const double across = (along - window.middle) / window.half_width;
    if (std::abs(across) > 1.0 || z < window.low || z > window.high)
        return -1.0;
    const double bar_across = std::min(std::abs(across), 1.0 - std::abs(across)) * window.half_width;
    const double up = (z - window.low) / 0.7, to_bar = std::abs(up - std::round(up)) * 0.7;
    return bar_across < 0.035 || to_bar < 0.025 ? 0.0 : 1.0;
}

/// What is seen through a window: sky, brighter towards the sun, over a dark line of trees and a lawn.
Colour outdoors(glm::dvec3 direction) {
    const double elevation = std::asin(std::clamp(direction.z, -1.0, 1.0));
    const double trees = 0.07 + 0.05 * lattice_noise(9.0 * direction, texture_seed + 1) +
                         0.03 * lattice_noise(31.0 * direction, texture_seed + 2);
    if (elevation < trees)
        return elevation < -0.02 ? Colour(0.30, 0.36, 0.16) : Colour(0.10, 0.13, 0.07);
    const double to_sun = std::acos(std::clamp(glm::dot(direction, sun_direction()), -1.0, 1.0));
    const double cloud = 1.0 + 0.5 * lattice_noise(3.0 * direction / (direction.z + 0.2), texture_seed + 3);
    const double glow = 14.0 * std::exp(-to_sun / 0.07) + 4.0 * std::exp(-to_sun / 0.3);
    // The disc has a soft edge, as air and glass make it.
    const double disc = sun_radiance / (1.0 + std::exp((to_sun - sun_radius) / 0.0025));
    return 3.6 * cloud * sky_blue + (glow + disc) * sun_colour;
}

/// Light that falls on a place of the room, divided by pi: from the sky in the windows, the lamps, the sun,
/// and what the room itself sends back.
Colour lit(Place place, glm::dvec3 normal) {
    Colour sum(0.10, 0.093, 0.08);
    for (const Window& window : windows) {
        const glm::dvec3 to_window = window.centre() - place;
        const double squared = glm::dot(to_window, to_window), distance = std::sqrt(squared);
        const double falls = std::max(0.0, glm::dot(normal, to_window) / distance);
        const double leaves = std::max(0.0, -glm::dot(window.inward(), to_window) / distance);
        sum += 3.6 * sky_blue * falls * leaves * window.area() /
               (std::numbers::pi * (squared + 0.5 * window.area()));
        // The sun's patch of this window.
        const glm::dvec3 sun = sun_direction();
        const double way = window.is_left ? (room_low.x - place.x) / sun.x : (room_low.y - place.y) / sun.y;
        const Place entry = place + way * sun;
        if (way > 0.0 && glm::dot(normal, sun) > 0.0 &&
            glass_at(window, window.is_left ? entry.y : entry.x, entry.z) > 0.0)
            sum += 4.0 * glm::dot(normal, sun) * sun_colour;
    }
    for (const Lamp& lamp : lamps) {
        const glm::dvec3 to_lamp = lamp.middle - place;
        const double squared = glm::dot(to_lamp, to_lamp);
        sum += lamp.radiance * lamp.radius * lamp.radius *
               std::max(0.0, glm::dot(normal, to_lamp) / std::sqrt(squared)) / (squared + 0.1) * lamp_colour;
    }
    return sum;
}

/// A picture on a wall: a gilt frame and, within, dark paint.
Colour picture_on(double across, double up, double half_width, double half_height, Colour wall,
                  std::uint64_t seed) {
    if (std::abs(across) > half_width || std::abs(up) > half_height)
        return wall;
    if (std::abs(across) > half_width - 0.09 || std::abs(up) > half_height - 0.09)
        return {0.45, 0.31, 0.11};
    const double paint = lattice_noise({3.0 * across, 3.0 * up, 0.5}, seed);
    return glm::mix(Colour(0.05, 0.045, 0.04), Colour(0.26, 0.15, 0.09), std::clamp(0.5 + paint, 0.0, 1.0));
}

/// What a wall sends back of the light on it; `along` it from left to right.
Colour wall_albedo(double along, double z, std::uint64_t seed) {
    if (z < -0.5) // a wainscot of panels
        return std::abs(z + 0.53) < 0.03 || std::abs(along / 0.9 - std::round(along / 0.9)) < 0.05
                   ? 0.5 * wood
                   : wood;
    Colour wall = plaster;
    for (int i = -2; i <= 2; ++i) {
        const double middle = 2.3 * i + 0.4 * lattice_noise({i + 0.5, 0.5, 0.5}, seed);
        wall = picture_on(along - middle, z - 0.75, 0.5 + 0.12 * (i & 1), 0.65 - 0.15 * (i & 1), wall,
                          seed + static_cast<std::uint64_t>(i + 2));
    }
    return wall;
}

Colour room_light(glm::dvec3 direction) {
    for (const Lamp& lamp : lamps) {
        const double distance = glm::length(lamp.middle);
        const double across = glm::length(direction - lamp.middle / distance) * distance / lamp.radius;
        if (across < 1.0)
            return lamp.radiance * (1.0 - 0.5 * across * across) * lamp_colour;
    }
    // Where the sight line leaves the room.
    double way = 1e9;
    int axis = 0;
    for (int i = 0; i < 3; ++i) {
        const double to_wall = (direction[i] > 0.0 ? room_high[i] : room_low[i]) / direction[i];
        if (direction[i] != 0.0 && to_wall < way) {
            way = to_wall;
            axis = i;
        }
    }
    const Place place = way * direction;
    glm::dvec3 normal(0.0);
    normal[axis] = direction[axis] > 0.0 ? -1.0 : 1.0;
    if (axis == 2) {
        const bool is_floor = direction.z < 0.0;
        const double board = std::floor(place.x / 0.28);
        const double shade =
            0.75 + 0.5 * lattice_noise({board + 0.5, 0.5, std::floor(place.y / 1.9 + 0.37 * board) + 0.5},
                                       texture_seed + 5);
        return lit(place, normal) * (is_floor ? shade * wood : ceiling);
    }
    const double along = axis == 0 ? place.y : place.x;
    for (const Window& window : windows) {
        if (direction[axis] > 0.0 || window.is_left != (axis == 0))
            continue;
        const double glass = glass_at(window, along, place.z);
        if (glass > 0.0)
            return outdoors(direction);
        if (glass == 0.0)
            return {0.05, 0.048, 0.045}; // against the light
    }
    // A door stands open to a dark room.
    if (axis == 1 && direction.y > 0.0 && std::abs(along - 3.6) < 0.75 && place.z < 1.1)
        return Colour(0.012, 0.011, 0.010);
    const auto wall = static_cast<std::uint64_t>(2 * axis + (direction[axis] > 0.0 ? 1 : 0));
    return lit(place, normal) * wall_albedo(along, place.z, texture_seed + 16 * (wall + 1));
}

/// Texture whose contrast is the same in each of seven octaves, so that the power of its harmonics falls with
/// the square of their degree.
double texture(glm::dvec3 direction) {
    double sum = 0.0, frequency = 2.0;
    for (std::uint64_t octave = 0; octave < 7; ++octave, frequency *= 2.0)
        sum += lattice_noise(frequency * direction + 0.37 * static_cast<double>(octave),
                             texture_seed + 64 + octave);
    return std::exp(0.55 * sum);
}

glm::dvec3 direction_of_place(double across, double down) {
    const double azimuth = 2.0 * std::numbers::pi * (across - 0.5), from_zenith = std::numbers::pi * down;
    return {std::sin(from_zenith) * std::sin(azimuth), std::sin(from_zenith) * std::cos(azimuth),
            std::cos(from_zenith)};
}

LightProbe make_gallery() {
    constexpr glm::ivec2 size(1024, 512);
    constexpr int per_side = 2; // places in a texel, so that edges are smooth
    LightProbe probe{LinearImage(size), 0};
    std::vector<double> row_light(static_cast<std::size_t>(size.y));
    parallel_for(size.y, [&](int row) {
        for (int column = 0; column < size.x; ++column) {
            const auto direction_at = [&](double right, double below) {
                return direction_of_place((column + right) / size.x, (row + below) / size.y);
            };
            Colour sum(0.0);
            for (int down = 0; down < per_side; ++down)
                for (int right = 0; right < per_side; ++right)
                    sum += room_light(direction_at((right + 0.5) / per_side, (down + 0.5) / per_side));
            sum *= texture(direction_at(0.5, 0.5)) / (per_side * per_side);
            probe.radiance.at(column, row) = glm::vec4(glm::vec3(sum), 1.0f);
            row_light[static_cast<std::size_t>(row)] += 0.2126 * sum.r + 0.7152 * sum.g + 0.0722 * sum.b;
        }
    });
    // Rows count by the solid angle that they have.
    double light = 0.0, angle = 0.0;
    for (int row = 0; row < size.y; ++row) {
        const double sine = std::sin(std::numbers::pi * (row + 0.5) / size.y);
        light += sine * row_light[static_cast<std::size_t>(row)] / size.x;
        angle += sine;
    }
    const auto factor = static_cast<float>(gallery_mean_luminance * angle / light);
    for (glm::vec4& pixel : probe.radiance.pixels)
        pixel = glm::vec4(factor * glm::vec3(pixel), 1.0f);
    return probe;
}

} // namespace

const LightProbe& gallery_probe() {
    static const LightProbe probe = make_gallery();
    return probe;
}

} // namespace overt
