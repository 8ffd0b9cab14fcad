#include "experiment/maps/pose_cells.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/maps/nearest_pixel.h"

using namespace overt;

namespace {

/// Blobs on an image: discs thrown about, or, with a rate, single pixels.
TriangleMap blobs(glm::ivec2 size, std::uint64_t seed, int discs) {
    RandomStream random(seed, "blobs");
    TriangleMap map{size, std::vector<std::uint32_t>(static_cast<std::size_t>(size.x * size.y), 0)};
    for (int i = 0; i < discs; ++i) {
        const glm::dvec2 centre(random.uniform(0.0, size.x), random.uniform(0.0, size.y));
        const double radius = random.uniform(0.5, 0.2 * size.x);
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                if (glm::distance(centre, glm::dvec2(x, y)) < radius)
                    map.codes[static_cast<std::size_t>(y * size.x + x)] = 5;
            }
        }
    }
    return map;
}

/// Distance from a point to the nearest square of a pixel that is covered, or is not.
double distance_to(const TriangleMap& map, bool covered, glm::dvec2 point) {
    double least = std::numeric_limits<double>::infinity();
    for (int y = 0; y < map.size_px.y; ++y) {
        for (int x = 0; x < map.size_px.x; ++x) {
            if ((map.code_at(x, y) != 0) == covered)
                least = std::min(least, glm::distance(point, nearest_place_of({x, y}, point)));
        }
    }
    return least;
}

PixelFlags no_flags(const TriangleMap& map) { return PixelFlags(map.codes.size(), 0); }

} // namespace

TEST_CASE("each pixel's nearest pixel of a set is as near as trying all finds", "[unit]") {
    RandomStream random(1, "sets");
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {1, 17}, {23, 1}, {31, 19}, {40, 40}}) {
        for (const std::uint32_t one_in : {1u, 3u, 40u, 400u}) {
            std::vector<std::uint8_t> in_set(static_cast<std::size_t>(size.x * size.y));
            std::vector<glm::ivec2> members;
            for (std::size_t i = 0; i < in_set.size(); ++i) {
                in_set[i] = random.below(one_in) == 0;
                if (in_set[i])
                    members.emplace_back(static_cast<int>(i) % size.x, static_cast<int>(i) / size.x);
            }
            const auto nearest = nearest_pixels(in_set, size);
            for (std::size_t i = 0; i < in_set.size(); ++i) {
                const glm::ivec2 here(static_cast<int>(i) % size.x, static_cast<int>(i) / size.x);
                const auto squared_to = [&](glm::ivec2 pixel) {
                    return (pixel.x - here.x) * (pixel.x - here.x) + (pixel.y - here.y) * (pixel.y - here.y);
                };
                const glm::ivec2 found(nearest[i]);
                if (members.empty()) {
                    REQUIRE(found == glm::ivec2(-1));
                    continue;
                }
                int least = squared_to(members.front());
                for (const glm::ivec2 member : members)
                    least = std::min(least, squared_to(member));
                REQUIRE(squared_to(found) == least);
                REQUIRE(in_set[static_cast<std::size_t>(found.y * size.x + found.x)]);
            }
        }
    }
}

TEST_CASE("the outline is as far as the nearest pixel on its other side, to within a pixel", "[unit]") {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const TriangleMap map = blobs({60, 48}, seed, 5);
        const PoseCells cells(map, no_flags(map));
        RandomStream random(seed, "points");
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec2 point(random.uniform(-50.0, 110.0), random.uniform(-50.0, 98.0));
            const bool inside = cells.is_inside(glm::ivec2(glm::floor(point)));
            const bool covered = inside && cells.cell(glm::ivec2(point)).is_covered();
            const auto outline = cells.outline_near(point, covered);
            REQUIRE(outline);
            const double distance = glm::distance(*outline, point), exact = distance_to(map, !covered, point);
            CHECK(distance >= exact - 1e-9);
            CHECK(distance <= exact + (inside ? 1.0 : 1e-9));
        }
    }
}

TEST_CASE("where map and surface disagree the outline is at the place itself", "[unit]") {
    const TriangleMap map = blobs({60, 48}, 1, 5);
    const PoseCells cells(map, no_flags(map));
    RandomStream random(2, "points");
    for (int i = 0; i < 200; ++i) {
        const glm::dvec2 point(random.uniform(0.0, 60.0), random.uniform(0.0, 48.0));
        const bool covered = cells.cell(glm::ivec2(point)).is_covered();
        CHECK(cells.outline_near(point, !covered) == point);
    }
}

TEST_CASE("without an object in the image, or without background, there is no outline", "[unit]") {
    for (const std::uint32_t code : {0u, 3u}) {
        const TriangleMap map{{8, 8}, std::vector<std::uint32_t>(64, code)};
        const PoseCells cells(map, no_flags(map));
        CHECK_FALSE(cells.outline_near({3.0, 3.0}, code != 0));
        CHECK_FALSE(cells.outline_near({-30.0, 3.0}, false));
    }
}

TEST_CASE("cells give the map back", "[unit]") {
    for (const int discs : {0, 1, 6}) {
        const TriangleMap map = blobs({60, 48}, 3, discs);
        CHECK(PoseCells(map, PixelFlags(map.codes.size(), 1)).map().codes == map.codes);
        CHECK(PoseCells(map).map().codes == map.codes);
    }
}

TEST_CASE("cells for few questions answer what those for many do, to the last bit", "[unit]") {
    RandomStream random(7, "points");
    for (const glm::ivec2 size : {glm::ivec2(60, 48), {1, 30}, {30, 1}, {3, 3}, {16, 90}}) {
        for (std::uint64_t seed = 1; seed <= 12; ++seed) {
            const TriangleMap map = blobs(size, seed, static_cast<int>(seed) - 1);
            const PoseCells many(map, PixelFlags(map.codes.size(), 1)), few(map);
            for (int i = 0; i < 400; ++i) {
                const glm::dvec2 point(random.uniform(-0.3, 1.3) * size.x,
                                       random.uniform(-0.3, 1.3) * size.y);
                CHECK(few.outline_near(point, false) == many.outline_near(point, false));
                CHECK(few.outline_near(point, true) == many.outline_near(point, true));
                const glm::ivec2 pixel(glm::floor(point));
                if (!many.is_inside(pixel))
                    continue;
                CHECK(few.cell(pixel).is_covered() == many.cell(pixel).is_covered());
                CHECK(few.cell(pixel).is_contested());
            }
        }
    }
}

TEST_CASE("an outline of more than 65,536 pixels is kept in full", "[unit]") {
    // Every third column is background; the object between has an outline everywhere.
    TriangleMap map{{600, 600}, std::vector<std::uint32_t>(360000, 9)};
    for (std::size_t i = 0; i < map.codes.size(); i += 3)
        map.codes[i] = 0;
    const PoseCells cells(map, no_flags(map));
    for (int y = 0; y < 600; y += 7) {
        for (int x = 1; x < 600; x += 3) {
            const glm::dvec2 point(x + 0.25, y + 0.5);
            CHECK(glm::distance(*cells.outline_near(point, true), point) == Approx(0.25));
        }
    }
}
