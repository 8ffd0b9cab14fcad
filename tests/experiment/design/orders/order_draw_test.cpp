#include "experiment/design/orders/order_draw.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/design/orders/order_counter.h"
#include "tests/experiment/design/orders/order_problems.h"

using namespace overt;
using namespace overt::test;

namespace {

/// Orders of items for each sequence of kinds: the items of a kind in a segment come in any order.
double items_per_kind_sequence(const OrderProblem& problem, const OrderKinds& kinds) {
    double orders = 1.0;
    for (const auto& part : kinds.counts) {
        for (const std::vector<int>& counts : part) {
            for (const int count : counts)
                orders *= std::tgamma(1.0 + count);
        }
    }
    CHECK(kinds.counts.size() == problem.parts.size());
    return orders;
}

OrderProblem one_segment(std::vector<std::vector<int>> levels, std::vector<OrderLimit> limits) {
    std::vector<int> items(levels.front().size());
    std::iota(items.begin(), items.end(), 0);
    return {std::move(levels), {{{{items, 0, {}}}, false}}, std::move(limits)};
}

/// The same number of items at each of so many levels.
std::vector<int> evenly(int levels, int each) {
    std::vector<int> list;
    for (int i = 0; i < levels * each; ++i)
        list.push_back(i % levels);
    return list;
}

OrderLimit run(int factor, int amount) {
    return {factor, OrderLimit::Kind::longest_run, amount, -1, "run", "level"};
}
OrderLimit distance(int factor, int amount) {
    return {factor, OrderLimit::Kind::least_distance, amount, -1, "distance", "level"};
}

} // namespace

