/// Whether what goes round over the observers can be told apart: how often the rows of any two factors meet.
#pragma once

#include <string>
#include <vector>

#include "experiment/protocol/protocol.h"

namespace overt {

/// How often each row of one factor met each row of another, over the planned observers of a group.
struct CrossTable {
    std::string first, second;
    std::vector<std::vector<int>> observers; ///< by row of the first, then of the second
    bool is_even() const;
};

/// What goes round in one group, or in the whole experiment.
struct RotationFacts {
    std::string group; ///< id; empty without groups
    int observers = 0; ///< planned
    struct Factor {
        std::string name;
        int rows = 0;
    };
    std::vector<Factor> factors;
    int period = 1;                 ///< observers after which all combinations have come equally often
    std::vector<CrossTable> tables; ///< of every pair of factors
};

/// Of each group in which anything goes round.
std::vector<RotationFacts> rotation_facts(const Protocol& protocol);

/// A sentence for each pair of factors some of whose combinations come more often than others.
std::vector<std::string> rotation_warnings(const std::vector<RotationFacts>& facts);

} // namespace overt
