#include "experiment/design/orders/order_draw.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "experiment/base/error.h"
#include "experiment/design/orders/order_counter.h"
#include "experiment/design/orders/order_exchanges.h"
#include "experiment/design/orders/order_guide.h"

namespace overt {

namespace {

constexpr int shuffles = 2000;
// Trials placed at most, in as many tries.
constexpr int more_shuffled_trials = 10'000'000;
constexpr int guided_trials = 1'000'000;
// For each trial that is placed, each kind is looked at as what comes next, and for that all kinds.
constexpr double guided_looks = 64e6;
// More of them where nothing else tells whether there is an order.
constexpr int repairs = 6, last_repairs = 16, repairing_exchanges = 400'000;

/// Shuffles everything again and again.
class Shuffler {
  public:
    explicit Shuffler(const OrderProblem& problem) : parts_(problem.parts) {}

    ItemSequence next(RandomStream& random) {
        ItemSequence sequence;
        for (std::size_t part = 0; part < parts_.size(); ++part) {
            auto& segments = parts_[part].segments;
            if (parts_[part].in_any_order)
                random.shuffle(std::span(segments));
            for (OrderSegment& segment : segments) {
                if (segment.is_drawn()) {
                    for (int i = 0; i < segment.draws; ++i)
                        sequence.items.push_back(draw_by_weight(segment, random));
                } else {
                    if (segment.items.size() > 1)
                        random.shuffle(std::span(segment.items));
                    sequence.items.insert(sequence.items.end(), segment.items.begin(), segment.items.end());
                }
            }
            sequence.parts.resize(sequence.items.size(), static_cast<int>(part));
        }
        return sequence;
    }

  private:
    std::vector<OrderPart> parts_;
};

} // namespace

class OrderDraw::Work {
  public:
    explicit Work(OrderProblem problem) : problem_(std::move(problem)), prepared_(problem_) {}
    Work(const Work&) = delete;

    Existence existence() {
        if (!existence_)
            existence_ = find_existence();
        return *existence_;
    }

    std::optional<DrawnOrder> draw(RandomStream& random) {
        if (std::optional<ItemSequence> shuffled = draw_by_shuffling(random, shuffles))
            return DrawnOrder{*std::move(shuffled)};
        if (existence() == Existence::none)
            return std::nullopt;
        if (count(most_quickly_counted_states))
            return draw_counted(random);
        if (std::optional<ItemSequence> guided = draw_guided(random))
            return DrawnOrder{*std::move(guided)};
        const int more_shuffles = more_shuffled_trials / problem_.length();
        if (std::optional<ItemSequence> shuffled = draw_by_shuffling(random, more_shuffles))
            return DrawnOrder{*std::move(shuffled)};
        if (count(most_counted_states))
            return draw_counted(random);
        std::optional<KindSequence> found = draw_repaired(random, repairs);
        if (!found)
            found = search_renamed(random);
        if (!found && search())
            found = found_;
        if (!found)
            return std::nullopt;
        OrderExchanges exchanges(prepared_, *std::move(found));
        exchanges.exchange_names(random);
        exchanges.mix(random);
        return DrawnOrder{fill_in(prepared_, exchanges.order(), random), OrderEvenness::near};
    }

  private:
    Existence find_existence() {
        RandomStream random(0, "existence of an order");
        if (draw_by_shuffling(random, 200))
            return Existence::exists;
        return search()                                  ? Existence::exists
               : *searched_ == OrderSearch::Answer::none ? Existence::none
                                                         : Existence::unknown;
    }

    std::optional<ItemSequence> draw_by_shuffling(RandomStream& random, int tries) const {
        Shuffler shuffler(problem_);
        for (int attempt = 0; attempt < tries; ++attempt) {
            ItemSequence sequence = shuffler.next(random);
            if (keeps(sequence))
                return sequence;
        }
        return std::nullopt;
    }

    std::optional<DrawnOrder> draw_counted(RandomStream& random) {
        if (count_->is_zero())
            return std::nullopt;
        return DrawnOrder{fill_in(prepared_, counter_->draw(random), random)};
    }

    bool search() {
        if (!searched_) {
            OrderSearch search(prepared_, most_searched_states);
            searched_ = search.find();
            if (searched_ == OrderSearch::Answer::found) {
                found_ = search.order();
            } else if (searched_ == OrderSearch::Answer::too_long) {
                RandomStream random(0, "repair of an order");
                found_ = draw_repaired(random, last_repairs);
            }
        }
        return found_.has_value();
    }

    bool count(std::size_t most_states) {
        if (!counter_ || (!count_ && most_states > counted_states_)) {
            counted_states_ = most_states;
            counter_.emplace(prepared_, most_states);
            count_ = counter_->count();
        }
        return count_.has_value();
    }

    /// One for each limited factor, first what is rarest to be met: the rarer what it gives, the better it
    /// guides.
    std::vector<std::unique_ptr<OrderGuide>>& guides() {
        if (!guides_) {
            guides_.emplace();
            for (const int factor : prepared_.kinds.limited)
                guides_->push_back(
                    std::make_unique<OrderGuide>(problem_, factor, most_quickly_counted_states));
            std::sort(guides_->begin(), guides_->end(),
                      [](const auto& a, const auto& b) { return a->share() < b->share(); });
        }
        return *guides_;
    }

