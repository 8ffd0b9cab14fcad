#include "experiment/design/orders/order_counter.h"

#include <algorithm>

#include "experiment/base/error.h"

namespace overt {

std::optional<ScaledNumber> OrderCounter::count() {
    const ScaledNumber ways = ways_from(OrderState(prepared_));
    if (is_too_large_)
        return std::nullopt;
    return ways;
}

ScaledNumber OrderCounter::ways_from(const OrderState& state) {
    if (state.is_complete())
        return ScaledNumber::of(1.0);
    if (is_too_large_ || !state.may_be_completed())
        return {};
    std::u16string key = state.key(keys_);
    if (const auto known = ways_.find(key); known != ways_.end())
        return known->second;
    const std::vector<OrderMove> moves = state.moves();
    const auto looks = static_cast<std::size_t>(prepared_.kinds.count) * moves.size();
    if (ways_.size() >= most_states_ || looks > looks_left_) {
        is_too_large_ = true;
        return {};
    }
    looks_left_ -= looks;
    ScaledNumber ways;
    for (const OrderMove& move : moves) {
        OrderState next = state;
        next.make(move);
        ways += ways_from(next) * move.weight;
    }
    ways_.emplace(std::move(key), ways);
    return ways;
}

KindSequence OrderCounter::draw(RandomStream& random) {
    KindSequence order;
    for (OrderState state(prepared_); !state.is_complete();) {
        const ScaledNumber all = ways_from(state);
        OVERT_EXPECTS(!all.is_zero() && !is_too_large_);
        double chance = random.uniform();
        OrderState chosen = state;
        KindSequence::Place place;
        for (const OrderMove& move : state.moves()) {
            OrderState next = state;
            next.make(move);
            const ScaledNumber ways = ways_from(next) * move.weight;
            if (ways.is_zero())
                continue;
            // The last possible move stays, should rounding leave a chance over.
            chosen = next;
            place = {state.part(), move.segment, move.kind};
            chance -= ways.over(all);
            if (chance < 0.0)
                break;
        }
        order.places.push_back(place);
        state = std::move(chosen);
    }
    return order;
}

OrderSearch::Answer OrderSearch::find() { return extend(OrderState(prepared_)); }

OrderSearch::Answer OrderSearch::extend(const OrderState& state) {
    if (state.is_complete())
        return Answer::found;
    if (!state.may_be_completed())
        return Answer::none;
    std::u16string key = state.key(keys_);
    if (dead_.contains(key))
        return Answer::none;
    if (states_left_ == 0)
        return Answer::too_long;
    --states_left_;
    for (const OrderMove& move : state.urgent_moves()) {
        OrderState next = state;
        next.make(move);
        order_.places.push_back({state.part(), move.segment, move.kind});
        if (const Answer answer = extend(next); answer != Answer::none)
            return answer;
        order_.places.pop_back();
    }
    dead_.insert(std::move(key));
    return Answer::none;
}

} // namespace overt
