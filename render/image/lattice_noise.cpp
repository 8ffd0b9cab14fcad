#include "render/image/lattice_noise.h"

#include <array>

namespace overt {

namespace {

/// A direction for each corner of the lattice, in the cube -1 … 1.
glm::dvec3 lattice_gradient(glm::ivec3 corner, std::uint64_t seed) {
    std::uint64_t hash = seed;
    for (int axis = 0; axis < 3; ++axis)
        hash = mixed_bits(hash ^ static_cast<std::uint32_t>(corner[axis]));
    const auto part = [&](int shift) {
        return static_cast<double>((hash >> shift) & 0x1fffffu) / 0x100000 - 1.0;
    };
    return {part(0), part(21), part(42)};
}

} // namespace

std::uint64_t mixed_bits(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15ull;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}

double lattice_noise(glm::dvec3 place, std::uint64_t seed) {
    const glm::dvec3 cell = glm::floor(place), f = place - cell;
    const glm::dvec3 s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    std::array<double, 8> corners{};
    for (int i = 0; i < 8; ++i) {
        const glm::ivec3 step(i & 1, (i >> 1) & 1, i >> 2);
        corners[static_cast<std::size_t>(i)] =
            glm::dot(lattice_gradient(glm::ivec3(cell) + step, seed), f - glm::dvec3(step));
    }
    const auto between = [&](std::size_t i, double share) {
        return glm::mix(corners[i], corners[i + 1], share);
    };
    return glm::mix(glm::mix(between(0, s.x), between(2, s.x), s.y),
                    glm::mix(between(4, s.x), between(6, s.x), s.y), s.z);
}

} // namespace overt
