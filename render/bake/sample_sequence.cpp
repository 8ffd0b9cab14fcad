#include "render/bake/sample_sequence.h"

#include <array>

namespace overt {

namespace {

/// Mixes bits well: the finaliser of MurmurHash3 (Austin Appleby).
std::uint32_t mixed(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x85ebca6bu;
    x ^= x >> 13;
    x *= 0xc2b2ae35u;
    return x ^ (x >> 16);
}

std::uint32_t mixed(std::uint32_t x, std::uint32_t y) { return mixed(x ^ mixed(y + 0x9e3779b9u)); }

std::uint32_t reversed_bits(std::uint32_t x) {
    x = __builtin_bswap32(x);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    return ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
}

/// A bit is flipped or not by a hash of the bits above it: Owen's nested scrambling, with the bits upside
/// down a permutation in which each bit depends on lower ones only (Laine and Karras 2011, with the constants
/// of Burley 2020).
std::uint32_t owen_scrambled(std::uint32_t x, std::uint32_t seed) {
    x = reversed_bits(x);
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return reversed_bits(x);
}

constexpr std::uint32_t set_size = 4;

/// Direction numbers of the first dimensions, by the recurrence of Bratley and Fox (1988) from the primitive
/// polynomials and first numbers of Joe and Kuo (2008): degree, inner coefficients, first numbers.
struct Polynomial {
    int degree;
    std::uint32_t inner;
    std::array<std::uint32_t, 3> first;
};
constexpr std::array<Polynomial, set_size - 1> polynomials{
    {{1, 0, {1, 0, 0}}, {2, 1, {1, 3, 0}}, {3, 1, {1, 3, 1}}}};

using Directions = std::array<std::array<std::uint32_t, 32>, set_size>;

constexpr Directions make_directions() {
    Directions directions{};
    for (int bit = 0; bit < 32; ++bit)
        directions[0][static_cast<std::size_t>(bit)] = 1u << (31 - bit);
    for (std::size_t dimension = 1; dimension < set_size; ++dimension) {
        const Polynomial polynomial = polynomials[dimension - 1];
        auto& numbers = directions[dimension];
        const auto degree = static_cast<std::size_t>(polynomial.degree);
        for (std::size_t bit = 0; bit < 32; ++bit) {
            if (bit < degree) {
                numbers[bit] = polynomial.first[bit] << (31 - bit);
                continue;
            }
            numbers[bit] = numbers[bit - degree] ^ (numbers[bit - degree] >> degree);
            for (std::size_t k = 1; k < degree; ++k) {
                if ((polynomial.inner >> (degree - 1 - k)) & 1u)
                    numbers[bit] ^= numbers[bit - k];
            }
        }
    }
    return directions;
}

constexpr Directions directions = make_directions();

std::uint32_t sobol(std::uint32_t index, std::uint32_t dimension) {
    std::uint32_t value = 0;
    for (std::size_t bit = 0; index != 0; index >>= 1, ++bit) {
        if ((index & 1u) != 0)
            value ^= directions[dimension][bit];
    }
    return value;
}

} // namespace

SampleSequence::SampleSequence(std::uint64_t seed, glm::ivec2 pixel, std::uint32_t sample)
    : pixel_hash_(mixed(mixed(static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)),
                        mixed(static_cast<std::uint32_t>(pixel.x), static_cast<std::uint32_t>(pixel.y)))),
      sample_(sample) {}

void SampleSequence::begin_set() {
    const std::uint32_t set = dimension_ / set_size;
    set_hash_ = mixed(pixel_hash_, set);
    // The first set keeps the order, so that the first half of the samples is spread evenly by itself.
    // The others are shuffled block by block: the first 2^k samples are 2^k successive points all the same.
    index_ = set == 0 ? sample_ : owen_scrambled(sample_, set_hash_) & 0xffffu;
}

float SampleSequence::next() {
    const std::uint32_t within = dimension_ % set_size;
    if (within == 0)
        begin_set();
    ++dimension_;
    const std::uint32_t value = owen_scrambled(sobol(index_, within), mixed(set_hash_, within));
    return static_cast<float>(value >> 8) * 0x1p-24f;
}

glm::vec2 SampleSequence::next_two() {
    if (dimension_ % set_size == set_size - 1)
        ++dimension_;
    const float first = next();
    return {first, next()};
}

} // namespace overt
