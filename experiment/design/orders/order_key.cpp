#include "experiment/design/orders/order_key.h"

#include <algorithm>

namespace overt {

namespace {

std::uint64_t mixed(std::uint64_t bits) { // the finaliser of MurmurHash3
    bits ^= bits >> 33;
    bits *= 0xff51afd7ed558ccdull;
    bits ^= bits >> 33;
    bits *= 0xc4ceb9fe1a85ec53ull;
    return bits ^ (bits >> 33);
}

} // namespace

OrderKeys::OrderKeys(const OrderKinds& kinds) : kinds_(kinds), factors_(kinds.limited.size()) {
    first_level_.push_back(0);
    level_of_.resize(kinds.levels.size() * factors_);
    for (std::size_t factor = 0; factor < factors_; ++factor) {
        int most = 0;
        for (std::size_t kind = 0; kind < kinds.levels.size(); ++kind) {
            const int number = kinds.levels[kind][static_cast<std::size_t>(kinds.limited[factor])];
            level_of_[kind * factors_ + factor] = static_cast<int>(first_level_.back()) + number;
            most = std::max(most, number + 1);
        }
        first_level_.push_back(first_level_.back() + static_cast<std::size_t>(most));
    }
    levels_.resize(first_level_.back());
}

std::u16string OrderKeys::key_of(const std::u16string& head, const std::vector<int>& counts, int part,
                                 const OrderHistory& history) {
    colour(part, counts, history);
    const int rounds = factors_ > 1 ? 2 : 1;
    refine(rounds);
    for (std::uint64_t step = 1; factors_ > 1 && step <= 12 && tell_one_apart(step); ++step)
        refine(rounds);
    name_levels();

    // The renamed kinds with their worth, and the marks of the levels.
    sorted_.clear();
    for (const Active& active : active_) {
        std::uint64_t row = 0;
        for (std::size_t factor = 0; factor < factors_; ++factor)
            row = row << 11 |
                  static_cast<std::uint64_t>(level(static_cast<std::size_t>(active.kind), factor).name);
        // Four factors of up to 2048 levels beside a worth of 32 bits would not fit: the worth goes apart.
        sorted_.push_back(row << 20 | static_cast<std::uint64_t>(sorted_.size()));
    }
    std::sort(sorted_.begin(), sorted_.end());
    std::u16string key = head;
    key.reserve(head.size() + active_.size() * (factors_ + 2) + levels_.size() + factors_);
    for (const std::uint64_t row : sorted_) {
        const Active& active = active_[row & 0xfffff];
        for (std::size_t factor = 0; factor < factors_; ++factor)
            key += static_cast<char16_t>(level(static_cast<std::size_t>(active.kind), factor).name);
        key += static_cast<char16_t>(active.worth >> 16);
        key += static_cast<char16_t>(active.worth & 0xffff);
    }
    for (std::size_t factor = 0; factor < factors_; ++factor) {
        key += u'\xffff';
        for (std::size_t i = first_level_[factor]; i < first_level_[factor + 1]; ++i) {
            const Level& named = levels_[static_cast<std::size_t>(by_colour_[i])];
            if (named.is_active)
                key += static_cast<char16_t>(named.mark);
        }
    }
    return key;
}

void OrderKeys::colour(int part, const std::vector<int>& counts, const OrderHistory& history) {
    for (Level& one : levels_)
        one.is_active = false;
    active_.clear();
    const auto& roles = kinds_.role[static_cast<std::size_t>(part)];
    for (std::size_t kind = 0; kind < roles.size(); ++kind) {
        const auto count = static_cast<std::uint32_t>(counts.empty() ? 0 : counts[kind]);
        if (count == 0 && roles[kind] == 0)
            continue;
        active_.push_back({static_cast<int>(kind), count << 16 | roles[kind]});
        for (std::size_t factor = 0; factor < factors_; ++factor) {
            Level& one = level(kind, factor);
            if (one.is_active)
                continue;
            one.is_active = true;
            const int number = level_of_[kind * factors_ + factor] - static_cast<int>(first_level_[factor]);
            one.mark = history.mark(kinds_.limited[factor], number);
            one.colour = mixed(static_cast<std::uint64_t>(one.mark) + 1);
        }
    }
}

void OrderKeys::refine(int rounds) {
    for (int round = 0; round < rounds; ++round) {
        for (Level& one : levels_)
            one.next = one.colour;
        for (const Active& active : active_) {
            const auto kind = static_cast<std::size_t>(active.kind);
            std::uint64_t hash = active.worth;
            for (std::size_t factor = 0; factor < factors_; ++factor)
                hash = hash * 0x9E3779B97F4A7C15ull + level(kind, factor).colour;
            hash = mixed(hash);
            for (std::size_t factor = 0; factor < factors_; ++factor)
                level(kind, factor).next += hash;
        }
        for (Level& one : levels_)
            one.colour = one.next;
    }
}

bool OrderKeys::tell_one_apart(std::uint64_t step) {
    for (std::size_t factor = 0; factor < factors_; ++factor) {
        for (std::size_t a = first_level_[factor]; a < first_level_[factor + 1]; ++a) {
            for (std::size_t b = a + 1; levels_[a].is_active && b < first_level_[factor + 1]; ++b) {
                if (levels_[b].is_active && levels_[a].colour == levels_[b].colour) {
                    levels_[a].colour = mixed(step);
                    return true;
                }
            }
        }
    }
    return false;
}

void OrderKeys::name_levels() {
    by_colour_.resize(levels_.size());
    for (std::size_t factor = 0; factor < factors_; ++factor) {
        const auto begin = by_colour_.begin() + static_cast<std::ptrdiff_t>(first_level_[factor]);
        const auto end = by_colour_.begin() + static_cast<std::ptrdiff_t>(first_level_[factor + 1]);
        for (auto at = begin; at != end; ++at)
            *at = static_cast<int>(at - by_colour_.begin());
        std::sort(begin, end, [&](int a, int b) {
            const Level &left = levels_[static_cast<std::size_t>(a)],
                        &right = levels_[static_cast<std::size_t>(b)];
            if (left.is_active != right.is_active)
                return left.is_active;
            return left.colour != right.colour ? left.colour < right.colour : a < b;
        });
        for (auto at = begin; at != end; ++at)
            levels_[static_cast<std::size_t>(*at)].name = static_cast<int>(at - begin);
    }
}

} // namespace overt
