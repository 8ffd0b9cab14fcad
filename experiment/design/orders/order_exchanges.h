/// Orders by exchanges of items: from a random sequence that breaks limits to one that keeps to all of them,
/// and from there to others.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "experiment/base/random.h"
#include "experiment/design/orders/order_counter.h"
#include "experiment/design/orders/order_state.h"

namespace overt {

/// A sequence of kinds whose places exchange what they hold, each within its segment.
class OrderExchanges {
  public:
    /// `start` is any sequence with the right items in each segment. `prepared` outlives this.
    OrderExchanges(const PreparedProblem& prepared, KindSequence start);

    /// Tries so many exchanges at most of items that break a limit with others: always done where fewer
    /// limits are broken then, and sometimes where more are, ever more rarely (simulated annealing,
    /// Kirkpatrick et al. 1983). Where limits are tight it comes to orders that a search from the front does
    /// not; that there is none it cannot tell. False if a limit is still broken.
    bool repair(RandomStream& random, int exchanges);

    /// Exchanges random pairs where the limits allow it; none is broken before or after. Each exchange is as
    /// probable as its reverse, so that the chain ends at every order that it reaches with equal probability
    /// (Metropolis et al. 1953).
    void mix(RandomStream& random);

    /// Gives levels of equal part in the problem each other's names at random: whatever limits the sequence
    /// keeps to, it keeps to them afterwards.
    void exchange_names(RandomStream& random);

    const KindSequence& order() const { return order_; }

  private:
    struct Limit {
        bool is_run = false;
        std::size_t amount = 0;
        std::size_t factor = 0;
        int part = -1; ///< as in OrderLimit
        bool holds_in(int of) const { return part < 0 || part == of; }
    };
    int level(const Limit& limit, std::size_t place) const {
        return levels_[limit.factor * order_.places.size() + place];
    }
    void note_levels();
    void exchange(std::size_t a, std::size_t b);
    int too_near(std::size_t place) const;
    int too_long_runs(std::size_t begin, std::size_t end) const;
    int broken_about(std::size_t a, std::size_t b) const;
    bool is_broken_at(std::size_t place) const;
    void find_broken();
    std::vector<int> kinds_renamed(std::size_t factor, int level, int other) const;

    const PreparedProblem& prepared_;
    KindSequence order_;
    std::vector<Limit> runs_, distances_;
    std::size_t longest_run_ = 0;
    std::vector<int> levels_;                                     ///< by factor and place
    std::vector<std::pair<std::size_t, std::size_t>> stretch_of_; ///< by place
    std::vector<std::size_t> broken_;                             ///< places, as last looked
};

} // namespace overt
