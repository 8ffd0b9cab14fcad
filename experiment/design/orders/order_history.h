/// What limits have to remember of the sequence so far.
#pragma once

#include <span>
#include <vector>

#include "experiment/design/orders/order_problem.h"

namespace overt {

/// For each factor the present run, and for each level how long ago it came. A value: copies go on
/// independently.
class OrderHistory {
  public:
    /// How far the limits of each factor look; made once for a problem.
    struct Reach {
        explicit Reach(const OrderProblem& problem);
        struct Factor {
            int longest_run = 0, longest_distance = 0;
            std::size_t begin = 0, end = 0; ///< of its levels
        };
        std::vector<OrderLimit> limits;
        std::vector<Factor> factors;
        std::size_t size = 0;
    };

    /// `reach` must outlive the history.
    explicit OrderHistory(const Reach& reach) : reach_(&reach), memory_(reach.size) {}

    /// Whether an item of these levels (by factor) may come next, in this part of the sequence.
    bool allows(std::span<const int> levels, int part) const;

    void push(std::span<const int> levels);

    /// All that any limit still knows of a level, as a number: two levels with the same mark are alike to
    /// what may follow. 0: nothing.
    int mark(int index, int level) const;

    /// Steps until the level may come again under the limits of a part: 0 if it may come next. Runs count as
    /// a wait of one step, which anything else ends.
    int wait(int index, int level, int part) const;

    /// How many more of the level may follow at once: the limit less the present run.
    int room_in_run(int index, int level, int longest) const;

  private:
    /// Steps since a level came, 1 for the last; 0: too long ago to matter.
    int since(const Reach::Factor& factor, int level) const {
        return memory_[factor.begin + 2 + static_cast<std::size_t>(level)];
    }
    int last(const Reach::Factor& factor) const { return memory_[factor.begin] - 1; } ///< level, or -1
    int run(const Reach::Factor& factor) const { return memory_[factor.begin + 1]; }  ///< of the last

    const Reach* reach_;
    std::vector<std::uint16_t> memory_; ///< by factor: the last level and one, its run, and since() of each
};

/// Whether the places begin … end-1 of a sequence keep to all limits, seen by themselves.
bool keeps_to_limits(const OrderProblem& problem, const OrderHistory::Reach& reach,
                     const ItemSequence& sequence, std::size_t begin, std::size_t end);

} // namespace overt
