/// Random numbers by counter: the n-th number of a stream is a pure function of (seed, purpose, n). Each
/// purpose has a stream of its own, so that drawing more numbers for one part of a design never reshuffles
/// another.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

namespace overt {

/// The block function Philox-4x32-10 of Salmon, Moraes, Dror and Shaw, "Parallel random numbers: as easy as
/// 1, 2, 3", SC 2011, with the constants printed there.
inline std::array<std::uint32_t, 4> philox_4x32_10(std::array<std::uint32_t, 4> counter,
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

/// One stream. Copies go on independently from the same place. Same numbers on every machine; not for
/// cryptography.
class RandomStream {
  public:
    /// `seed` is the session's recorded seed; `purpose` names what is drawn ("trial order", "gaze noise");
    /// `index` tells streams of one purpose apart (an observer's number, a trial's).
    RandomStream(std::uint64_t seed, std::string_view purpose, std::uint64_t index = 0);

    std::uint32_t next_bits() {
        if (used_ == block_.size()) {
            block_ = philox_4x32_10(counter_, key_);
            if (++counter_[0] == 0)
                ++counter_[1];
            used_ = 0;
        }
        return block_[used_++];
    }

    /// Uniform in [0, 1), a multiple of 2^-53.
    double uniform() {
        const std::uint64_t high = next_bits() >> 5, low = next_bits() >> 6;
        return static_cast<double>((high << 26) | low) * 0x1p-53;
    }

    /// Uniform in [low, high).
    double uniform(double low, double high) { return low + (high - low) * uniform(); }

    /// Uniform in 0 … count-1 without modulo bias (Lemire, ACM TOMACS 29(1), 2019). count > 0.
    std::uint32_t below(std::uint32_t count);

    /// Normal with mean 0 and standard deviation 1 (Box and Muller 1958).
    double normal();

    /// Exponential with the given mean.
    double exponential(double mean);

    /// Fisher and Yates: every order equally probable.
    template <class T> void shuffle(std::span<T> items) {
        for (std::size_t i = items.size(); i > 1; --i) {
            std::swap(items[i - 1], items[below(static_cast<std::uint32_t>(i))]);
        }
    }

  private:
    std::array<std::uint32_t, 2> key_{};
    std::array<std::uint32_t, 4> counter_{};
    std::array<std::uint32_t, 4> block_{};
    unsigned used_ = 4;
};

} // namespace overt
