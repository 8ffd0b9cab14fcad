/// Effects that a planned study is to find, as they are written on the command line.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "experiment/protocol/protocol.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// What is tested between two levels of a factor.
enum class PowerMeasure : std::uint8_t {
    area, ///< share of fixations on an area, by flips of the signs of observers' differences
    wss,  ///< the spread of fixations, by the same
    cc,   ///< the maps of all observers, by swaps of the levels within observers
};

/// One planted difference between two levels, and its test.
struct PowerEffect {
    PowerMeasure measure = PowerMeasure::area;
    std::string area;             ///< of an area's share
    std::string column;           ///< a factor: "material", "task", "roughness" …
    std::string level, against;   ///< ids of the protocol
    std::vector<StudyKey> within; ///< only in trials of these; empty: all
    /// area: odds of the area in `level` as a multiple of those in `against`. wss: WSS as a multiple. cc:
    /// share of the fixations that goes to one spot in `level`.
    double size = 1.0;
    /// Standard deviation over observers: of the logarithm of odds or ratio, or of the share.
    double sd = 0.0;

    /// Nothing is planted, on average.
    bool is_none() const { return size == (measure == PowerMeasure::cc ? 0.0 : 1.0); }
    /// As --effect takes it, whole.
    std::string text() const;
    /// "share of fixations on the head, material rough against smooth, task free".
    std::string words() const;
};

/// Reads "head:material=rough:odds=1.5", "area=rim:material=rough:odds=1.5", "wss:material=rough:ratio=1.2",
/// "cc:material=rough:share=0.2"; each may go on with ":against=LEVEL" (else the first other level of the
/// protocol), ":sd=0.3", and
/// ":task=ID", ":object=ID" or ":material=ID" for trials of these only. "none" is every measure between
/// the first two materials, and the area that is usual (usual_area) of those that simulated observers look at
/// between the first two tasks, without an effect. `areas`: those that the objects have. Throws InputError,
/// which names what is known, and for an area of which the protocol's tasks do not say how often it is looked
/// at.
std::vector<PowerEffect> power_effects(const std::vector<std::string>& texts, const Protocol& protocol,
                                       std::span<const std::string> areas);

/// Reads "12", "6:24", "6:24:3" or "6,12,18": numbers of observers, rising, each once. Throws InputError.
std::vector<int> observer_counts(const std::string& text);

} // namespace overt
