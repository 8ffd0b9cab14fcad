/// Known answers that procedures and fits are held against: traces and estimates that other programs and
/// independent calculations agree on (assets/README.md says on which), beside those of this one.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace overt {

/// One number. Where a whole column of a table is compared it is the one farthest off.
struct KnownAnswer {
    std::string what;
    double known = 0.0, ours = 0.0;
    double tolerance = 0.0; ///< of the known number: half a unit of its last digit, or as its source has it

    bool holds() const { return std::abs(ours - known) <= tolerance; }
};
using KnownAnswers = std::vector<KnownAnswer>;

// A file each.
KnownAnswers known_staircases();
KnownAnswers known_quest();
KnownAnswers known_quest_plus();
KnownAnswers known_psychometric_fits();
KnownAnswers known_scales(); ///< differences, pairs
KnownAnswers known_detection();
KnownAnswers known_matches(); ///< and reliefs of gauge figures

/// All of them.
KnownAnswers known_answers();

} // namespace overt
