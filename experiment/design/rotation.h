/// What goes round over the observers by Latin squares, and which row of its square each observer takes of
/// each.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiment/protocol/protocol.h"

namespace overt {

/// One thing that goes by the rows of a square.
struct RotatedFactor {
    enum class Kind : std::uint8_t {
        entries, ///< of the rotated list, in tasks that are asked once per object
        blocks,  ///< their order
        levels,  ///< their order in a block
    };
    Kind kind = Kind::entries;
    int block = -1; ///< of levels
    int rows = 1;   ///< after which every level has stood everywhere equally often; at least 2
    bool operator==(const RotatedFactor&) const = default;
};

/// How several factors go round together.
enum class RotationRule : std::uint8_t {
    /// All combinations of rows come equally often, over as many observers as the product of the factors'
    /// rows.
    crossed,
    /// All factors take the same row: the rule of version 0.1, in which factors of two rows could not be told
    /// apart. For orders that were recorded by it.
    together
};

/// The factors that go round in a group (-1: without groups) and the rows of each.
class Rotations {
  public:
    Rotations(const Protocol& protocol, int group, RotationRule rule = RotationRule::crossed);

    /// In a fixed order: the rotated list, blocks, then the levels of blocks as listed.
    const std::vector<RotatedFactor>& factors() const { return factors_; }

    /// Observers after which every combination of rows has come equally often; 1 without factors.
    int period() const;

    /// The row that a factor takes for the observer who is `row`-th of the group, from 0. Of what does not go
    /// round: `row` itself.
    ///
    /// The first factor takes `row`. Each other one does too, but for a shift by one row whenever it and the
    /// factors before it would begin to repeat: after the least common multiple of their rows. So each factor
    /// alone is complete as early as it can be, and all together when period() is.
    int row_of(RotatedFactor::Kind kind, int block, int row) const;

  private:
    std::vector<RotatedFactor> factors_;
    RotationRule rule_;
};

/// "materials" or another list, "order of blocks", "levels of block "questions"".
std::string describe(const RotatedFactor& factor, const Protocol& protocol);

} // namespace overt