TEST_CASE("orders are counted as trying all of them counts, and exist where they do, in 1000 random problems",
          "[unit]") {
    RandomStream random(7, "order problems");
    int without = 0, wrong_counts = 0, wrong_searches = 0, wrong_answers = 0, broken = 0;
    for (int round = 0; round < 1000; ++round) {
        const OrderProblem problem = random_problem(random);
        const std::set<std::vector<int>> orders = all_orders(problem);
        const PreparedProblem prepared(problem);
        OrderCounter counter(prepared, 100'000);
        const auto count = counter.count();
        REQUIRE(count);
        const double counted = std::ldexp(count->mantissa, static_cast<int>(count->exponent)) *
                               items_per_kind_sequence(problem, prepared.kinds);
        wrong_counts += counted != static_cast<double>(orders.size());
        OrderSearch search(prepared, 100'000);
        const bool is_found = search.find() == OrderSearch::Answer::found;
        wrong_searches += is_found != !orders.empty();
        OrderDraw draw(problem);
        wrong_answers += (draw.existence() == OrderDraw::Existence::exists) != !orders.empty();
        const auto drawn = draw.draw(random);
        wrong_answers += drawn.has_value() != !orders.empty();
        broken += drawn && !orders.contains(drawn->sequence.items);
        without += orders.empty();
    }
    CHECK(wrong_counts == 0);
    CHECK(wrong_searches == 0);
    CHECK(wrong_answers == 0);
    CHECK(broken == 0);
    CHECK(without > 100); // both answers occur
    CHECK(without < 900);
}

TEST_CASE("orders drawn by counting are equally probable, segments in any order among them", "[unit]") {
    RandomStream random(11, "uniform orders");
    int tested = 0;
    while (tested < 20) {
        const OrderProblem problem = random_problem(random);
        const std::set<std::vector<int>> orders = all_orders(problem);
        const PreparedProblem prepared(problem);
        OrderCounter counter(prepared, 100'000);
        if (!counter.count() || orders.size() < 2)
            continue;
        // By kinds: each sequence of kinds stands for the same number of orders.
        std::map<std::vector<int>, int> drawn;
        std::set<std::vector<int>> sequences;
        for (const std::vector<int>& order : orders) {
            std::vector<int> kinds;
            for (const int item : order)
                kinds.push_back(prepared.kinds.kind_of_item[static_cast<std::size_t>(item)]);
            sequences.insert(kinds);
        }
        if (sequences.size() < 2 || sequences.size() > 60)
            continue;
        // Where segments come in any order, the same kinds can come in several ways: leave these out.
        const double ways =
            std::ldexp(counter.count()->mantissa, static_cast<int>(counter.count()->exponent));
        if (ways != static_cast<double>(sequences.size()))
            continue;
        ++tested;
        const int rounds = 50 * static_cast<int>(sequences.size());
        for (int round = 0; round < rounds; ++round) {
            std::vector<int> kinds;
            for (const KindSequence::Place& place : counter.draw(random).places)
                kinds.push_back(place.kind);
            ++drawn[kinds];
        }
        double chi_square = 0.0;
        for (const std::vector<int>& sequence : sequences)
            chi_square += std::pow(drawn[sequence] - 50.0, 2) / 50.0;
        const double freedom = static_cast<double>(sequences.size()) - 1.0;
        // Normal approximation of Wilson and Hilferty; one problem in 30,000 goes beyond four deviations.
        const double deviation = (std::cbrt(chi_square / freedom) - (1.0 - 2.0 / (9.0 * freedom))) /
                                 std::sqrt(2.0 / (9.0 * freedom));
        CHECK(drawn.size() == sequences.size());
        CHECK(deviation < 4.0);
    }
}

TEST_CASE("draws with replacement come with the probability of their weights, given the limits", "[unit]") {
    OrderProblem problem{{{0, 1, 2}}, {{{{{0, 1, 2}, 4, {3.0, 2.0, 1.0}}}, false}}, {run(0, 1)}};
    std::map<std::vector<int>, double> expected;
    double all = 0.0;
    for_each_sequence(problem, [&](const ItemSequence& sequence) {
        if (!keeps_to_limits(problem, sequence))
            return;
        double weight = 1.0;
        for (const int item : sequence.items)
            weight *= 3.0 - item;
        expected[sequence.items] += weight;
        all += weight;
    });
    CHECK(expected.size() == 3 * 2 * 2 * 2);
    // By shuffling, as OrderDraw begins, and by counting.
    const PreparedProblem prepared(problem);
    OrderCounter counter(prepared, 1000);
    REQUIRE(counter.count());
    OrderDraw draw(problem);
    RandomStream random(3, "weighted draws");
    constexpr int rounds = 24'000;
    std::map<std::vector<int>, int> shuffled, counted;
    for (int round = 0; round < rounds; ++round) {
        ++shuffled[draw.draw(random)->sequence.items];
        std::vector<int> kinds;
        for (const KindSequence::Place& place : counter.draw(random).places)
            kinds.push_back(place.kind); // items and kinds are the same here
        ++counted[kinds];
    }
    for (const auto& drawn : {shuffled, counted}) {
        double chi_square = 0.0;
        for (const auto& [sequence, weight] : expected) {
            const double mean = rounds * weight / all;
            const auto found = drawn.find(sequence);
            chi_square += std::pow((found == drawn.end() ? 0 : found->second) - mean, 2) / mean;
        }
        CHECK(chi_square < 49.7); // 99.9 % point for 23 degrees of freedom
    }
}

TEST_CASE("what no shuffle finds is drawn by counting, or through the limits of one factor, and is kept to",
          "[unit]") {
    // Nine levels eight times each, never nearer than nine: 9! orders of levels in 10^63.
    const OrderProblem strict = one_segment({evenly(9, 8)}, {distance(0, 9)});
    RandomStream random(1, "strict orders");
    std::set<std::vector<int>> different;
    OrderDraw draw(strict);
    for (int round = 0; round < 50; ++round) {
        const auto order = draw.draw(random);
        REQUIRE(order);
        CHECK(order->evenness == OrderEvenness::exact);
        CHECK(keeps_to_limits(strict, order->sequence));
        different.insert(order->sequence.items);
    }
    CHECK(different.size() == 50);

    // Six tasks for three sculptures, neither ever twice in a row: too many places to count.
    std::vector<int> tasks, objects;
    for (int i = 0; i < 30; ++i) {
        tasks.push_back(i < 9 ? 0 : i < 18 ? 1 : 2 + i % 4);
        objects.push_back(i % 3);
    }
    const OrderProblem both = one_segment({tasks, objects}, {run(0, 1), run(1, 1)});
    const auto order = OrderDraw(both).draw(random);
    REQUIRE(order);
    CHECK(order->evenness == OrderEvenness::exact);
    CHECK(keeps_to_limits(both, order->sequence));
}

TEST_CASE(
    "where orders can be neither counted nor met by chance, search and exchanges still keep to the limits",
    "[unit]") {
    const OrderProblem problem = one_segment({evenly(9, 8)}, {distance(0, 5), run(0, 1)});
    OrderDraw draw(problem);
    RandomStream random(1, "hard orders");
    const auto order = draw.draw(random);
    REQUIRE(order);
    CHECK(keeps_to_limits(problem, order->sequence));
    std::vector<int> items = order->sequence.items;
    std::sort(items.begin(), items.end());
    for (int item = 0; item < 72; ++item)
        CHECK(items[static_cast<std::size_t>(item)] == item);
}

/// So many objects, materials and tasks, each combination once.
std::vector<std::vector<int>> crossed(int objects, int materials, int tasks) {
    std::vector<std::vector<int>> levels(3);
    for (int item = 0; item < objects * materials * tasks; ++item) {
        levels[0].push_back(item % objects);
        levels[1].push_back(item / objects % materials);
        levels[2].push_back(item / (objects * materials));
    }
    return levels;
}

TEST_CASE("limits that leave hardly any room give each seed an order of its own", "[unit]") {
    const OrderProblem problem = one_segment(crossed(6, 4, 2), {distance(0, 5), distance(1, 3), run(2, 1)});
    OrderDraw draw(problem);
    std::vector<std::vector<int>> orders;
    std::set<int> first_levels;
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        RandomStream random(seed, "tight orders");
        const auto order = draw.draw(random);
        REQUIRE(order);
        CHECK(order->evenness == OrderEvenness::near);
        CHECK(keeps_to_limits(problem, order->sequence));
        orders.push_back(order->sequence.items);
        first_levels.insert(problem.levels[0][static_cast<std::size_t>(order->sequence.items[0])]);
    }
    CHECK(first_levels.size() > 1);
    for (std::size_t a = 0; a < orders.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            int equal = 0;
            for (std::size_t place = 0; place < orders[a].size(); ++place)
                equal += orders[a][place] == orders[b][place] ? 1 : 0;
            CHECK(equal < 24); // of 48; a twelfth and less where nothing is amiss
        }
    }
}

TEST_CASE("an order that a search from the front does not come to is found by exchanges", "[unit]") {
    const OrderProblem problem =
        one_segment(crossed(4, 4, 4), {distance(0, 4), distance(1, 3), distance(2, 2)});
    const PreparedProblem prepared(problem);
    CHECK(OrderSearch(prepared, 20'000).find() == OrderSearch::Answer::too_long);
    OrderDraw draw(problem);
    CHECK(draw.existence() == OrderDraw::Existence::exists);
    RandomStream random(1, "exchanges");
    const auto order = draw.draw(random);
    REQUIRE(order);
    CHECK(keeps_to_limits(problem, order->sequence));
}

TEST_CASE("two thousand trials of as many kinds are searched through, not waited for", "[unit]") {
    // Each place looks at its kinds once, not once for each kind: what took minutes takes a second.
    const OrderProblem problem = one_segment(crossed(100, 20, 1), {run(0, 1), run(1, 1), distance(0, 50)});
    RandomStream random(1, "large orders");
    const auto order = OrderDraw(problem).draw(random);
    REQUIRE(order);
    CHECK(keeps_to_limits(problem, order->sequence));
}

TEST_CASE("limits that no order keeps to are named, as few of them as are needed for that", "[unit]") {
    RandomStream random(5, "conflicts");
    int single = 0, several = 0;
    for (int round = 0; round < 600; ++round) {
        const OrderProblem problem = random_problem(random);
        const auto conflict = find_limit_conflict(problem);
        REQUIRE(conflict.has_value() == all_orders(problem).empty());
        if (!conflict)
            continue;
        CHECK(conflict->is_proved);
        (conflict->limits.size() == 1 ? single : several) += 1;
        OrderProblem named = problem;
        named.limits = conflict->limits;
        CHECK(all_orders(named).empty());
        for (std::size_t i = 0; i < conflict->limits.size(); ++i) {
            named.limits = conflict->limits;
            named.limits.erase(named.limits.begin() + static_cast<std::ptrdiff_t>(i));
            CHECK_FALSE(all_orders(named).empty());
        }
    }
    CHECK(single > 50);
    CHECK(several > 3);
}

TEST_CASE("the nearest amount with which there is an order is the nearest", "[unit]") {
    // Nine of twelve alike: three others leave four gaps.
    const OrderProblem runs = one_segment({{0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1}}, {run(0, 1)});
    CHECK(nearest_possible_amount(runs, runs.limits[0]) == 3);
    // Three levels four times each can be three apart, no more.
    const OrderProblem apart = one_segment({evenly(3, 4)}, {distance(0, 7)});
    CHECK(nearest_possible_amount(apart, apart.limits[0]) == 3);
    const OrderProblem same = one_segment({{0, 0, 0}}, {distance(0, 2)});
    CHECK(nearest_possible_amount(same, same.limits[0]) == 0);
}
