/// In which orders may these things come? The question by itself, without a protocol: items with levels,
/// stretches of the sequence that hold them, and limits on how equal levels may follow each other.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace overt {

/// A limit on the sequence of one factor's levels.
struct OrderLimit {
    enum class Kind : std::uint8_t {
        longest_run,   ///< at most so many in a row with the same level
        least_distance ///< the same level again after this many steps at the earliest; 2: never twice in a
                       ///< row
    };
    int factor = 0; ///< index into OrderProblem::levels
    Kind kind = Kind::longest_run;
    int amount = 1;
    int part = -1;    ///< holds for items placed in this part of the sequence; -1: in all
    std::string key;  ///< who asked for it, as "schedule.max_object_run"
    std::string noun; ///< what the factor is called, as "object"
    friend bool operator==(const OrderLimit&, const OrderLimit&) = default;
};

/// A stretch of the sequence that holds certain items in any order.
struct OrderSegment {
    std::vector<int>
        items;     ///< each comes once; of a segment with draws: what is drawn from, with replacement
    int draws = 0; ///< 0: none
    std::vector<double> weights; ///< of the items, in proportion; for draws

    int length() const { return draws > 0 ? draws : static_cast<int>(items.size()); }
    bool is_drawn() const { return draws > 0; }
    friend bool operator==(const OrderSegment&, const OrderSegment&) = default;
};

/// Segments that follow each other as listed, or in any order.
struct OrderPart {
    std::vector<OrderSegment> segments;
    bool in_any_order = false; ///< at most 60 segments then
    friend bool operator==(const OrderPart&, const OrderPart&) = default;
};

struct OrderProblem {
    std::vector<std::vector<int>> levels; ///< by factor and item, from 0
    std::vector<OrderPart> parts;
    std::vector<OrderLimit> limits;

    int length() const;
    friend bool operator==(const OrderProblem&, const OrderProblem&) = default;
};

/// A whole sequence of items, with the part that each stands in.
struct ItemSequence {
    std::vector<int> items;
    std::vector<int> parts;
};

/// Whether a sequence keeps to all limits.
bool keeps_to_limits(const OrderProblem& problem, const ItemSequence& sequence);

} // namespace overt
