#include "experiment/report/volume_maps.h"

#include <cstring>
#include <sstream>

#include <catch2/catch.hpp>

#include "experiment/base/whole_file.h"
#include "tests/experiment/study/painted_study.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("volumes of maps hold the time of their fixations, where these are", "[unit]") {
    PaintedStudy study(2, 2, 5, [](int, int level, RandomStream& random) {
        return near(level == 0 ? front : top, 0.05, random);
    });
    study.results.objects[0].title = "The \"ball\", turned";
    *study.results.objects[0].mm_per_unit = 2.0;
    for (int group = 0; group < 2; ++group) {
        for (const MapWeighting weighting : {MapWeighting::duration, MapWeighting::count}) {
            StudyMap& map = study.results.maps.emplace_back();
            map.group = group;
            map.weighting = weighting;
            map.trials = 2;
        }
    }
    // A group whose fixations all lie beside the object has no volume.
    study.results.groups.push_back({{{"material", "none"}}, {}, 0, 0});
    study.results.maps.emplace_back().group = 2;
    const TemporaryFolder folder;
    CHECK(write_volumes(study.results, folder.path() / "volumes") == 2);
    const std::string index = read_whole_file(folder.path() / "volumes/index.csv");
    CHECK(std::ranges::count(index, '\n') == 3);
    CHECK(index.find(",ball,\"The \"\"ball\"\", turned: material rough\",30,") != index.npos);
    CHECK(std::filesystem::exists(folder.path() / "volumes/map_ball_material_smooth.cube"));

    const std::string volume = read_whole_file(folder.path() / "volumes/map_ball_material_smooth.nrrd");
    const std::size_t head_end = volume.find("\n\n") + 2;
    std::istringstream head(volume.substr(0, head_end));
    glm::ivec3 cells{0};
    glm::dvec3 origin{0.0};
    double cell = 0.0;
    for (std::string line; std::getline(head, line);) {
        if (line.starts_with("sizes: "))
            REQUIRE(std::sscanf(line.c_str(), "sizes: %d %d %d", &cells.x, &cells.y, &cells.z) == 3);
        if (line.starts_with("space origin: "))
            REQUIRE(std::sscanf(line.c_str(), "space origin: (%lf,%lf,%lf)", &origin.x, &origin.y,
                                &origin.z) == 3);
        if (line.starts_with("space directions: "))
            REQUIRE(std::sscanf(line.c_str(), "space directions: (%lf", &cell) == 1);
    }
    CHECK(cell == Approx(15.0));
    double total = 0.0;
    glm::dvec3 centre{0.0};
    std::size_t at = head_end;
    for (int z = 0; z < cells.z; ++z) {
        for (int y = 0; y < cells.y; ++y) {
            for (int x = 0; x < cells.x; ++x, at += sizeof(float)) {
                float value = 0.0f;
                std::memcpy(&value, volume.data() + at, sizeof value);
                total += value;
                centre += static_cast<double>(value) * (origin + cell * glm::dvec3(x, y, z));
            }
        }
    }
    CHECK(at == volume.size());
    // Ten fixations of 250 ms in two trials, about 200 mm in front of the middle.
    CHECK(total * cell * cell * cell == Approx(1250.0).epsilon(1e-4));
    CHECK(glm::distance(centre / total, glm::dvec3(0.0, -200.0, 0.0)) < 20.0);
}
