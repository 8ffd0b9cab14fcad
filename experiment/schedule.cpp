#include "experiment/schedule.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "experiment/error.h"
#include "experiment/random.h"

namespace overt {

namespace {

int count_of(const auto& list) { return static_cast<int>(list.size()); }

/// A limit on how many trials in sequence may share a value (their sculpture, their task).
struct RunLimit {
    std::string_view key;
    std::string_view noun;
    int longest = 0;
    std::vector<int> value_of; ///< by trial
    std::vector<int> count_of; ///< by value
};

std::vector<RunLimit> run_limits(const Protocol& protocol, const std::vector<Trial>& trials) {
    std::vector<RunLimit> limits;
    const auto add = [&](std::string_view key, std::string_view noun, int longest, int values, auto value) {
        if (longest <= 0 || values <= 1)
            return;
        RunLimit limit{key, noun, longest, {}, std::vector<int>(static_cast<std::size_t>(values))};
        for (const Trial& trial : trials) {
            limit.value_of.push_back(value(trial));
            ++limit.count_of[static_cast<std::size_t>(value(trial))];
        }
        limits.push_back(std::move(limit));
    };
    add("schedule.max_sculpture_run", "sculpture", protocol.schedule.max_sculpture_run,
        count_of(protocol.sculptures), [](const Trial& trial) { return trial.condition.sculpture; });
    add("schedule.max_task_run", "task", protocol.schedule.max_task_run, count_of(protocol.tasks),
        [](const Trial& trial) { return trial.task; });
    return limits;
}

/// Positions in sequence around `position` with the same value as there.
int run_length_at(const std::vector<int>& order, const RunLimit& limit, int position) {
    const auto value_at = [&](int i) {
        return limit.value_of[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])];
    };
    int first = position, last = position;
    while (first > 0 && value_at(first - 1) == value_at(position))
        --first;
    while (last + 1 < count_of(order) && value_at(last + 1) == value_at(position))
        ++last;
    return last - first + 1;
}

bool keeps_to(const std::vector<int>& order, const std::vector<RunLimit>& limits, int position) {
    return std::all_of(limits.begin(), limits.end(), [&](const RunLimit& limit) {
        return run_length_at(order, limit, position) <= limit.longest;
    });
}

bool keeps_to(const std::vector<int>& order, const std::vector<RunLimit>& limits) {
    for (int position = 0; position < count_of(order); ++position) {
        if (!keeps_to(order, limits, position))
            return false;
    }
    return true;
}

/// Search for one order, trial by trial, going back where the rest cannot be placed.
class OrderSearch {
  public:
    OrderSearch(const std::vector<RunLimit>& limits, std::vector<int> trials)
        : limits_(limits), waiting_(std::move(trials)) {
        for (const RunLimit& limit : limits_)
            left_.push_back(limit.count_of);
    }

    /// Empty if there is no order, or none was found in a bounded number of steps.
    std::vector<int> find() { return extend() ? order_ : std::vector<int>{}; }

  private:
    bool extend() {
        if (waiting_.empty())
            return true;
        if (--steps_left_ < 0)
            return false;
        std::vector<std::vector<int>> tried;
        for (std::size_t i = 0; i < waiting_.size(); ++i) {
            // Trials that no limit tells apart lead to the same end.
            std::vector<int> values;
            for (const RunLimit& limit : limits_)
                values.push_back(limit.value_of[static_cast<std::size_t>(waiting_[i])]);
            if (std::find(tried.begin(), tried.end(), values) != tried.end())
                continue;
            tried.push_back(values);
            place(i);
            if (keeps_to(order_, limits_, count_of(order_) - 1) && rest_is_placeable() && extend())
                return true;
            take_back(i);
        }
        return false;
    }

    void place(std::size_t waiting_index) {
        const int trial = waiting_[waiting_index];
        order_.push_back(trial);
        waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(waiting_index));
        for (std::size_t i = 0; i < limits_.size(); ++i)
            --left_of(i, trial);
    }

    void take_back(std::size_t waiting_index) {
        const int trial = order_.back();
        order_.pop_back();
        waiting_.insert(waiting_.begin() + static_cast<std::ptrdiff_t>(waiting_index), trial);
        for (std::size_t i = 0; i < limits_.size(); ++i)
            ++left_of(i, trial);
    }

    int& left_of(std::size_t limit, int trial) {
        return left_[limit]
                    [static_cast<std::size_t>(limits_[limit].value_of[static_cast<std::size_t>(trial)])];
    }

    /// For each limit by itself: n trials of a value need n / longest gaps between the others; the gap that
    /// is open now has room for what the present run leaves.
    bool rest_is_placeable() {
        for (std::size_t i = 0; i < limits_.size(); ++i) {
            const RunLimit& limit = limits_[i];
            const int present = limit.value_of[static_cast<std::size_t>(order_.back())];
            const int run = run_length_at(order_, limit, count_of(order_) - 1);
            const int all_left = count_of(waiting_);
            for (int value = 0; value < count_of(limit.count_of); ++value) {
                const int left = left_[i][static_cast<std::size_t>(value)];
                const int open_room = value == present ? limit.longest - run : limit.longest;
                if (left > limit.longest * (all_left - left) + open_room)
                    return false;
            }
        }
        return true;
    }

    const std::vector<RunLimit>& limits_;
    std::vector<int> waiting_, order_;
    std::vector<std::vector<int>> left_; ///< by limit and value: trials still waiting
    int steps_left_ = 100'000;
};

