/// Who is asked what about which stimulus, and in which order.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/design/rotation.h"
#include "experiment/protocol/protocol.h"
#include "experiment/trial.h"

namespace overt {

/// All trials of an observer, block by block as listed, each as often as it comes; of a block with draws,
/// those that are drawn from, once. Throws InputError as group_place does.
std::vector<Trial> trials_of(const Protocol& protocol, int observer_number);

/// How many trials an observer has.
int trial_count(const Protocol& protocol, int observer_number);

/// Makes schedules of a sound protocol, which must outlive it, and keeps what it has counted of one
/// observer's orders for the next.
class ScheduleMaker {
  public:
    explicit ScheduleMaker(const Protocol& protocol, RotationRule rule = RotationRule::crossed);
    ~ScheduleMaker();

    /// A pure function of protocol, observer's number and seed. Each block has a random stream of its own,
    /// named by its id: changing, adding or removing another block reshuffles nothing in it. Every order that
    /// keeps to the limits is equally probable where Schedule::is_even says so. Throws InputError if no order
    /// keeps to them, the number is beyond the caps of all groups, or a trial finds nothing to show again
    /// (recorded_trials.h).
    Schedule make(const Observer& observer, std::uint64_t seed);

  private:
    class Orders;
    const Protocol& protocol_;
    RotationRule rule_;
    std::unique_ptr<Orders> orders_;
};

/// One schedule.
Schedule make_schedule(const Protocol& protocol, const Observer& observer, std::uint64_t seed,
                       RotationRule rule = RotationRule::crossed);

/// Why no order keeps to the protocol's limits: the fewest limits that cannot hold together.
struct OrderConflict {
    std::vector<std::string> keys; ///< to change, as "schedule.max_task_run"; the first is at fault most
    std::string message;
    std::string hint;
};

/// Nothing if there is an order that keeps to them, for each planned observer.
std::optional<OrderConflict> find_order_conflict(const Protocol& protocol);

/// The number at the end of an observer's label: 7 for "P07" or "lab2-7". Nothing where there is none, or it
/// is 0 or has more than nine digits.
std::optional<int> observer_number(std::string_view label);

} // namespace overt
