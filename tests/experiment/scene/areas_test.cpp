#include "experiment/scene/areas.h"

#include <algorithm>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/scene/making/mesh_parts.h"
#include "tests/support/figures.h"

using namespace overt;

namespace {

using Names = std::vector<std::string>;

} // namespace

TEST_CASE("a part belongs to each of the areas that its name lists", "[unit]") {
    const Names parts{"body", "head", "head/eyes", "torso/head", "torso"};
    const Areas areas(parts);
    CHECK(areas.names() == Names{"body", "head", "eyes", "torso"});
    const auto members = [&](std::string_view area) {
        std::vector<int> found;
        for (PartIndex part = 0; part < parts.size(); ++part) {
            if (areas.holds(*areas.find(area), part))
                found.push_back(part);
        }
        return found;
    };
    CHECK(members("head") == std::vector<int>{1, 2, 3});
    CHECK(members("eyes") == std::vector<int>{2});
    CHECK(members("torso") == std::vector<int>{3, 4});
    CHECK_FALSE(areas.find("tor"));
    CHECK_FALSE(areas.holds(1, std::nullopt));
    CHECK_FALSE(areas.holds(1, PartIndex{200}));
    CHECK_FALSE(areas.holds(9, PartIndex{0}));
    CHECK(Areas(Names{"body"}).empty());
    CHECK(Areas(Names{"vase"}).names() == Names{"vase"});
}

TEST_CASE("the usual area is the head, else the first that is not the rest of the surface", "[unit]") {
    CHECK(usual_area(Names{"body", "rim", "head"}) == "head");
    CHECK(usual_area(Names{"body", "rim", "base"}) == "rim");
    CHECK(usual_area(Names{"body"}) == "body");
    CHECK(usual_area(Names{}).empty());
}

TEST_CASE("areas nest and overlap, of boxes, spheres, planes and groups, and the overlap is told", "[unit]") {
    Mesh bust = test::bust(); // body, head, plinth
    const std::vector<PartRegion> regions{
        {"crown", {}, {{{0, 0, 260}, {0, 0, 1}}}},
        {"front", {}, {}, {{glm::dvec3(-500, -500, -500), glm::dvec3(500, -10, 500)}}},
        {"base", {}, {}, {}, {"plinth", "body"}},
        {"face", {{0, -60, 250, 30}}, {}}};
    CHECK(label_parts(bust, regions).empty());
    const Areas areas(bust.part_names);
    for (std::size_t i = 0; i < bust.triangles.size(); ++i) {
        const glm::dvec3 at = test::centroid(bust, i);
        const bool is_head = at.z > 191.0;
        const auto is_in = [&](const char* area) {
            return areas.holds(*areas.find(area), bust.triangle_parts[i]);
        };
        REQUIRE(is_in("head") == is_head);
        REQUIRE(is_in("base") == !is_head);
        REQUIRE(is_in("crown") == (at.z >= 260.0));
        REQUIRE(is_in("front") == (at.y <= -10.0));
        REQUIRE(is_in("face") == (glm::distance(at, {0.0, -60.0, 250.0}) <= 30.0));
    }
    std::set<std::pair<std::string, std::string>> told;
    for (const AreaOverlap& overlap : overlapping_areas(bust)) {
        told.insert(std::minmax(overlap.a, overlap.b));
        CHECK(overlap.shared_area > 0.0);
        CHECK(overlap.share_of_a < 1.0);
        CHECK(overlap.share_of_b < 1.0);
    }
    // The face lies in the head and in its front; body and plinth lie in the base; crown lies in the head.
    CHECK(told.contains({"crown", "front"}));
    CHECK(told.contains({"front", "head"}));
    CHECK_FALSE(told.contains({"face", "head"}));
    CHECK_FALSE(told.contains({"face", "front"}));
    CHECK_FALSE(told.contains({"base", "body"}));
    CHECK_FALSE(told.contains({"crown", "head"}));
    CHECK_FALSE(told.contains({"base", "head"}));
}

TEST_CASE("all areas that cannot be are refused at once, each by its name", "[unit]") {
    Mesh bust = test::bust();
    const std::vector<PartRegion> regions{{"far", {{0, 0, 9000, 1}}, {}},
                                          {"head", {{0, 0, 250, 60}}, {}},
                                          {"nowhere", {}, {{{0, 0, 5000}, {0, 0, 1}}}}};
    const auto faults_of = [&](std::span<const PartRegion> of) {
        Names areas;
        try {
            label_parts(bust, of);
        } catch (const AreaError& error) {
            for (const AreaError::Fault& fault : error.faults())
                areas.push_back(fault.area);
        }
        return areas;
    };
    CHECK(faults_of(regions) == Names{"far", "nowhere"});
    CHECK(faults_of(std::vector<PartRegion>{{"a", {}, {}, {}, {"handle"}}, {"b/c", {{0, 0, 0, 100}}, {}}}) ==
          Names{"a", "b/c"});
    CHECK(faults_of(std::vector<PartRegion>{
              {"box", {}, {}, {{glm::dvec3(1.0), glm::dvec3(1.0, 2.0, 3.0)}}}}) == Names{"box"});
    CHECK(bust.part_names == test::bust().part_names);
}
