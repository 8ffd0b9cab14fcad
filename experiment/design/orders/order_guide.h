/// An order problem with the limits of one factor only: orders of it are quickly drawn, and come nearer to
/// keeping to all limits than a shuffle does.
#pragma once

#include <optional>

#include "experiment/base/random.h"
#include "experiment/design/orders/order_counter.h"
#include "experiment/design/orders/order_state.h"

namespace overt {

/// An item of a drawn segment, by its weights.
int draw_by_weight(const OrderSegment& segment, RandomStream& random);

/// Items for a sequence of kinds: those of a kind come in random order.
ItemSequence fill_in(const PreparedProblem& prepared, const KindSequence& order, RandomStream& random);

/// The places of `order` with the kinds that the items of `sequence` are in another preparation.
KindSequence in_kinds_of(const PreparedProblem& prepared, KindSequence order, const ItemSequence& sequence);

/// The same problem with its levels called otherwise, at random: a search goes through it in another order.
OrderProblem renamed(OrderProblem problem, RandomStream& random);

class OrderGuide {
  public:
    /// `factor`: whose limits are kept; -1: none.
    OrderGuide(const OrderProblem& whole, int factor, std::size_t most_states);
    OrderGuide(const OrderGuide&) = delete;

    /// Whether its orders could be counted, and there are any.
    bool is_counted() const { return ways_ && !ways_->is_zero(); }

    int kinds() const { return prepared_.kinds.count; }

    /// Natural logarithm of the share of all orders that keep to the factor's limits; infinite if it could
    /// not be counted.
    double share() const;

    /// An order that keeps to the factor's limits, each with equal probability. For is_counted().
    ItemSequence draw(RandomStream& random);

    /// The same in kinds of the whole problem, of which `whole` is the preparation. What could not be counted
    /// is searched for, not evenly; nothing if that leads nowhere.
    std::optional<KindSequence> start(const PreparedProblem& whole, RandomStream& random);

  private:
    static OrderProblem restricted(OrderProblem problem, int factor);

    std::size_t most_states_;
    OrderProblem problem_;
    PreparedProblem prepared_;
    OrderCounter counter_;
    std::optional<ScaledNumber> ways_;
};

} // namespace overt