/// Exchanges random pairs where the limits allow it. Each exchange is as probable as its reverse, so that the
/// chain ends at every order that it reaches with equal probability (Metropolis et al. 1953).
void mix(std::vector<int>& order, const std::vector<RunLimit>& limits, RandomStream& random) {
    const auto count = static_cast<std::uint32_t>(order.size());
    const double steps = 200.0 * count * std::log2(2.0 + count);
    for (double step = 0.0; step < steps; ++step) {
        const auto a = random.below(count), b = random.below(count);
        std::swap(order[a], order[b]);
        const auto keeps_near = [&](std::uint32_t i) {
            // A trial taken out of a place can join the runs to both sides of it.
            const int position = static_cast<int>(i);
            return keeps_to(order, limits, position) && (i == 0 || keeps_to(order, limits, position - 1)) &&
                   (i + 1 == count || keeps_to(order, limits, position + 1));
        };
        if (!keeps_near(a) || !keeps_near(b))
            std::swap(order[a], order[b]);
    }
}

std::vector<int> identity_order(std::size_t count) {
    std::vector<int> order(count);
    std::iota(order.begin(), order.end(), 0);
    return order;
}

std::optional<OrderConflict> find_conflict(const std::vector<RunLimit>& limits, std::size_t trial_count) {
    for (const RunLimit& limit : limits) {
        const int most = *std::max_element(limit.count_of.begin(), limit.count_of.end());
        const int others = static_cast<int>(trial_count) - most;
        if (most > limit.longest * (others + 1)) {
            const int least = (most + others) / (others + 1);
            return OrderConflict{
                std::string(limit.key),
                fmt::format("no order keeps to runs of {} with the same {}: one {} has {} of the {} trials",
                            limit.longest, limit.noun, limit.noun, most, trial_count),
                fmt::format("allow runs of {} at least, or 0 for no limit", least)};
        }
    }
    if (limits.size() > 1 && OrderSearch(limits, identity_order(trial_count)).find().empty()) {
        return OrderConflict{std::string(limits.back().key),
                             "no order was found that keeps to both max_sculpture_run and max_task_run",
                             "allow longer runs of one of them"};
    }
    return std::nullopt;
}

std::vector<int> draw_order(const Protocol& protocol, const std::vector<Trial>& trials,
                            RandomStream& random) {
    const std::vector<RunLimit> limits = run_limits(protocol, trials);
    std::vector<int> order = identity_order(trials.size());
    for (int attempt = 0; attempt < 2000; ++attempt) {
        random.shuffle(std::span(order));
        if (keeps_to(order, limits))
            return order;
    }
    if (const auto conflict = find_conflict(limits, trials.size()))
        throw InputError(fmt::format("{}: {}; {}", conflict->key, conflict->message, conflict->hint));
    order = OrderSearch(limits, order).find();
    if (order.empty()) // this start led nowhere in bounded time; the plain one was found to lead to an order
        order = OrderSearch(limits, identity_order(trials.size())).find();
    if (order.empty())
        throw InputError("schedule.max_sculpture_run: no order of the trials was found; allow longer runs");
    mix(order, limits, random);
    return order;
}

} // namespace

int rotated_material(int observer_number, int rotating_task, int sculpture, int sculpture_count,
                     int material_count) {
    OVERT_EXPECTS(observer_number >= 1 && rotating_task >= 0 && sculpture >= 0);
    OVERT_EXPECTS(sculpture < sculpture_count && material_count >= 1);
    const int cell = rotating_task * sculpture_count + sculpture;
    const int round = std::lcm(sculpture_count, material_count);
    return (observer_number - 1 + cell + cell / round) % material_count;
}

std::vector<Trial> trials_of(const Protocol& protocol, int number) {
    const int sculptures = count_of(protocol.sculptures), materials = count_of(protocol.materials);
    std::vector<Trial> trials;
    const auto add = [&](int task, int sculpture, int material) {
        trials.push_back({count_of(trials), task, {sculpture, material}});
    };
    int rotating_task = 0;
    for (int task = 0; task < count_of(protocol.tasks); ++task) {
        const TaskCoverage coverage = protocol.tasks[static_cast<std::size_t>(task)].stimuli;
        for (int sculpture = 0; sculpture < sculptures; ++sculpture) {
            if (coverage == TaskCoverage::once_per_sculpture) {
                add(task, sculpture,
                    rotated_material(number, rotating_task, sculpture, sculptures, materials));
                continue;
            }
            for (int material = 0; material < materials; ++material)
                add(task, sculpture, material);
        }
        rotating_task += coverage == TaskCoverage::once_per_sculpture ? 1 : 0;
    }
    return trials;
}

Schedule make_schedule(const Protocol& protocol, const Observer& observer, std::uint64_t seed) {
    const std::vector<Trial> trials = trials_of(protocol, observer.number);
    OVERT_EXPECTS(!trials.empty());
    RandomStream random(seed, "trial order", static_cast<std::uint64_t>(observer.number));
    Schedule schedule{observer, seed, {}};
    for (const int chosen : draw_order(protocol, trials, random)) {
        schedule.trials.push_back(trials[static_cast<std::size_t>(chosen)]);
        schedule.trials.back().index = count_of(schedule.trials) - 1;
    }
    return schedule;
}

std::optional<OrderConflict> find_order_conflict(const Protocol& protocol) {
    const std::vector<Trial> trials = trials_of(protocol, 1);
    return find_conflict(run_limits(protocol, trials), trials.size());
}

std::optional<int> observer_number(std::string_view label) {
    const std::size_t last_other = label.find_last_not_of("0123456789");
    std::string_view digits = label.substr(last_other == std::string_view::npos ? 0 : last_other + 1);
    digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
    if (digits.empty() || digits.size() > 9)
        return std::nullopt;
    int number = 0;
    for (const char digit : digits)
        number = 10 * number + (digit - '0');
    return number;
}

} // namespace overt
