/// Orders in which the pixels of a tile are raised by one level: what dithering compares with.
#pragma once

#include <cstdint>
#include <vector>

#include "experiment/protocol/protocol.h"

namespace overt {

inline constexpr int dither_tile_px = 64;
inline constexpr int dither_ranks = dither_tile_px * dither_tile_px;

/// Each rank 0 … 4095 once, row by row. Because every tile-sized window of the repeated tile holds every rank
/// once, a plain surface is raised in exactly the share of pixels that it asks for, to 1 / 4096.
///
/// ordered: Bayer's recursive pattern (B. E. Bayer, IEEE ICC 1973). blue_noise: void and cluster on the torus
/// (R. Ulichney, Proc. SPIE 1913, 1993), begun from a fixed seed: the same tile on every machine. Takes about
/// 0.1 s.
std::vector<std::uint32_t> make_dither_tile(Dithering dithering);

} // namespace overt
