/// Which group an observer belongs to.
#pragma once

#include "experiment/protocol/protocol.h"

namespace overt {

/// An observer among those who see the same.
struct GroupPlace {
    int group = -1; ///< index into the protocol's groups; -1: it has none
    int row = 0;    ///< how many of the group come before: what squares and rotations go by
};

/// By number alone, from 1: round after round each group that is not full takes one observer, in the order of
/// the file. Throws InputError where all groups are full before this number.
GroupPlace group_place(const Protocol& protocol, int observer_number);

/// Observers that the groups take in all; nothing: any number.
std::optional<int> group_capacity(const Protocol& protocol);

} // namespace overt