    /// Draws by counting for the limits of one factor, and keeps what keeps to the others as well: exact, and
    /// more often successful than a shuffle.
    std::optional<ItemSequence> draw_guided(RandomStream& random) {
        if (prepared_.kinds.limited.size() < 2 || !guides().front()->is_counted())
            return std::nullopt;
        OrderGuide& guide = *guides().front();
        const double looks = static_cast<double>(guide.kinds()) * guide.kinds();
        const int tries =
            static_cast<int>(std::min<double>(guided_trials, guided_looks / looks)) / problem_.length();
        for (int attempt = 0; attempt < tries; ++attempt) {
            ItemSequence sequence = guide.draw(random);
            if (keeps(sequence))
                return sequence;
        }
        return std::nullopt;
    }

    /// From random orders that keep to the limits of one factor, by exchanges to one that keeps to all.
    std::optional<KindSequence> draw_repaired(RandomStream& random, int attempts) {
        for (int attempt = 0; attempt < attempts; ++attempt) {
            OrderGuide& guide = *guides()[static_cast<std::size_t>(attempt) % guides().size()];
            std::optional<KindSequence> start = guide.start(prepared_, random);
            if (!start)
                continue;
            OrderExchanges exchanges(prepared_, *std::move(start));
            if (exchanges.repair(random, repairing_exchanges))
                return exchanges.order();
        }
        return std::nullopt;
    }

    /// What a search comes to that goes through the levels in random order.
    std::optional<KindSequence> search_renamed(RandomStream& random) const {
        const OrderProblem other = renamed(problem_, random);
        const PreparedProblem prepared(other);
        OrderSearch search(prepared, most_quickly_counted_states);
        if (search.find() != OrderSearch::Answer::found)
            return std::nullopt;
        return in_kinds_of(prepared_, search.order(), fill_in(prepared, search.order(), random));
    }

    bool keeps(const ItemSequence& sequence) const {
        return keeps_to_limits(problem_, prepared_.reach, sequence, 0, sequence.items.size());
    }

    OrderProblem problem_;
    PreparedProblem prepared_;
    std::optional<Existence> existence_;
    std::optional<OrderCounter> counter_;
    std::size_t counted_states_ = 0;
    std::optional<ScaledNumber> count_;
    std::optional<std::vector<std::unique_ptr<OrderGuide>>> guides_;
    std::optional<OrderSearch::Answer> searched_;
    std::optional<KindSequence> found_;
};

OrderDraw::OrderDraw(OrderProblem problem) : work_(std::make_unique<Work>(std::move(problem))) {}
OrderDraw::~OrderDraw() = default;
OrderDraw::OrderDraw(OrderDraw&&) noexcept = default;
OrderDraw& OrderDraw::operator=(OrderDraw&&) noexcept = default;
OrderDraw::Existence OrderDraw::existence() { return work_->existence(); }
std::optional<DrawnOrder> OrderDraw::draw(RandomStream& random) { return work_->draw(random); }

std::optional<LimitConflict> find_limit_conflict(const OrderProblem& problem) {
    const auto existence_with = [&](const std::vector<OrderLimit>& limits) {
        OrderProblem changed = problem;
        changed.limits = limits;
        return OrderDraw(std::move(changed)).existence();
    };
    const OrderDraw::Existence existence = existence_with(problem.limits);
    if (existence == OrderDraw::Existence::exists)
        return std::nullopt;
    LimitConflict conflict{problem.limits, existence == OrderDraw::Existence::none};
    // A single limit is named in preference to several; else each limit in turn is left out for good if
    // there is still no order without it.
    for (const OrderLimit& limit : problem.limits) {
        if (const auto alone = existence_with({limit}); alone == OrderDraw::Existence::none)
            return LimitConflict{{limit}, true};
    }
    for (std::size_t i = 0; i < conflict.limits.size();) {
        std::vector<OrderLimit> others = conflict.limits;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        if (existence_with(others) == existence)
            conflict.limits = std::move(others);
        else
            ++i;
    }
    return conflict;
}

int nearest_possible_amount(const OrderProblem& problem, const OrderLimit& limit) {
    const auto at = static_cast<std::size_t>(std::find(problem.limits.begin(), problem.limits.end(), limit) -
                                             problem.limits.begin());
    OVERT_EXPECTS(at < problem.limits.size());
    const auto exists_with = [&](int amount) {
        OrderProblem changed = problem;
        changed.limits[at].amount = amount;
        return OrderDraw(std::move(changed)).existence() == OrderDraw::Existence::exists;
    };
    if (limit.kind == OrderLimit::Kind::least_distance) {
        // Equal levels cannot be farther apart than the whole is long.
        for (int amount = std::min(limit.amount, problem.length()) - 1; amount > 1; --amount) {
            if (exists_with(amount))
                return amount;
        }
        return 0;
    }
    // Longer runs are never harder: halve the interval between what fails and the whole.
    int fails = limit.amount, whole = problem.length();
    if (!exists_with(whole))
        return 0;
    while (whole - fails > 1) {
        const int middle = fails + (whole - fails) / 2;
        (exists_with(middle) ? whole : fails) = middle;
    }
    return whole;
}

} // namespace overt
