#include <catch2/catch.hpp>

#include <cstring>
#include <sstream>

#include "experiment/base/whole_file.h"
#include "experiment/surface/volume_file.h"
#include "tests/support/temporary_folder.h"

using namespace overt;

namespace {

/// 12 x 10 x 8 voxels of side 1 with the kernel cut off at their border: no margin, as scipy has none.
VoxelDensity three_points() {
    // The margin that the constructor adds is taken off the box.
    const double sigma = 1.3, margin = 4.0 * sigma;
    VoxelDensity voxels({glm::dvec3(margin), glm::dvec3(12.0 - margin, 10.0 - margin, 8.0 - margin)}, sigma,
                        12);
    REQUIRE(voxels.cells() == glm::ivec3(12, 10, 8));
    REQUIRE(voxels.cell_side() == Approx(1.0));
    voxels.add({5.5, 4.5, 3.5});
    voxels.add({11.5, 9.5, 0.5}, 2.5);
    voxels.add({0.5, 0.5, 7.5}, 0.5);
    return voxels;
}

} // namespace

TEST_CASE("blurred voxels are those of scipy.ndimage.gaussian_filter", "[unit]") {
    VoxelDensity voxels = three_points();
    voxels.blur();
    // scipy 1.10.1: gaussian_filter(a, 1.3, mode='constant', truncate=4), a[z, y, x] as above.
    struct Expected {
        glm::dvec3 at;
        double value;
    };
    for (const auto& [at, value] : {Expected{{5, 4, 3}, 0.02890144094228892},
                                    {{11, 9, 0}, 0.07225360064204726},
                                    {{6, 4, 4}, 0.015993389304131165},
                                    {{0, 0, 7}, 0.014450721499349489},
                                    {{9, 7, 2}, 0.0020880331099216534},
                                    {{2, 2, 5}, 0.0006040282738345898}}) {
        CAPTURE(at.x, at.y, at.z);
        CHECK(voxels.at(at + 0.5) == Approx(value).epsilon(1e-12));
    }
}

TEST_CASE("blurring keeps the weight, and is the same to the bit on one thread", "[unit]") {
    const Bounds box{glm::dvec3(-20.0, -10.0, 0.0), glm::dvec3(20.0, 10.0, 50.0)};
    VoxelDensity all(box, 4.0, 64), alone(box, 4.0, 64);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 point(std::sin(1.0 * i) * 20.0, std::sin(2.3 * i) * 10.0,
                               25.0 + std::cos(3.1 * i) * 25.0);
        all.add(point, 1.0 + i % 3);
        alone.add(point, 1.0 + i % 3);
    }
    all.blur();
    alone.blur(1);
    CHECK(std::ranges::equal(all.values(), alone.values()));
    const double cube = std::pow(all.cell_side(), 3.0);
    double sum = 0.0;
    for (const double value : all.values())
        sum += value * cube;
    CHECK(sum == Approx(66 * 6 + 1 + 2).epsilon(1e-9));
    CHECK(VoxelDensity(box, 4.0).cell_side() == 2.0);
}

TEST_CASE("a volume file says where its voxels are, and holds them", "[unit]") {
    const test::TemporaryFolder folder;
    VoxelDensity voxels = three_points();
    voxels.blur();
    write_nrrd(folder.path() / "map.nrrd", voxels, "mm", "fixations per mm^3");
    const std::string file = read_whole_file(folder.path() / "map.nrrd");
    const std::size_t end = file.find("\n\n");
    REQUIRE(end != file.npos);
    const std::string header = file.substr(0, end);
    CHECK(header.starts_with("NRRD0004\n"));
    CHECK(header.find("\nsizes: 12 10 8\n") != header.npos);
    CHECK(header.find("\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n") != header.npos);
    CHECK(header.find("\nspace origin: (0.5,0.5,0.5)\n") != header.npos);
    CHECK(file.size() - end - 2 == 12 * 10 * 8 * sizeof(float));
    float value = 0.0f;
    std::memcpy(&value, file.data() + end + 2 + sizeof(float) * ((3 * 10 + 4) * 12 + 5), sizeof(float));
    CHECK(value == Approx(0.02890144094228892));
}

TEST_CASE("a look-up table takes an object coordinate to the map's value there", "[unit]") {
    const test::TemporaryFolder folder;
    VoxelDensity voxels = three_points();
    voxels.blur();
    const Bounds bounds{glm::dvec3(1.0, 1.0, 1.0), glm::dvec3(11.0, 9.0, 7.0)};
    write_cube_table(folder.path() / "map.cube", voxels, bounds, 0.05, 5, "task \"1\"", "fixations per mm^3");
    std::istringstream stream(read_whole_file(folder.path() / "map.cube"));
    std::vector<double> values;
    for (std::string line; std::getline(stream, line);) {
        double red = 0.0, green = 0.0, blue = 0.0;
        std::istringstream numbers(line);
        if (numbers >> red >> green >> blue) {
            CHECK(red == green);
            CHECK(red == blue);
            values.push_back(red);
        } else if (line.starts_with("TITLE")) {
            CHECK(line == "TITLE \"task  1 \"");
        }
    }
    REQUIRE(values.size() == 125);
    // Red, which is x, runs fastest: entry (2, 1, 3) is the coordinate (6, 3, 5.5).
    CHECK(values[(3 * 5 + 1) * 5 + 2] == Approx(voxels.at({6.0, 3.0, 5.5}) / 0.05).margin(1e-6));
}
