#include "experiment/design/order_draw.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "experiment/design/order_counter.h"
#include "experiment/error.h"

namespace overt {

namespace {

constexpr int shuffles = 2000;
// Trials placed at most, in as many tries.
constexpr int more_shuffled_trials = 10'000'000;
constexpr int guided_trials = 1'000'000;

int draw_by_weight(const OrderSegment& segment, RandomStream& random) {
    double chance = random.uniform() * std::accumulate(segment.weights.begin(), segment.weights.end(), 0.0);
    int last = -1;
    for (std::size_t i = 0; i < segment.items.size(); ++i) {
        if (segment.weights[i] <= 0.0)
            continue;
        last = segment.items[i];
        if ((chance -= segment.weights[i]) < 0.0)
            break;
    }
    return last;
}

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

/// Items for a sequence of kinds: those of a kind come in random order.
ItemSequence fill_in(const PreparedProblem& prepared, const KindSequence& order, RandomStream& random) {
    const OrderProblem& problem = *prepared.problem;
    std::vector<std::vector<std::vector<std::vector<int>>>> waiting(problem.parts.size());
    for (std::size_t part = 0; part < problem.parts.size(); ++part) {
        for (const OrderSegment& segment : problem.parts[part].segments) {
            auto& kinds = waiting[part].emplace_back(static_cast<std::size_t>(prepared.kinds.count));
            for (const int item : segment.items)
                kinds[static_cast<std::size_t>(prepared.kinds.kind_of_item[static_cast<std::size_t>(item)])]
                    .push_back(item);
            if (!segment.is_drawn()) {
                for (std::vector<int>& items : kinds) {
                    if (items.size() > 1)
                        random.shuffle(std::span(items));
                }
            }
        }
    }
    ItemSequence sequence;
    for (const KindSequence::Place& place : order.places) {
        const auto part = static_cast<std::size_t>(place.part),
                   segment = static_cast<std::size_t>(place.segment);
        const OrderSegment& from = problem.parts[part].segments[segment];
        std::vector<int>& items = waiting[part][segment][static_cast<std::size_t>(place.kind)];
        if (from.is_drawn()) {
            OrderSegment of_kind;
            for (std::size_t i = 0; i < from.items.size(); ++i) {
                if (prepared.kinds.kind_of_item[static_cast<std::size_t>(from.items[i])] == place.kind) {
                    of_kind.items.push_back(from.items[i]);
                    of_kind.weights.push_back(from.weights[i]);
                }
            }
            sequence.items.push_back(draw_by_weight(of_kind, random));
        } else {
            sequence.items.push_back(items.back());
            items.pop_back();
        }
        sequence.parts.push_back(place.part);
    }
    return sequence;
}

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
        if (!search())
            return std::nullopt;
        DrawnOrder order{fill_in(prepared_, *found_, random), OrderEvenness::near};
        mix(order.sequence, random);
        return order;
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
            if (searched_ == OrderSearch::Answer::found)
                found_ = search.order();
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

    /// Draws by counting for the limits of one factor, and keeps what keeps to the others as well: exact, and
    /// more often successful than a shuffle.
    std::optional<ItemSequence> draw_guided(RandomStream& random) {
        if (prepared_.kinds.limited.size() < 2)
            return std::nullopt;
        if (!guides_) {
            guides_.emplace();
            for (const int factor : prepared_.kinds.limited)
                guides_->push_back(std::make_unique<Guide>(problem_, factor));
            // The rarer what it gives, the better it guides.
            std::sort(guides_->begin(), guides_->end(),
                      [](const auto& a, const auto& b) { return a->share() < b->share(); });
        }
        if (guides_->empty() || !guides_->front()->ways || guides_->front()->ways->is_zero())
            return std::nullopt;
        Guide& guide = *guides_->front();
        for (int attempt = 0; attempt < guided_trials / problem_.length(); ++attempt) {
            ItemSequence sequence = fill_in(guide.prepared, guide.counter.draw(random), random);
            if (keeps(sequence))
                return sequence;
        }
        return std::nullopt;
    }

    /// Exchanges random pairs within their segments where the limits allow it. Each exchange is as probable
    /// as its reverse, so that the chain ends at every order that it reaches with equal probability
    /// (Metropolis et al. 1953).
    void mix(ItemSequence& sequence, RandomStream& random) const {
        std::vector<std::pair<std::size_t, std::size_t>> stretches;
        std::size_t begin = 0;
        for (const KindSequence::Place* place = found_->places.data(); begin < found_->places.size();
             place = found_->places.data() + begin) {
            std::size_t end = begin;
            while (end < found_->places.size() && found_->places[end].part == place->part &&
                   found_->places[end].segment == place->segment)
                ++end;
            stretches.emplace_back(begin, end);
            begin = end;
        }
        for (const auto& [first, end] : stretches) {
            const auto length = static_cast<std::uint32_t>(end - first);
            const double steps = 40.0 * length * std::log2(2.0 + length);
            for (double step = 0.0; length > 1 && step < steps; ++step) {
                const std::size_t a = first + random.below(length), b = first + random.below(length);
                std::swap(sequence.items[a], sequence.items[b]);
                if (!keeps_near(sequence, a) || !keeps_near(sequence, b))
                    std::swap(sequence.items[a], sequence.items[b]);
            }
        }
    }

    /// Whether no limit is broken with the item of this place: none looks farther than its amount.
    bool keeps_near(const ItemSequence& sequence, std::size_t place) const {
        std::size_t reach = 0;
        for (const OrderLimit& limit : problem_.limits)
            reach = std::max(reach, static_cast<std::size_t>(limit.amount));
        const std::size_t begin = place - std::min(place, reach);
        const std::size_t end = std::min(sequence.items.size(), place + reach + 1);
        return keeps_to_limits(problem_, prepared_.reach, sequence, begin, end);
    }

    bool keeps(const ItemSequence& sequence) const {
        return keeps_to_limits(problem_, prepared_.reach, sequence, 0, sequence.items.size());
    }

    /// The problem with the limits of one factor only.
    struct Guide {
        Guide(const OrderProblem& whole, int factor)
            : problem(restricted(whole, factor)), prepared(problem),
              counter(prepared, most_quickly_counted_states), ways(counter.count()) {}
        static OrderProblem restricted(OrderProblem problem, int factor) {
            std::erase_if(problem.limits, [&](const OrderLimit& limit) { return limit.factor != factor; });
            return problem;
        }
        /// Logarithm of the share of all orders; infinite if it could not be counted.
        double share() const {
            if (!ways)
                return INFINITY;
            double all = 0.0;
            for (const auto& part : prepared.kinds.counts) {
                for (const std::vector<int>& counts : part) {
                    all += std::lgamma(1.0 + std::accumulate(counts.begin(), counts.end(), 0));
                    for (const int count : counts)
                        all -= std::lgamma(1.0 + count);
                }
            }
            return ways->is_zero() ? -INFINITY : ways->log() - all;
        }
        OrderProblem problem;
        PreparedProblem prepared;
        OrderCounter counter;
        std::optional<ScaledNumber> ways;
    };

    OrderProblem problem_;
    PreparedProblem prepared_;
    std::optional<Existence> existence_;
    std::optional<OrderCounter> counter_;
    std::size_t counted_states_ = 0;
    std::optional<ScaledNumber> count_;
    std::optional<std::vector<std::unique_ptr<Guide>>> guides_;
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
