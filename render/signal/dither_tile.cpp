#include "render/signal/dither_tile.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "experiment/base/error.h"
#include "experiment/base/random.h"

namespace overt {

namespace {

constexpr int side = dither_tile_px;
constexpr std::size_t cells = dither_ranks;

std::size_t cell_at(int x, int y) {
    return static_cast<std::size_t>((y & (side - 1)) * side + (x & (side - 1)));
}

std::vector<std::uint32_t> ordered_tile() {
    std::vector<std::uint32_t> ranks(cells);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            // Each bit of the place says in which quarter the cell lies; the largest quarters weigh least.
            std::uint32_t rank = 0;
            for (int bit = 1; bit < side; bit *= 2)
                rank = 4 * rank + ((x ^ y) & bit ? 2u : 0u) + (y & bit ? 1u : 0u);
            ranks[cell_at(x, y)] = rank;
        }
    }
    return ranks;
}

/// Which cells are set, and how crowded each cell's neighbourhood is by them.
class Pattern {
  public:
    Pattern() : set_(cells, false), crowd_(cells, 0.0) {
        constexpr double sigma = 1.5; // Ulichney's choice
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const int dx = std::min(x, side - x), dy = std::min(y, side - y);
                weight_[cell_at(x, y)] = std::exp(-(dx * dx + dy * dy) / (2.0 * sigma * sigma));
            }
        }
    }

    bool is_set(std::size_t cell) const { return set_[cell]; }

    void put(std::size_t cell, bool on) {
        set_[cell] = on;
        const int cx = static_cast<int>(cell) % side, cy = static_cast<int>(cell) / side;
        const double sign = on ? 1.0 : -1.0;
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x)
                crowd_[cell_at(x, y)] += sign * weight_[cell_at(x - cx, y - cy)];
        }
    }

    std::size_t tightest_cluster() const { return extreme(true, 1.0); }
    std::size_t largest_void() const { return extreme(false, -1.0); }

  private:
    std::size_t extreme(bool among_set, double sign) const {
        std::size_t best = cells;
        double highest = 0.0;
        for (std::size_t cell = 0; cell < cells; ++cell) {
            if (set_[cell] == among_set && (best == cells || sign * crowd_[cell] > highest)) {
                best = cell;
                highest = sign * crowd_[cell];
            }
        }
        return best;
    }

    std::vector<bool> set_;
    std::vector<double> crowd_;
    std::array<double, cells> weight_{};
};

std::vector<std::uint32_t> blue_noise_tile() {
    Pattern begun;
    RandomStream random(1, "blue noise");
    constexpr std::size_t begun_with = cells / 10;
    for (std::size_t placed = 0; placed < begun_with;) {
        const std::size_t cell = random.below(dither_ranks);
        if (!begun.is_set(cell)) {
            begun.put(cell, true);
            ++placed;
        }
    }
    // Move the most crowded point to the largest hole until it would move back.
    for (;;) {
        const std::size_t crowded = begun.tightest_cluster();
        begun.put(crowded, false);
        const std::size_t hole = begun.largest_void();
        begun.put(hole, true);
        if (hole == crowded)
            break;
    }
    std::vector<std::uint32_t> ranks(cells);
    Pattern down = begun;
    for (std::size_t rank = begun_with; rank-- > 0;) {
        const std::size_t cell = down.tightest_cluster();
        down.put(cell, false);
        ranks[cell] = static_cast<std::uint32_t>(rank);
    }
    for (std::size_t rank = begun_with; rank < cells; ++rank) {
        const std::size_t cell = begun.largest_void();
        begun.put(cell, true);
        ranks[cell] = static_cast<std::uint32_t>(rank);
    }
    return ranks;
}

} // namespace

std::vector<std::uint32_t> make_dither_tile(Dithering dithering) {
    OVERT_EXPECTS(dithering != Dithering::none);
    return dithering == Dithering::ordered ? ordered_tile() : blue_noise_tile();
}

} // namespace overt
