#include "experiment/maps/triangle_map.h"

#include <fstream>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "render/image/linear_image.h"
#include "tests/support/temporary_folder.h"

using namespace overt;

TEST_CASE("a map of triangles comes back from its file with every code", "[unit]") {
    const test::TemporaryFolder folder;
    TriangleMap map{{37, 21}, std::vector<std::uint32_t>(37 * 21)};
    RandomStream random(3, "codes");
    for (std::uint32_t& code : map.codes)
        code = random.next_bits();
    map.codes[5] = 0;
    map.codes[6] = 0xffffffffu;
    write_triangle_map(folder.path() / "map.exr", map, {{"angle_deg", "12.5"}});
    const TriangleMap back = read_triangle_map(folder.path() / "map.exr");
    CHECK(back.size_px == map.size_px);
    CHECK(back.codes == map.codes);
    CHECK(map.covered_pixels() == back.covered_pixels());
}

TEST_CASE("a picture that is no map, a damaged map and a missing one are refused by name", "[unit]") {
    const test::TemporaryFolder folder;
    write_linear_exr(folder.path() / "frame.exr", LinearImage({8, 8}), {});
    CHECK_THROWS_WITH(read_triangle_map(folder.path() / "frame.exr"),
                      Catch::Contains("frame.exr") && Catch::Contains("no map"));
    std::ofstream(folder.path() / "noise.exr") << "this is no picture";
    CHECK_THROWS_AS(read_triangle_map(folder.path() / "noise.exr"), InputError);
    CHECK_THROWS_WITH(read_triangle_map(folder.path() / "none.exr"), Catch::Contains("none.exr"));
}
