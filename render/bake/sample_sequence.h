/// Where the samples of a pixel go: numbers that depend on seed, pixel and sample alone, never on who draws
/// them when.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace overt {

/// Sobol' points in four dimensions, each pixel's scrambled in its own way (Owen 1995; by hashing, after
/// Burley 2020, "Practical hash-based Owen scrambling"): the first 2^k samples of a pixel are spread evenly,
/// in all four dimensions at once and in each pair. Further dimensions come in fours of their own, in
/// shuffled order.
class SampleSequence {
  public:
    /// `sample`: 0, 1, 2 …
    SampleSequence(std::uint64_t seed, glm::ivec2 pixel, std::uint32_t sample);

    /// The next dimension, in [0, 1).
    float next();
    /// The next two, which belong to one set of four.
    glm::vec2 next_two();

  private:
    void begin_set();

    std::uint32_t pixel_hash_;
    std::uint32_t sample_;
    std::uint32_t dimension_ = 0; ///< that comes next
    std::uint32_t index_ = 0;     ///< of the sample in the current set of four
    std::uint32_t set_hash_ = 0;
};

} // namespace overt
