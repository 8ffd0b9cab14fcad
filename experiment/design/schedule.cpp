#include "experiment/design/schedule.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/design/block_plan.h"
#include "experiment/design/order_conflict.h"
#include "experiment/design/orders/order_draw.h"
#include "experiment/design/recorded_trials.h"

namespace overt {

/// The problems that were met, each with what is known of it.
class ScheduleMaker::Orders {
  public:
    OrderDraw& of(const OrderProblem& problem) {
        for (auto& [known, draw] : known_) {
            if (known == problem)
                return draw;
        }
        // Rotations give a few problems that come again and again; beyond that it is not worth looking.
        if (known_.size() >= 64)
            known_.erase(known_.begin());
        return known_.emplace_back(problem, OrderDraw(problem)).second;
    }

  private:
    std::vector<std::pair<OrderProblem, OrderDraw>> known_;
};

ScheduleMaker::ScheduleMaker(const Protocol& protocol, RotationRule rule)
    : protocol_(protocol), rule_(rule), orders_(std::make_unique<Orders>()) {}

ScheduleMaker::~ScheduleMaker() = default;

Schedule ScheduleMaker::make(const Observer& observer, std::uint64_t seed) {
    Schedule schedule{observer, seed, {}};
    for (const OrderChain& chain : order_chains(protocol_, observer.number, seed, rule_)) {
        const std::string& block = block_at(protocol_, chain.blocks.front().block).id;
        const std::string purpose = block.empty() ? "trial order" : "trial order of block " + block;
        RandomStream random(seed, purpose, static_cast<std::uint64_t>(observer.number));
        const std::optional<DrawnOrder> order = orders_->of(chain.problem).draw(random);
        if (!order) {
            const auto conflict = conflict_in(protocol_, chain);
            OVERT_EXPECTS(conflict.has_value());
            throw InputError(
                fmt::format("{}: {}; {}", conflict->keys.front(), conflict->message, conflict->hint));
        }
        schedule.is_even = schedule.is_even && order->evenness == OrderEvenness::exact;
        for (const int item : order->sequence.items) {
            schedule.trials.push_back(chain.trials[static_cast<std::size_t>(item)]);
            schedule.trials.back().index = static_cast<int>(schedule.trials.size()) - 1;
        }
    }
    OVERT_EXPECTS(!schedule.trials.empty());
    if (const std::optional<std::string> wrong = yoke(protocol_, observer.number, schedule.trials))
        throw InputError(*wrong);
    return schedule;
}

std::vector<Trial> trials_of(const Protocol& protocol, int number) {
    std::vector<Trial> trials;
    for (const OrderChain& chain : order_chains(protocol, number, 0))
        trials.insert(trials.end(), chain.trials.begin(), chain.trials.end());
    for (std::size_t i = 0; i < trials.size(); ++i)
        trials[i].index = static_cast<int>(i);
    return trials;
}

int trial_count(const Protocol& protocol, int number) {
    int count = 0;
    for (const BlockPlan& plan : block_plans(protocol, number, 0))
        count += length_of(protocol, plan);
    return count;
}

Schedule make_schedule(const Protocol& protocol, const Observer& observer, std::uint64_t seed,
                       RotationRule rule) {
    return ScheduleMaker(protocol, rule).make(observer, seed);
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
