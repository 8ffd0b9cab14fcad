#include "experiment/design/rotation.h"

#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/checks/rotation_balance.h"
#include "experiment/design/schedule.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

/// Two materials, two blocks of two tasks in square order, the blocks themselves in square order.
Protocol three_factors(int observers) {
    Protocol protocol;
    protocol.materials.resize(2);
    protocol.materials[0].id = "gold";
    protocol.materials[1].id = "clay";
    protocol.objects.resize(1);
    protocol.objects.front().id = "muse";
    for (const char* const id : {"age", "mood", "look"})
        protocol.tasks.push_back({id, "?", TaskCoverage::once_per_object});
    protocol.schedule.observers = observers;
    protocol.schedule.max_object_run = 0;
    protocol.schedule.block_order = LevelOrder::balanced;
    protocol.blocks.resize(2);
    protocol.blocks[0].id = "questions";
    protocol.blocks[0].tasks = {"age", "mood"};
    protocol.blocks[0].order = OrderMethod::blocked;
    protocol.blocks[0].levels = LevelOrder::balanced;
    protocol.blocks[1].id = "free";
    protocol.blocks[1].tasks = {"look"};
    return protocol;
}

/// What an observer's session shows of the three factors: material of the first task, which block comes
/// first, which task comes first in its block.
std::vector<int> seen(const Schedule& schedule) {
    std::vector<int> bits{-1, schedule.trials.front().block, -1};
    for (const Trial& trial : schedule.trials) {
        if (trial.task == 0)
            bits[0] = trial.stimulus.material;
        if (trial.block == 0 && bits[2] < 0)
            bits[2] = trial.task;
    }
    return bits;
}

Protocol random_design(RandomStream& random) {
    Protocol protocol;
    const auto some = [&](int most) {
        return 1 + static_cast<int>(random.below(static_cast<unsigned>(most)));
    };
    const LevelOrder squares[] = {LevelOrder::cyclic, LevelOrder::balanced, LevelOrder::random_square};
    const SquareKind kinds[] = {SquareKind::cyclic, SquareKind::balanced, SquareKind::random_square};
    for (int i = some(4); i > 0; --i)
        protocol.materials.emplace_back().id = "m" + std::to_string(i);
    protocol.objects.resize(static_cast<std::size_t>(some(2)));
    for (std::size_t i = 0; i < protocol.objects.size(); ++i)
        protocol.objects[i].id = "s" + std::to_string(i);
    for (int i = some(3); i > 0; --i)
        protocol.tasks.push_back(
            {"t" + std::to_string(i), "?",
             random.below(2) == 0 ? TaskCoverage::once_per_object : TaskCoverage::every_stimulus});
    protocol.schedule.material_rotation = kinds[random.below(3)];
    protocol.schedule.block_order = squares[random.below(3)];
    for (int i = some(3); i > 0; --i) {
        BlockSettings block;
        block.id = "b" + std::to_string(i);
        block.order = OrderMethod::blocked;
        block.by = random.below(2) == 0 ? "task" : "material";
        block.levels = squares[random.below(3)];
        protocol.blocks.push_back(block);
    }
    return protocol;
}

} // namespace

TEST_CASE("of any design all combinations of rows come equally often, and each factor fills its square first",
          "[unit]") {
    RandomStream random(14, "rotations");
    int with_several = 0;
    for (int round = 0; round < 400; ++round) {
        const Protocol protocol = random_design(random);
        const Rotations rotations(protocol, -1);
        const auto& factors = rotations.factors();
        with_several += factors.size() > 1 ? 1 : 0;
        std::map<std::vector<int>, int> met;
        for (int row = 0; row < 2 * rotations.period(); ++row) {
            std::vector<int> rows;
            for (const RotatedFactor& factor : factors)
                rows.push_back(rotations.row_of(factor.kind, factor.block, row) % factor.rows);
            ++met[rows];
        }
        CHECK(static_cast<int>(met.size()) == rotations.period());
        for (const auto& [rows, count] : met)
            CHECK(count == 2);
        for (const RotatedFactor& factor : factors) {
            for (int first = 0; first < rotations.period(); first += factor.rows) {
                std::set<int> rows;
                for (int row = first; row < first + factor.rows; ++row)
                    rows.insert(rotations.row_of(factor.kind, factor.block, row));
                // A whole square, and for random ones the same one.
                CHECK(static_cast<int>(rows.size()) == factor.rows);
                CHECK(*rows.begin() == first);
                CHECK(*rows.rbegin() == first + factor.rows - 1);
            }
        }
    }
    CHECK(with_several > 200);
}

TEST_CASE("material, order of blocks and order of tasks are three bits of eight observers, not one",
          "[unit]") {
    const Protocol protocol = three_factors(8);
    std::map<std::vector<int>, int> crossed, together;
    for (int number = 1; number <= 8; ++number) {
        const Observer observer{"P" + std::to_string(number), number};
        ++crossed[seen(make_schedule(protocol, observer, 5))];
        ++together[seen(make_schedule(protocol, observer, 5, RotationRule::together))];
    }
    CHECK(crossed.size() == 8);
    CHECK(together.size() == 2); // as version 0.1 had it, whose orders are still made again
}

TEST_CASE("what goes round alone takes the observer's own row, by either rule", "[unit]") {
    Protocol protocol = three_factors(8);
    protocol.schedule.block_order = LevelOrder::fixed;
    protocol.blocks[0].levels = LevelOrder::fixed;
    for (int number = 1; number <= 8; ++number) {
        const Observer observer{"P" + std::to_string(number), number};
        CHECK(make_schedule(protocol, observer, 5).trials ==
              make_schedule(protocol, observer, 5, RotationRule::together).trials);
    }
    CHECK(Rotations(protocol, -1).period() == 2);
}

TEST_CASE("factors that cannot be told apart are warned of, with the observers that it takes", "[unit]") {
    const auto few = rotation_facts(three_factors(2));
    REQUIRE(few.size() == 1);
    CHECK(few.front().period == 8);
    CHECK(few.front().tables.size() == 3);
    const std::vector<std::string> warnings = rotation_warnings(few);
    REQUIRE(warnings.size() == 3);
    CHECK(warnings.front() == "materials and order of blocks cannot be told apart with 2 observers: of their "
                              "4 combinations 2 never "
                              "come; let the number of observers be a multiple of 8");
    CHECK(rotation_warnings(rotation_facts(three_factors(8))).empty());
    CHECK_FALSE(rotation_warnings(rotation_facts(three_factors(6))).empty());
}

TEST_CASE("each group goes round by itself", "[unit]") {
    Protocol protocol = three_factors(16);
    GroupSettings one, other;
    one.id = "one";
    other.id = "other";
    other.chosen[1] = {"gold"};
    protocol.groups = {one, other};
    const auto facts = rotation_facts(protocol);
    REQUIRE(facts.size() == 2);
    CHECK(facts[0].period == 8);
    CHECK(facts[1].period == 4); // one material does not go round
    CHECK(facts[0].observers == 8);
    CHECK(rotation_warnings(facts).empty());
}
