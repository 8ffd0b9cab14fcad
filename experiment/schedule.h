/// Who is asked what about which stimulus, and in which order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/protocol/protocol.h"
#include "experiment/trial.h"

namespace overt {

/// The material in which an observer sees a sculpture under the `rotating_task`-th of the tasks that are
/// asked once per sculpture (from 0). A cyclic arrangement: (number - 1 + c + floor(c / L)) mod M with the
/// cell c = task * S + sculpture and L the least common multiple of S and M. So every M observers in sequence
/// fill all M materials of a cell once; each observer sees all materials equally often, to one; and a
/// sculpture changes its material from task to task. `observer_number` from 1.
int rotated_material(int observer_number, int rotating_task, int sculpture, int sculpture_count,
                     int material_count);

/// All trials of an observer, task by task in the order of the protocol.
std::vector<Trial> trials_of(const Protocol& protocol, int observer_number);

/// The trials in random order: every order that keeps to max_sculpture_run and max_task_run is equally
/// probable. It is drawn by rejection, which is exact; where fewer than about one order in 2000 keeps to
/// them, by a chain of random exchanges from an order found by search, which comes near. A pure function of
/// its arguments. Throws InputError if no order keeps to the limits. The protocol's lists must not be empty.
Schedule make_schedule(const Protocol& protocol, const Observer& observer, std::uint64_t seed);

/// Why no order keeps to the protocol's limits.
struct OrderConflict {
    std::string key; ///< the key to change, as "schedule.max_task_run"
    std::string message;
    std::string hint;
};

/// Nothing if there is an order that keeps to them.
std::optional<OrderConflict> find_order_conflict(const Protocol& protocol);

/// The number at the end of an observer's label: 7 for "P07" or "lab2-7". Nothing where there is none, or it
/// is 0 or has more than nine digits.
std::optional<int> observer_number(std::string_view label);

} // namespace overt
