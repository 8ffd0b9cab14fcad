#include "experiment/design/observer_groups.h"

#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/design/schedule.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

Protocol with_caps(const std::vector<int>& caps) {
    Protocol protocol;
    for (const int cap : caps) {
        GroupSettings group;
        group.id = "g" + std::to_string(protocol.groups.size());
        group.cap = cap;
        protocol.groups.push_back(group);
    }
    return protocol;
}

} // namespace

TEST_CASE("observers fill all groups to their caps, none twice the same place, as one by one would",
          "[unit]") {
    RandomStream random(1, "caps");
    for (int round = 0; round < 300; ++round) {
        std::vector<int> caps(1 + random.below(5));
        int all = 0;
        for (int& cap : caps)
            all += cap = 1 + static_cast<int>(random.below(9));
        const Protocol protocol = with_caps(caps);
        CHECK(group_capacity(protocol) == all);
        std::vector<int> taken(caps.size());
        std::size_t next = 0;
        for (int number = 1; number <= all; ++number) {
            while (taken[next % caps.size()] == caps[next % caps.size()])
                ++next;
            const auto group = next++ % caps.size();
            const GroupPlace place = group_place(protocol, number);
            REQUIRE(place.group == static_cast<int>(group));
            REQUIRE(place.row == taken[group]++);
        }
        CHECK(taken == caps);
        CHECK_THROWS_AS(group_place(protocol, all + 1), InputError);
    }
}

TEST_CASE("a group without a cap takes all who are left", "[unit]") {
    const Protocol protocol = with_caps({2, 0});
    CHECK_FALSE(group_capacity(protocol));
    CHECK(group_place(protocol, 3).group == 0);
    for (int number = 5; number < 50; ++number) {
        CHECK(group_place(protocol, number).group == 1);
        CHECK(group_place(protocol, number).row == number - 3);
    }
    CHECK(group_place(protocol, 999'999'999).row == 999'999'996);
    CHECK(group_place(Protocol{}, 7).group == -1);
    CHECK(group_place(Protocol{}, 7).row == 6);
}

TEST_CASE("groups see what they are to see, and an observer beyond the caps is refused by all numbers",
          "[unit]") {
    const std::string text =
        text_of_file(source_path("protocols/overt_2019.toml")) +
        "[[group]]\nid = \"gold\"\nmaterials = [\"smooth\", \"rough\"]\ncap = 6\n"
        "[[group]]\nid = \"coat\"\nmaterials = [\"coated\"]\ntasks = [\"free\", \"age\"]\ncap = 6\n";
    const ReadText read(text);
    CAPTURE(read.diagnostics.print());
    REQUIRE(read.protocol);
    std::map<std::tuple<int, int, int>, int> cells;
    for (int number = 1; number <= 12; ++number) {
        const bool is_gold = number % 2 == 1;
        const Schedule schedule = make_schedule(*read.protocol, {"P", number}, 3);
        CHECK(schedule.trials.size() == (is_gold ? 2 * 6 + 4 * 3 : 3 + 3));
        for (const Trial& trial : schedule.trials) {
            CHECK((trial.stimulus.material == 2) == !is_gold);
            if (!is_gold)
                CHECK((trial.task == 0 || trial.task == 2));
            ++cells[{trial.task, trial.stimulus.object, trial.stimulus.material}];
        }
    }
    // The rotation goes round within the group: six observers of two materials, three each.
    CHECK(cells[{3, 0, 0}] == 3);
    CHECK(cells[{3, 0, 1}] == 3);
    CHECK_THROWS_WITH(make_schedule(*read.protocol, {"P", 13}, 3),
                      Catch::Contains("observer number 13 is beyond the caps") &&
                          Catch::Contains("take 12 (gold 6, coat 6)"));
}

TEST_CASE("whatever groups, blocks and orders leave of each other, observers have an order of it or the "
          "protocol is refused",
          "[unit]") {
    const std::vector<std::string> groups{"", "materials = [\"smooth\"]\n",
                                          "materials = [\"coated\", \"rough\"]\n", "objects = [\"runner\"]\n",
                                          "tasks = [\"age\", \"free\"]\n"},
        scopes{"", "materials = [\"smooth\"]\n", "objects = [\"muse\", \"runner\"]\n", "tasks = [\"age\"]\n",
               "stimuli = \"once-per-object\"\n"},
        orders{"order = \"random\"\n",
               "order = \"sequential\"\n",
               "order = \"blocked\"\nby = \"material\"\nlevels = \"balanced\"\n",
               "order = \"blocked\"\nby = \"task\"\nlevels = \"random-square\"\n",
               "order = \"weighted\"\nby = \"object\"\nweights = [2, 1, 1]\n",
               "order = \"weighted\"\nby = \"material\"\nweights = [2, 1, 1]\ndraws = 7\n"};
    const std::string paper = text_of_file(source_path("protocols/overt_2019.toml"));
    int refused = 0, ordered = 0;
    for (const std::string& group : groups)
        for (const std::string& scope : scopes)
            for (const std::string& order : orders) {
                const std::string text = paper + "[[group]]\nid = \"all\"\n[[group]]\nid = \"some\"\n" +
                                         group + "[[block]]\nid = \"one\"\n" + scope + order;
                const ReadText read(text);
                CAPTURE(group, scope, order, read.diagnostics.print());
                if (!read.protocol) {
                    CHECK(read.diagnostics.has_errors());
                    ++refused;
                    continue;
                }
                ++ordered;
                for (int number = 1; number <= 4; ++number) {
                    const auto trials = make_schedule(*read.protocol, {"P", number}, 3).trials;
                    REQUIRE_FALSE(trials.empty());
                    for (const Trial& trial : trials) {
                        if (scope.starts_with("materials") ||
                            (number % 2 == 0 && group.find("smooth") != std::string::npos))
                            REQUIRE(trial.stimulus.material == 0);
                        if (number % 2 == 0 && group.find("coated") != std::string::npos)
                            REQUIRE(trial.stimulus.material != 0);
                    }
                }
            }
    CHECK(refused > 5);
    CHECK(ordered > 50);
}

TEST_CASE("practice with what a group does not see is warned of", "[unit]") {
    const std::string clay = "[[material]]\nid = \"clay\"\nkind = \"diffuse\"\n";
    const std::string groups = "[[group]]\nid = \"g\"\nmaterials = [\"gold\"]\n[[group]]\nid = \"c\"\n";
    const auto print = [&](const std::string& material) {
        return ReadText(minimal_protocol, clay + groups +
                                              "[[practice]]\ntask = \"free\"\nobject = \"a\"\nmaterial = \"" +
                                              material + "\"\n")
            .diagnostics.print();
    };
    CHECK_THAT(print("clay"), Catch::Contains("group \"g\" practises with the material \"clay\""));
    CHECK_THAT(print("gold"), !Catch::Contains("practises"));
}
