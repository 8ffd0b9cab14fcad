#include "experiment/design/schedule.h"

#include <algorithm>
#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

/// Longest run of trials with the same value.
template <class Value> int longest_run(const Schedule& schedule, Value value) {
    int longest = 0, run = 0;
    for (std::size_t i = 0; i < schedule.trials.size(); ++i) {
        const bool goes_on = i > 0 && value(schedule.trials[i]) == value(schedule.trials[i - 1]);
        run = goes_on ? run + 1 : 1;
        longest = std::max(longest, run);
    }
    return longest;
}

int object_run(const Schedule& schedule) {
    return longest_run(schedule, [](const Trial& trial) { return trial.stimulus.object; });
}
int task_run(const Schedule& schedule) {
    return longest_run(schedule, [](const Trial& trial) { return trial.task; });
}

/// A protocol of so many objects and materials, with tasks of both kinds.
Protocol design(int objects, int materials, int every_tasks, int once_tasks) {
    Protocol protocol;
    protocol.objects.resize(static_cast<std::size_t>(objects));
    protocol.materials.resize(static_cast<std::size_t>(materials));
    protocol.tasks.resize(static_cast<std::size_t>(every_tasks + once_tasks));
    for (int task = every_tasks; task < every_tasks + once_tasks; ++task)
        protocol.tasks[static_cast<std::size_t>(task)].stimuli = TaskCoverage::once_per_object;
    return protocol;
}

/// The materials that an observer has under tasks that are asked once per object: by task and object.
std::map<std::pair<int, int>, int> rotated_materials(const Protocol& protocol, int observer) {
    std::map<std::pair<int, int>, int> materials;
    for (const Trial& trial : trials_of(protocol, observer))
        materials[{trial.task, trial.stimulus.object}] = trial.stimulus.material;
    return materials;
}

/// A name for an order of trials.
std::vector<int> key_of(const Schedule& schedule) {
    std::vector<int> key;
    for (const Trial& trial : schedule.trials)
        key.push_back(100 * trial.task + 10 * trial.stimulus.object + trial.stimulus.material);
    return key;
}

} // namespace

TEST_CASE("the schedule shows each stimulus once under the first two tasks, 18 of 30 trials", "[unit]") {
    const Protocol protocol = paper_protocol();
    std::set<std::vector<int>> orders;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const int number = static_cast<int>(seed % 12) + 1;
        const Schedule schedule = make_schedule(protocol, {"P", number}, seed);
        REQUIRE(schedule.trials.size() == 30);
        std::map<int, std::set<Stimulus>> stimuli;
        std::map<int, std::set<int>> objects;
        for (std::size_t i = 0; i < schedule.trials.size(); ++i) {
            REQUIRE(schedule.trials[i].index == static_cast<int>(i));
            stimuli[schedule.trials[i].task].insert(schedule.trials[i].stimulus);
            objects[schedule.trials[i].task].insert(schedule.trials[i].stimulus.object);
        }
        for (int task = 0; task < 6; ++task) {
            REQUIRE(stimuli[task].size() == (task < 2 ? 9 : 3));
            REQUIRE(objects[task].size() == 3);
        }
        REQUIRE(object_run(schedule) <= 2);
        orders.insert(key_of(schedule));
    }
    CHECK(orders.size() == 1000);
}

TEST_CASE("the same seed and observer give the same order, whatever the label", "[unit]") {
    const Protocol protocol = paper_protocol();
    const Schedule first = make_schedule(protocol, {"P07", 7}, 42);
    CHECK(first.trials == make_schedule(protocol, {"seven", 7}, 42).trials);
    CHECK(key_of(first) != key_of(make_schedule(protocol, {"P10", 10}, 42)));
    CHECK(first.seed == 42);
    CHECK(first.observer.label == "P07");
}

TEST_CASE("twelve observers fill every cell of the rotated tasks four times", "[unit]") {
    const Protocol protocol = paper_protocol();
    std::map<std::tuple<int, int, int>, int> cells;
    for (int observer = 1; observer <= 12; ++observer) {
        for (const Trial& trial : make_schedule(protocol, {"P", observer}, 1).trials)
            ++cells[{trial.task, trial.stimulus.object, trial.stimulus.material}];
    }
    CHECK(cells.size() == 54);
    for (const auto& [cell, count] : cells)
        CHECK(count == (std::get<0>(cell) < 2 ? 12 : 4));
}

TEST_CASE("any run of M observers fills each cell of a rotated task once, for any numbers of things",
          "[unit]") {
    constexpr int tasks = 7;
    for (int objects = 1; objects <= 6; ++objects) {
        for (int materials = 1; materials <= 6; ++materials) {
            std::map<std::pair<int, int>, std::set<int>> seen;
            for (int observer = 5; observer < 5 + materials; ++observer)
                for (const auto& [cell, material] :
                     rotated_materials(design(objects, materials, 0, tasks), observer))
                    seen[cell].insert(material);
            REQUIRE(static_cast<int>(seen.size()) == tasks * objects);
            for (const auto& [cell, of_cell] : seen)
                REQUIRE(static_cast<int>(of_cell.size()) == materials);
        }
    }
}

