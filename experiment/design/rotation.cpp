#include "experiment/design/rotation.h"

#include <numeric>

#include <fmt/format.h>

#include "experiment/design/block_plan.h"
#include "experiment/design/latin_square.h"

namespace overt {

namespace {

/// Rows of the square of the rotated list that all blocks of a group have in common.
int rotated_rows(const Protocol& protocol, const std::vector<BlockScopeOf>& blocks) {
    int rows = 1;
    for (const auto& [block, scope] : blocks) {
        for (const int task : scope.tasks)
            if (rotates(protocol, block, task) && rotated_entries(protocol, scope) > 1)
                rows = std::lcm(rows, rows_of_square(protocol.schedule.material_rotation,
                                                     rotated_entries(protocol, scope)));
    }
    return rows;
}

} // namespace

Rotations::Rotations(const Protocol& protocol, int group, RotationRule rule) : rule_(rule) {
    using Kind = RotatedFactor::Kind;
    const std::vector<BlockScopeOf> blocks = blocks_of_group(protocol, group);
    const auto add = [&](Kind kind, int block, int rows) {
        if (rows > 1)
            factors_.push_back({kind, block, rows});
    };
    add(Kind::entries, -1, rotated_rows(protocol, blocks));
    if (const LevelOrder by = protocol.schedule.block_order; by >= LevelOrder::cyclic && blocks.size() > 1)
        add(Kind::blocks, -1, rows_of_square(square_of(by), static_cast<int>(blocks.size())));
    for (const auto& [block, scope] : blocks) {
        const BlockSettings& settings = block_at(protocol, block);
        if (settings.order != OrderMethod::blocked || settings.levels < LevelOrder::cyclic)
            continue;
        const Factors factors = factors_of(protocol);
        if (const auto levels = levels_in(factors, scope, factors.at(settings.by)).size(); levels > 1)
            add(Kind::levels, block, rows_of_square(square_of(settings.levels), static_cast<int>(levels)));
    }
}

int Rotations::period() const {
    int period = 1;
    for (const RotatedFactor& factor : factors_)
        period *= factor.rows;
    return period;
}

int Rotations::row_of(RotatedFactor::Kind kind, int block, int row) const {
    int before = 1; // observers after which the factors so far repeat
    for (const RotatedFactor& factor : factors_) {
        const int together = before * factor.rows;
        if (factor.kind == kind && factor.block == block) {
            const int shift =
                rule_ == RotationRule::together ? 0 : row % together / std::lcm(before, factor.rows);
            // Within its square: a random one is another for each round of observers.
            return row / factor.rows * factor.rows + (row + shift) % factor.rows;
        }
        before = together;
    }
    return row;
}

std::string describe(const RotatedFactor& factor, const Protocol& protocol) {
    switch (factor.kind) {
    case RotatedFactor::Kind::entries:
        return std::string(stimulus_lists.at(rotated_list(protocol)).plural);
    case RotatedFactor::Kind::blocks:
        return "order of blocks";
    case RotatedFactor::Kind::levels:
        break;
    }
    const BlockSettings& block = block_at(protocol, factor.block);
    return block.id.empty() ? std::string("order of levels")
                            : fmt::format("levels of block \"{}\"", block.id);
}

} // namespace overt
