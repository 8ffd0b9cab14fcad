/// One order of many: drawn so that each is equally probable, where that can be done; and why there is none,
/// where there is none.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiment/base/random.h"
#include "experiment/design/orders/order_problem.h"

namespace overt {

/// How evenly an order was drawn.
enum class OrderEvenness : std::uint8_t {
    exact, ///< each order that keeps to the limits had the same probability, to the rounding of a double
    near   ///< exchanges at random, until all limits are kept and long after, come near to it
};

struct DrawnOrder {
    ItemSequence sequence;
    OrderEvenness evenness = OrderEvenness::exact;
};

/// Draws orders of one problem, and keeps what it has counted for the next.
class OrderDraw {
  public:
    /// The problem is copied.
    explicit OrderDraw(OrderProblem problem);
    ~OrderDraw();
    OrderDraw(OrderDraw&&) noexcept;
    OrderDraw& operator=(OrderDraw&&) noexcept;

    enum class Existence : std::uint8_t { exists, none, unknown };
    /// Whether any order keeps to the limits. `unknown` only after most_searched_states places of a search,
    /// all of them different, led to neither an order nor an end, and exchanges to none either.
    Existence existence();

    /// Nothing if none exists, or none was found in bounded time. The first 2000 tries are plain shuffles, so
    /// that an order which a shuffle gives does not depend on how others are found; then orders are counted,
    /// for all limits or for those of one factor, the others being tried; then shuffled again, more often.
    /// All of these are exact. What is left begins as a random order that keeps to the limits of one factor,
    /// is repaired by exchanges (or, where that fails, searched for with its levels in random order), and
    /// mixed.
    std::optional<DrawnOrder> draw(RandomStream& random);

    /// Places after which counting, and searching, are given up: some tenths of a second each.
    static constexpr std::size_t most_quickly_counted_states = 20'000;
    static constexpr std::size_t most_counted_states = 60'000;
    static constexpr std::size_t most_searched_states = 200'000;

  private:
    class Work;
    std::unique_ptr<Work> work_;
};

/// Limits that no order keeps to together, though without any one of them there would be one.
struct LimitConflict {
    std::vector<OrderLimit> limits;
    bool is_proved = true; ///< false: none was found in bounded time
};

/// Nothing if there is an order.
std::optional<LimitConflict> find_limit_conflict(const OrderProblem& problem);

/// The nearest amount of one limit with which there is an order, the others as they are; 0: only without it.
int nearest_possible_amount(const OrderProblem& problem, const OrderLimit& limit);

} // namespace overt