TEST_CASE("each observer sees all materials equally often, to one, under the rotated tasks", "[unit]") {
    for (int objects = 1; objects <= 6; ++objects) {
        for (int materials = 1; materials <= 6; ++materials) {
            for (int tasks = 1; tasks <= 7; ++tasks) {
                std::vector<int> count(static_cast<std::size_t>(materials));
                for (const auto& [cell, material] :
                     rotated_materials(design(objects, materials, 0, tasks), 3))
                    ++count[static_cast<std::size_t>(material)];
                const auto [least, most] = std::minmax_element(count.begin(), count.end());
                REQUIRE(*most - *least <= 1);
            }
        }
    }
}

TEST_CASE("an object changes its material from one rotated task to the next", "[unit]") {
    for (int observer = 1; observer <= 12; ++observer) {
        const auto materials = rotated_materials(design(3, 3, 0, 4), observer);
        for (int task = 0; task + 1 < 4; ++task) {
            for (int object = 0; object < 3; ++object)
                CHECK(materials.at({task, object}) != materials.at({task + 1, object}));
        }
    }
}

TEST_CASE("all orders that keep to the limits are equally probable", "[unit]") {
    // Two objects in two materials: 24 orders, of which 8 alternate between the objects.
    Protocol protocol = design(2, 2, 1, 0);
    protocol.schedule.max_object_run = 1;
    std::map<std::vector<int>, int> counts;
    for (std::uint64_t seed = 0; seed < 8000; ++seed)
        ++counts[key_of(make_schedule(protocol, {"P", 1}, seed))];
    CHECK(counts.size() == 8);
    double chi_square = 0.0;
    for (const auto& [order, count] : counts)
        chi_square += (count - 1000.0) * (count - 1000.0) / 1000.0;
    CHECK(chi_square < 24.3); // 99.9 % point for 7 degrees of freedom
}

TEST_CASE("limits too tight for rejection are kept, and the orders are still many and even", "[unit]") {
    // 15 trials of each of two objects in strict alternation: 2 orders of objects in 155 million.
    Protocol protocol = design(2, 5, 3, 0);
    protocol.schedule.max_object_run = 1;
    protocol.schedule.max_task_run = 2;
    std::set<std::vector<int>> orders;
    int begins_with_first = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const Schedule schedule = make_schedule(protocol, {"P", 1}, seed);
        REQUIRE(object_run(schedule) == 1);
        REQUIRE(task_run(schedule) <= 2);
        orders.insert(key_of(schedule));
        begins_with_first += schedule.trials.front().task == 0 ? 1 : 0;
    }
    CHECK(orders.size() == 40);
    CHECK(begins_with_first > 3);
    CHECK(begins_with_first < 25);
}

TEST_CASE("both limits hold together", "[unit]") {
    Protocol protocol = paper_protocol();
    protocol.schedule.max_object_run = 1;
    protocol.schedule.max_task_run = 1;
    ScheduleMaker maker(protocol);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Schedule schedule = maker.make({"P", 2}, seed);
        CHECK(object_run(schedule) == 1);
        CHECK(task_run(schedule) == 1);
    }
}

TEST_CASE("a limit that no order can keep to is refused by its name", "[unit]") {
    Protocol protocol = design(3, 3, 1, 1); // nine trials of one task, three of the other
    protocol.schedule.max_task_run = 2;
    CHECK_THROWS_WITH(make_schedule(protocol, {"P", 1}, 1),
                      Catch::Contains("schedule.max_task_run") && Catch::Contains("runs of 3 at least"));
    CHECK(find_order_conflict(protocol)->keys.front() == "schedule.max_task_run");
    protocol.schedule.max_task_run = 3;
    CHECK_FALSE(find_order_conflict(protocol));
    CHECK(task_run(make_schedule(protocol, {"P", 1}, 1)) <= 3);
}

TEST_CASE("limits that exclude each other only together are refused as well", "[unit]") {
    Protocol protocol = design(2, 1, 2, 0);
    protocol.schedule.max_object_run = 1;
    protocol.schedule.max_task_run = 1;
    // Either limit alone can be kept. Both: after task 0 with object 0 only task 1 with object 1 may
    // come, and after that nothing but the first again.
    CHECK_THROWS_AS(make_schedule(protocol, {"P", 1}, 1), InputError);
    CHECK(find_order_conflict(protocol));
}

TEST_CASE("a limit on the only object or the only task has no effect", "[unit]") {
    Protocol protocol = design(1, 4, 1, 0);
    protocol.schedule.max_object_run = 1;
    protocol.schedule.max_task_run = 1;
    CHECK(make_schedule(protocol, {"P", 1}, 1).trials.size() == 4);
    CHECK_FALSE(find_order_conflict(protocol));
}

TEST_CASE("the number of an observer is what stands at the end of the label", "[unit]") {
    CHECK(observer_number("P07") == 7);
    CHECK(observer_number("12") == 12);
    CHECK(observer_number("lab2-130") == 130);
    CHECK_FALSE(observer_number("pilot"));
    CHECK_FALSE(observer_number("P00"));
    CHECK_FALSE(observer_number(""));
    CHECK_FALSE(observer_number("7a"));
    CHECK_FALSE(observer_number("P12345678901234567890"));
    CHECK(observer_number("P000000000012") == 12);
}
