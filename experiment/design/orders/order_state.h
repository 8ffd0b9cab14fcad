/// A place in the making of an order: what is placed matters only through what limits remember of it.
#pragma once

#include <string>
#include <vector>

#include "experiment/design/orders/order_history.h"
#include "experiment/design/orders/order_key.h"
#include "experiment/design/orders/order_kinds.h"

namespace overt {

/// What is placed next: an item of a kind, after turning to a new segment where the present one is full.
struct OrderMove {
    int segment = 0;
    int kind = 0;
    double weight = 1.0; ///< probability in a drawn segment; 1 in others
};

/// The problem that states belong to, prepared once.
struct PreparedProblem {
    explicit PreparedProblem(const OrderProblem& prepared)
        : problem(&prepared), kinds(prepared), reach(prepared) {}
    const OrderProblem* problem; ///< outlives this
    OrderKinds kinds;
    OrderHistory::Reach reach;
};

class OrderState {
  public:
    /// Nothing is placed. `prepared` must outlive the state.
    explicit OrderState(const PreparedProblem& prepared);

    bool is_complete() const { return part_ == prepared_->problem->parts.size(); }

    /// All that may come next, in a fixed order.
    std::vector<OrderMove> moves() const;

    /// The same, those first whose levels have most left to place: what waits longest is hardest to place.
    std::vector<OrderMove> urgent_moves() const;

    void make(const OrderMove& move);

    /// False where a look at each limit by itself shows that the rest of the segment cannot be placed.
    bool may_be_completed() const;

    /// Equal only for states from which the same can follow, but for the names of levels.
    std::u16string key(OrderKeys& keys) const;

    int part() const { return static_cast<int>(part_); }

  private:
    void enter_part();
    bool allows(int kind) const;

    const PreparedProblem* prepared_;
    OrderHistory history_;
    std::size_t part_ = 0;
    std::uint64_t segments_left_ = 0; ///< of the part, a bit each, where they come in any order
    int segment_ = -1;                ///< being filled
    int left_ = 0;                    ///< places in it
    std::vector<int> counts_;         ///< by kind, left in the segment
};

} // namespace overt
