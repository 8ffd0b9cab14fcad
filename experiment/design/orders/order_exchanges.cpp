#include "experiment/design/orders/order_exchanges.h"

#include <algorithm>
#include <cmath>

namespace overt {

namespace {

// In broken limits. A single one more is accepted about every seventh time at first, and hardly ever at last.
constexpr double first_temperature = 0.5, last_temperature = 0.15;
constexpr int exchanges_between_looks = 64;

/// Places of the same part and segment, from place to place: pairs of the first and the one behind the last.
std::vector<std::pair<std::size_t, std::size_t>> stretches_of(const KindSequence& order) {
    std::vector<std::pair<std::size_t, std::size_t>> stretches;
    const auto& places = order.places;
    for (std::size_t begin = 0, end = 0; begin < places.size(); begin = end) {
        while (end < places.size() && places[end].part == places[begin].part &&
               places[end].segment == places[begin].segment)
            ++end;
        stretches.emplace_back(begin, end);
    }
    return stretches;
}

} // namespace

OrderExchanges::OrderExchanges(const PreparedProblem& prepared, KindSequence start)
    : prepared_(prepared), order_(std::move(start)) {
    for (const OrderLimit& limit : prepared.problem->limits) {
        const bool is_run = limit.kind == OrderLimit::Kind::longest_run;
        const auto amount = static_cast<std::size_t>(limit.amount);
        (is_run ? runs_ : distances_)
            .push_back({is_run, amount, static_cast<std::size_t>(limit.factor), limit.part});
        if (is_run)
            longest_run_ = std::max(longest_run_, amount);
    }
    note_levels();
    for (const auto& stretch : stretches_of(order_))
        stretch_of_.resize(stretch.second, stretch);
}

void OrderExchanges::note_levels() {
    levels_.clear();
    for (std::size_t factor = 0; factor < prepared_.problem->levels.size(); ++factor) {
        for (const KindSequence::Place& place : order_.places)
            levels_.push_back(prepared_.kinds.levels[static_cast<std::size_t>(place.kind)][factor]);
    }
}

void OrderExchanges::exchange(std::size_t a, std::size_t b) {
    const std::size_t length = order_.places.size();
    std::swap(order_.places[a].kind, order_.places[b].kind);
    for (std::size_t row = 0; row < levels_.size(); row += length)
        std::swap(levels_[row + a], levels_[row + b]);
}

/// Pairs of this place and another that are nearer than they may be. A limit of a part holds for the later
/// one.
int OrderExchanges::too_near(std::size_t place) const {
    int count = 0;
    const auto& places = order_.places;
    for (const Limit& limit : distances_) {
        const int own = level(limit, place);
        if (limit.holds_in(places[place].part)) {
            for (std::size_t i = place - std::min(place, limit.amount - 1); i < place; ++i)
                count += level(limit, i) == own ? 1 : 0;
        }
        const std::size_t end = std::min(places.size(), place + limit.amount);
        for (std::size_t i = place + 1; i < end; ++i)
            count += level(limit, i) == own && limit.holds_in(places[i].part) ? 1 : 0;
    }
    return count;
}

/// Places from begin to before end at which a run is longer than it may be.
int OrderExchanges::too_long_runs(std::size_t begin, std::size_t end) const {
    int count = 0;
    for (const Limit& limit : runs_) {
        const std::size_t from = begin - std::min(begin, limit.amount);
        std::size_t run = 0;
        for (std::size_t i = from; i < end; ++i) {
            run = i > from && level(limit, i) == level(limit, i - 1) ? run + 1 : 1;
            count += i >= begin && run > limit.amount && limit.holds_in(order_.places[i].part) ? 1 : 0;
        }
    }
    return count;
}

/// All that an exchange of the two places can change, a pair of just these two twice.
int OrderExchanges::broken_about(std::size_t a, std::size_t b) const {
    int count = too_near(a) + too_near(b);
    if (runs_.empty())
        return count;
    const std::size_t first = std::min(a, b), second = std::max(a, b), length = order_.places.size();
    const std::size_t first_end = std::min(length, first + longest_run_ + 1);
    const std::size_t second_end = std::min(length, second + longest_run_ + 1);
    return first_end >= second ? count + too_long_runs(first, second_end)
                               : count + too_long_runs(first, first_end) + too_long_runs(second, second_end);
}

bool OrderExchanges::is_broken_at(std::size_t place) const {
    return too_near(place) > 0 || too_long_runs(place, place + 1) > 0;
}

void OrderExchanges::find_broken() {
    broken_.clear();
    for (std::size_t place = 0; place < order_.places.size(); ++place) {
        if (is_broken_at(place))
            broken_.push_back(place);
    }
}

bool OrderExchanges::repair(RandomStream& random, int exchanges) {
    for (int tried = 0; tried < exchanges; tried += exchanges_between_looks) {
        find_broken();
        if (broken_.empty())
            return true;
        const double share = static_cast<double>(tried) / exchanges;
        const double temperature = first_temperature * std::pow(last_temperature / first_temperature, share);
        for (int i = 0; i < exchanges_between_looks; ++i) {
            const std::size_t a = broken_[random.below(static_cast<std::uint32_t>(broken_.size()))];
            const auto [begin, end] = stretch_of_[a];
            const std::size_t b = begin + random.below(static_cast<std::uint32_t>(end - begin));
            if (order_.places[a].kind == order_.places[b].kind)
                continue;
            const int before = broken_about(a, b);
            exchange(a, b);
            const int more = broken_about(a, b) - before;
            if (more > 0 && random.uniform() >= std::exp(-more / temperature))
                exchange(a, b);
        }
    }
    find_broken();
    return broken_.empty();
}

void OrderExchanges::mix(RandomStream& random) {
    for (std::size_t begin = 0; begin < order_.places.size(); begin = stretch_of_[begin].second) {
        const auto length = static_cast<std::uint32_t>(stretch_of_[begin].second - begin);
        const double steps = 40.0 * length * std::log2(2.0 + length);
        for (double step = 0.0; length > 1 && step < steps; ++step) {
            const std::size_t a = begin + random.below(length), b = begin + random.below(length);
            if (order_.places[a].kind == order_.places[b].kind)
                continue;
            exchange(a, b);
            if (broken_about(a, b) > 0)
                exchange(a, b);
        }
    }
}

/// Which kind each kind becomes when two levels of a factor exchange their names; empty if the problem is
/// another one then.
std::vector<int> OrderExchanges::kinds_renamed(std::size_t factor, int level, int other) const {
    const OrderKinds& kinds = prepared_.kinds;
    std::vector<int> renamed(static_cast<std::size_t>(kinds.count));
    for (std::size_t kind = 0; kind < renamed.size(); ++kind) {
        std::vector<int> levels = kinds.levels[kind];
        if (levels[factor] == level || levels[factor] == other)
            levels[factor] = level + other - levels[factor];
        const auto found = std::find(kinds.levels.begin(), kinds.levels.end(), levels);
        if (found == kinds.levels.end())
            return {};
        renamed[kind] = static_cast<int>(found - kinds.levels.begin());
    }
    const auto stays = [&](const auto& by_part) {
        for (const auto& segments : by_part) {
            for (const auto& amounts : segments) {
                for (std::size_t kind = 0; kind < amounts.size(); ++kind) {
                    if (amounts[kind] != amounts[static_cast<std::size_t>(renamed[kind])])
                        return false;
                }
            }
        }
        return true;
    };
    return stays(kinds.counts) && stays(kinds.weights) ? renamed : std::vector<int>{};
}

void OrderExchanges::exchange_names(RandomStream& random) {
    const OrderKinds& kinds = prepared_.kinds;
    for (const int limited : kinds.limited) {
        const auto factor = static_cast<std::size_t>(limited);
        int levels = 0;
        for (const std::vector<int>& of_kind : kinds.levels)
            levels = std::max(levels, of_kind[factor] + 1);
        // Levels that may exchange their names two by two may do so in any way: a shuffle of these names.
        for (int level = levels - 1; level > 0; --level) {
            const int other = static_cast<int>(random.below(static_cast<std::uint32_t>(level + 1)));
            const std::vector<int> renamed =
                other == level ? std::vector<int>{} : kinds_renamed(factor, level, other);
            for (KindSequence::Place& place : order_.places) {
                if (!renamed.empty())
                    place.kind = renamed[static_cast<std::size_t>(place.kind)];
            }
        }
    }
    note_levels();
}

} // namespace overt
