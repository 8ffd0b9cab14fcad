/// How many orders keep to the limits, and one of them with equal probability for each: by counting, from
/// every place that can be reached, in how many ways it can be gone on from.
#pragma once

#include <cstddef>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "experiment/base/random.h"
#include "experiment/design/orders/order_state.h"
#include "experiment/design/orders/scaled_number.h"

namespace overt {

/// The sequence of kinds of a whole order, with where each stands.
struct KindSequence {
    struct Place {
        int part = 0;
        int segment = 0;
        int kind = 0;
    };
    std::vector<Place> places;
};

class OrderCounter {
  public:
    /// Counting is given up beyond `most_states` different places, or fewer where many kinds make each of
    /// them dear: where it has looked at a thousand kinds for each of so many. Both arguments outlive the
    /// counter.
    OrderCounter(const PreparedProblem& prepared, std::size_t most_states)
        : prepared_(prepared), most_states_(most_states), looks_left_(1000 * most_states),
          keys_(prepared.kinds) {}

    /// Number of sequences of kinds that keep to the limits (of drawn segments: their probability); nothing
    /// if there are too many places to count. Zero is a proof that no order keeps to them.
    std::optional<ScaledNumber> count();

    /// Each order with equal probability (in drawn segments: with that of its draws, given that the limits
    /// are kept). count() must have given a number above zero.
    KindSequence draw(RandomStream& random);

    std::size_t states() const { return ways_.size(); }

  private:
    ScaledNumber ways_from(const OrderState& state);

    const PreparedProblem& prepared_;
    std::size_t most_states_;
    std::size_t looks_left_; ///< while counting
    OrderKeys keys_;
    bool is_too_large_ = false;
    std::unordered_map<std::u16string, ScaledNumber> ways_;
};

/// Looks for one order, going back where the rest cannot be placed, and never twice from a place that was
/// found to lead nowhere.
class OrderSearch {
  public:
    enum class Answer : std::uint8_t {
        found,
        none,    ///< all was tried: there is no order
        too_long ///< given up after the most places
    };
    OrderSearch(const PreparedProblem& prepared, std::size_t most_states)
        : prepared_(prepared), states_left_(most_states), keys_(prepared.kinds) {}

    Answer find();
    const KindSequence& order() const { return order_; } ///< once found

  private:
    Answer extend(const OrderState& state);

    const PreparedProblem& prepared_;
    std::size_t states_left_;
    OrderKeys keys_;
    KindSequence order_;
    std::unordered_set<std::u16string> dead_;
};

} // namespace overt
