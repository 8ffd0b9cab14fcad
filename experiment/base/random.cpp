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

std::array<std::uint32_t, 4> philox_4x32_10(std::array<std::uint32_t, 4> counter,
                                            std::array<std::uint32_t, 2> key) {
    constexpr std::uint64_t multiplier_0 = 0xD2511F53u, multiplier_1 = 0xCD9E8D57u;
    constexpr std::uint32_t weyl_0 = 0x9E3779B9u, weyl_1 = 0xBB67AE85u;
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t product_0 = multiplier_0 * counter[0];
        const std::uint64_t product_1 = multiplier_1 * counter[2];
        counter = {static_cast<std::uint32_t>(product_1 >> 32) ^ counter[1] ^ key[0],
                   static_cast<std::uint32_t>(product_1),
                   static_cast<std::uint32_t>(product_0 >> 32) ^ counter[3] ^ key[1],
                   static_cast<std::uint32_t>(product_0)};
        key[0] += weyl_0;
        key[1] += weyl_1;
    }
    return counter;
}

RandomStream::RandomStream(std::uint64_t seed, std::string_view purpose, std::uint64_t index) {
    key_ = {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
    // The purpose takes the counter's upper half and the index is mixed into it; the lower half counts
    // blocks.
    std::uint64_t stream = hash_of(purpose) ^ (index * 0x9E3779B97F4A7C15ull);
    stream ^= stream >> 31;
    counter_ = {0, 0, static_cast<std::uint32_t>(stream), static_cast<std::uint32_t>(stream >> 32)};
}

std::uint32_t RandomStream::next_bits() {
    if (used_ == block_.size()) {
        block_ = philox_4x32_10(counter_, key_);
        if (++counter_[0] == 0)
            ++counter_[1];
        used_ = 0;
    }
    return block_[used_++];
}

double RandomStream::uniform() {
    const std::uint64_t high = next_bits() >> 5, low = next_bits() >> 6;
    return static_cast<double>((high << 26) | low) * 0x1p-53;
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
