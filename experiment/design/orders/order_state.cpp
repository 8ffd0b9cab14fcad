#include "experiment/design/orders/order_state.h"

#include <algorithm>
#include <span>

namespace overt {

OrderState::OrderState(const PreparedProblem& prepared) : prepared_(&prepared), history_(prepared.reach) {
    enter_part();
}

void OrderState::enter_part() {
    const auto& parts = prepared_->problem->parts;
    while (part_ < parts.size() && parts[part_].segments.empty())
        ++part_;
    if (part_ == parts.size())
        return;
    segment_ = -1;
    left_ = 0;
    segments_left_ = parts[part_].in_any_order ? (1ull << parts[part_].segments.size()) - 1 : 0;
}

bool OrderState::allows(int kind) const {
    return history_.allows(prepared_->kinds.levels[static_cast<std::size_t>(kind)], part());
}

std::vector<OrderMove> OrderState::moves() const {
    std::vector<OrderMove> moves;
    if (is_complete())
        return moves;
    const auto& kinds = prepared_->kinds;
    const OrderPart& part = prepared_->problem->parts[part_];
    const auto add = [&](int segment, std::span<const int> counts) {
        const auto& weights = kinds.weights[part_][static_cast<std::size_t>(segment)];
        for (int kind = 0; kind < kinds.count; ++kind) {
            const auto at = static_cast<std::size_t>(kind);
            if (counts[at] > 0 && (weights.empty() || weights[at] > 0.0) && allows(kind))
                moves.push_back({segment, kind, weights.empty() ? 1.0 : weights[at]});
        }
    };
    if (left_ > 0) {
        add(segment_, counts_);
    } else if (part.in_any_order) {
        for (int segment = 0; segment < static_cast<int>(part.segments.size()); ++segment) {
            if (segments_left_ >> segment & 1)
                add(segment, kinds.counts[part_][static_cast<std::size_t>(segment)]);
        }
    } else {
        add(segment_ + 1, kinds.counts[part_][static_cast<std::size_t>(segment_ + 1)]);
    }
    return moves;
}

std::vector<OrderMove> OrderState::urgent_moves() const {
    std::vector<OrderMove> moves = this->moves();
    const auto& kinds = prepared_->kinds;
    // What is left of each level of each limited factor, of the segment last looked at.
    int segment = -2;
    std::vector<std::vector<int>> left(kinds.limited.size());
    const auto count_left = [&](const OrderMove& move) {
        if (move.segment == segment)
            return;
        segment = move.segment;
        const std::vector<int>& counts =
            left_ > 0 ? counts_ : kinds.counts[part_][static_cast<std::size_t>(move.segment)];
        for (std::size_t i = 0; i < left.size(); ++i) {
            left[i].assign(left[i].size(), 0);
            for (std::size_t kind = 0; kind < counts.size(); ++kind) {
                const auto level =
                    static_cast<std::size_t>(kinds.levels[kind][static_cast<std::size_t>(kinds.limited[i])]);
                left[i].resize(std::max(left[i].size(), level + 1));
                left[i][level] += counts[kind];
            }
        }
    };
    const auto urgency = [&](const OrderMove& move) {
        count_left(move);
        int most = 0, all = 0;
        for (std::size_t i = 0; i < left.size(); ++i) {
            const int level =
                kinds.levels[static_cast<std::size_t>(move.kind)][static_cast<std::size_t>(kinds.limited[i])];
            const int same = left[i][static_cast<std::size_t>(level)];
            most = std::max(most, same);
            all += same;
        }
        return std::pair(most, all);
    };
    std::vector<std::pair<std::pair<int, int>, OrderMove>> ranked;
    for (const OrderMove& move : moves)
        ranked.emplace_back(urgency(move), move);
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (std::size_t i = 0; i < moves.size(); ++i)
        moves[i] = ranked[i].second;
    return moves;
}

void OrderState::make(const OrderMove& move) {
    const OrderPart& part = prepared_->problem->parts[part_];
    const OrderSegment& segment = part.segments[static_cast<std::size_t>(move.segment)];
    if (left_ == 0) {
        segment_ = move.segment;
        left_ = segment.length();
        counts_ = prepared_->kinds.counts[part_][static_cast<std::size_t>(move.segment)];
        segments_left_ &= ~(1ull << move.segment);
    }
    if (!segment.is_drawn())
        --counts_[static_cast<std::size_t>(move.kind)];
    history_.push(prepared_->kinds.levels[static_cast<std::size_t>(move.kind)]);
    if (--left_ > 0)
        return;
    const bool is_last =
        part.in_any_order ? segments_left_ == 0 : segment_ + 1 == static_cast<int>(part.segments.size());
    if (is_last) {
        ++part_;
        enter_part();
    }
}

bool OrderState::may_be_completed() const {
    if (is_complete() || left_ == 0 ||
        prepared_->problem->parts[part_].segments[static_cast<std::size_t>(segment_)].is_drawn())
        return true;
    std::vector<int> left;
    for (const OrderLimit& limit : prepared_->problem->limits) {
        if (limit.part >= 0 && limit.part != part())
            continue;
        const auto factor = static_cast<std::size_t>(limit.factor);
        left.assign(left.size(), 0);
        for (std::size_t kind = 0; kind < counts_.size(); ++kind) {
            const auto level = static_cast<std::size_t>(prepared_->kinds.levels[kind][factor]);
            left.resize(std::max(left.size(), level + 1));
            left[level] += counts_[kind];
        }
        for (std::size_t level = 0; level < left.size(); ++level) {
            if (left[level] == 0)
                continue;
            const int number = static_cast<int>(level);
            if (limit.kind == OrderLimit::Kind::longest_run) {
                // The others leave gaps, each with room for one run; the gap that is open now may be part
                // full.
                const int room = history_.room_in_run(limit.factor, number, limit.amount);
                if (left[level] > limit.amount * (left_ - left[level]) + room)
                    return false;
            } else if (history_.wait(limit.factor, number, part()) + (left[level] - 1) * limit.amount + 1 >
                       left_) {
                return false;
            }
        }
    }
    return true;
}

std::u16string OrderState::key(OrderKeys& keys) const {
    if (is_complete())
        return {};
    const auto bits = [&](int from) { return static_cast<char16_t>(segments_left_ >> from & 0xffff); };
    const std::u16string head{static_cast<char16_t>(part_),
                              static_cast<char16_t>(left_),
                              static_cast<char16_t>(segment_ + 1),
                              bits(0),
                              bits(16),
                              bits(32),
                              bits(48)};
    // Between segments, what will be placed is what roles tell, but for a part of a single segment.
    static const std::vector<int> nothing;
    const auto& segments = prepared_->kinds.counts[part_];
    const std::vector<int>& counts = left_ > 0 ? counts_ : segments.size() == 1 ? segments.front() : nothing;
    return keys.key_of(head, counts, part(), history_);
}

} // namespace overt
