/// Lists of entries that blocks draw: what an observer learns in one, and is shown among others in the next.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "experiment/design/block_plan.h"

namespace overt {

/// What a block has drawn of a list of the protocol.
struct DrawnList {
    std::size_t list = 0;     ///< row of stimulus_lists
    std::vector<int> entries; ///< in the block's order
    std::vector<int> old;     ///< those that the block before had drawn, where the draw is `from` one
    bool tells_old_from_new = false;

    bool is_old(int entry) const;
};

/// Nothing where the block draws none. `scopes`: the blocks that the observer has, with all that they could
/// show. The protocol must be sound.
std::optional<DrawnList> drawn_list(const Protocol& protocol, const std::vector<BlockScopeOf>& scopes,
                                    int block, int observer_number, std::uint64_t seed);

/// Gives trials the level of "seen" that their first stimulus has, and as their correct answer where they
/// have none. Does nothing where the list tells no old from new.
void mark_old_and_new(const DrawnList& drawn, std::vector<Trial>& trials);

/// Row of stimulus_lists of this name; nothing where there is none.
std::optional<std::size_t> list_called(std::string_view name);

/// Index of the block with this id; -1 where there is none.
int block_called(const Protocol& protocol, std::string_view id);

} // namespace overt
