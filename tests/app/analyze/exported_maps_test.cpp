/// Maps that `overt analyze` exports, read back and added up: they hold the time of the fixations that its
/// table has, in each format, whatever the mesh's unit and however large the object was shown.
#include <filesystem>
#include <map>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/app/analyze/small_study.h"
#include "tests/support/map_files.h"
#include "tests/support/tsv_file.h"

namespace fs = std::filesystem;
using namespace overt::test;

namespace {

/// Counted fixations of a group on its object.
struct GroupTime {
    double ms = 0.0;
    glm::dvec3 sum_mm{0.0}; ///< of their places, each weighted by its duration in ms
    std::string object;
    int trials = 0;
};

std::string title_of(const TsvFile& table, std::size_t row) {
    const std::string object = table.text(row, "object");
    return fmt::format("{}: task {}, object {}, material {}", object == "bust" ? "Bust" : "Tall bust",
                       table.text(row, "task"), object, table.text(row, "material"));
}

/// By the title of its map.
std::map<std::string, GroupTime> times_of(const fs::path& analysis) {
    std::map<std::string, GroupTime> groups;
    const TsvFile trials(analysis / "trials.tsv"), fixations(analysis / "fixations.tsv");
    for (std::size_t row = 0; row < trials.size(); ++row) {
        GroupTime& group = groups[title_of(trials, row)];
        group.object = trials.text(row, "object");
        ++group.trials;
    }
    for (std::size_t row = 0; row < fixations.size(); ++row) {
        if (fixations.text(row, "counted") != "1")
            continue;
        GroupTime& group = groups[title_of(fixations, row)];
        const double ms = 1e3 * fixations.number(row, "duration_s");
        group.ms += ms;
        group.sum_mm += ms * glm::dvec3(fixations.number(row, "x_mm"), fixations.number(row, "y_mm"),
                                        fixations.number(row, "z_mm"));
    }
    return groups;
}

} // namespace

TEST_CASE("exported maps hold the time of their fixations, in the space of the table of fixations",
          "[session]") {
    // The bust's unit is not known; the tall one is 359 mm high, and its picture at most 64.
    constexpr std::string_view line = "mesh = \"meshes/bust.ply\"";
    const SmallStudy study(with(small_protocol, line, std::string(line) + "\nunit = \"own\"\nscale = 7"));
    const fs::path out = study.experiment.folder().path() / "analysis";
    const ProgramRun run = study.analyze(out, {"--meshes", "--volumes"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const std::map<std::string, GroupTime> groups = times_of(out);
    REQUIRE(groups.size() == 12);

    const auto json = nlohmann::json::parse(bytes_of_file((out / "study.json").string()));
    std::map<std::string, nlohmann::json> objects;
    for (const auto& one : json.at("objects"))
        objects[one.at("id")] = one;
    CHECK(objects["tall"].at("mm_per_unit") == 1.0);
    CHECK(objects["tall"].at("shown_size") < 0.2);
    CHECK(objects["bust"].at("mm_per_unit") < 0.1);
    CHECK(objects["bust"].at("shown_size") == 1.0);

    // Names of files by the titles of their maps.
    std::map<std::string, std::string> names;
    for (const fs::directory_entry& file : fs::directory_iterator(out / "meshes"))
        if (file.path().extension() == ".ply") {
            const std::string legend = read_coloured_ply(file.path().string()).legend;
            names[legend.substr(0, legend.find('\n'))] = file.path().stem().string();
        }
    for (const auto& [title, group] : groups) {
        INFO(title);
        REQUIRE(group.ms > 0.0);
        const double wanted = group.ms / group.trials;
        const glm::dvec3 mean_mm = group.sum_mm / group.ms;
        const ReadMap ply = read_coloured_ply((out / "meshes" / (names.at(title) + ".ply")).string());
        CHECK(ply.integral() == Approx(wanted).epsilon(1e-4));
        CHECK(ply.legend.find("quantity: ms of fixation of a trial per mm^2 of the object") !=
              std::string::npos);
        CHECK(ply.legend.find("lengths: mm of the object") != std::string::npos);
        const ReadMap glb = read_glb((out / "meshes" / (names.at(title) + ".glb")).string());
        CHECK(glb.integral() == Approx(wanted).epsilon(1e-4));
        CHECK(glb.legend.find("per m^2 of the object") != std::string::npos);
        // The same object, in metres and with +y up.
        CHECK(1e3 * (glb.high().y - glb.low().y) == Approx(ply.high().z - ply.low().z).epsilon(1e-5));
        const ReadVolume volume = read_nrrd((out / "volumes" / (names.at(title) + ".nrrd")).string());
        CHECK(volume.integral == Approx(wanted).epsilon(1e-4));
        // To half a voxel, which is a quarter of the kernel's sigma.
        const double sigma_mm = objects[group.object].at("mm_per_deg");
        CHECK(glm::distance(volume.centre, mean_mm) < 0.5 * sigma_mm);
        CHECK(glm::all(glm::greaterThan(mean_mm, ply.low())));
        CHECK(glm::all(glm::lessThan(mean_mm, ply.high())));
        if (group.object == "tall") {
            CHECK(ply.high().z - ply.low().z == Approx(358.0).margin(1.0));
        } else {
            CHECK(ply.legend.find("the unit of the mesh is not known") != std::string::npos);
            CHECK(ply.high().z - ply.low().z < 64.0); // as large as its picture
        }
    }
    // The numbers in the index of the files are those of the files.
    const std::string index = bytes_of_file((out / "meshes/index.csv").string());
    CHECK(index.find("map_tall_task_face__object_tall__material_matt.glb,map,") != std::string::npos);
    CHECK(index.find("ms of fixation of a trial per m^2 of the object,m of the object,") !=
          std::string::npos);
}

TEST_CASE("a kernel in millimetres is as wide on the object, however large that is shown", "[session]") {
    const SmallStudy study;
    const fs::path out = study.experiment.folder().path() / "analysis";
    REQUIRE(study.analyze(out, {"--sigma", "30mm", "--volumes"}).exit_code == 0);
    const TsvFile maps(out / "maps.tsv");
    for (std::size_t row = 0; row < maps.size(); ++row)
        CHECK(maps.number(row, "least_sigma_mm") == Approx(30.0));
    const nlohmann::json dictionary =
        nlohmann::json::parse(bytes_of_file((out / "dictionary.json").string()));
    CHECK(dictionary.dump().find("\"mm^2 of the object\"") != std::string::npos);
}
