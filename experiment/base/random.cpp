#include "experiment/base/random.h"

#include <cmath>
#include <numbers>

#include "experiment/base/error.h"

namespace overt {

namespace {

/// FNV-1a, 64 bits: gives each purpose its own region of the counter space.
std::uint64_t hash_of(std::string_view text) {
    std::uint64_t hash = 14695981039346656037ull;
    for (const char character : text) {
        hash ^= static_cast<unsigned char>(character);
        hash *= 1099511628211ull;
    }
    return hash;
}

} // namespace

RandomStream::RandomStream(std::uint64_t seed, std::string_view purpose, std::uint64_t index) {
    key_ = {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
    // The purpose takes the counter's upper half and the index is mixed into it; the lower half counts
    // blocks.
    std::uint64_t stream = hash_of(purpose) ^ (index * 0x9E3779B97F4A7C15ull);
    stream ^= stream >> 31;
    counter_ = {0, 0, static_cast<std::uint32_t>(stream), static_cast<std::uint32_t>(stream >> 32)};
}

std::uint32_t RandomStream::below(std::uint32_t count) {
    OVERT_EXPECTS(count > 0);
    std::uint64_t product = std::uint64_t{next_bits()} * count;
    if (static_cast<std::uint32_t>(product) < count) {
        const std::uint32_t threshold = (0u - count) % count;
        while (static_cast<std::uint32_t>(product) < threshold)
            product = std::uint64_t{next_bits()} * count;
    }
    return static_cast<std::uint32_t>(product >> 32);
}

double RandomStream::normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

double RandomStream::exponential(double mean) { return -mean * std::log(1.0 - uniform()); }

} // namespace overt
