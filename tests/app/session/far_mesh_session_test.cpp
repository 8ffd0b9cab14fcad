/// A mesh in the coordinates of a country's grid: places on it can be taken back to its file.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

#include <SQLiteCpp/SQLiteCpp.h>

#include "tests/app/small_experiment.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;
namespace fs = std::filesystem;

namespace {

/// As text, with all digits: a binary PLY of floats has not enough of them.
void write_far_ply(const fs::path& file, const Mesh& mesh, glm::dvec3 by) {
    std::ofstream stream(file);
    stream << "ply\nformat ascii 1.0\nelement vertex " << mesh.positions.size()
           << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
           << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\nproperty uchar part\n";
    for (std::size_t part = 0; part < mesh.part_names.size(); ++part)
        stream << "comment part " << part << ' ' << mesh.part_names[part] << '\n';
    stream << "end_header\n";
    for (const glm::vec3& position : mesh.positions) {
        const glm::dvec3 place = glm::dvec3(position) + by;
        stream << fmt::format("{:.6f} {:.6f} {:.6f}\n", place.x, place.y, place.z);
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3& corners = mesh.triangles[i];
        stream << fmt::format("3 {} {} {} {}\n", corners.x, corners.y, corners.z, mesh.triangle_parts[i]);
    }
}

/// Whether a place lies on the mesh, to a twentieth of its unit.
bool is_on(const Mesh& mesh, glm::dvec3 place) {
    return std::ranges::any_of(mesh.triangles, [&](const glm::uvec3& corners) {
        const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]),
            c(mesh.positions[corners.z]);
        const glm::dvec3 across = glm::cross(b - a, c - a), normal = glm::normalize(across);
        if (std::abs(glm::dot(place - a, normal)) > 0.05)
            return false;
        const auto share = [&](glm::dvec3 from, glm::dvec3 to) {
            return glm::dot(glm::cross(to - from, place - from), across) / glm::dot(across, across);
        };
        return share(a, b) > -0.01 && share(b, c) > -0.01 && share(c, a) > -0.01;
    });
}

/// One object in one material, in two trials.
std::string one_object() {
    std::string text(small_protocol);
    for (const char* const part :
         {"[[object]]\nid = \"tall\"\ntitle = \"Tall bust\"\nmesh = \"meshes/tall.ply\"\n",
          "[[material]]\nid = \"matt\"\nkind = \"diffuse\"\n",
          "[[task]]\nid = \"clothes\"\nquestion = \"Look at the clothes.\"\nsimulated_head_share = 0\n"})
        text = with(text, part, "");
    return text;
}

double number_of(const fs::path& session, const std::string& column) {
    SQLite::Database database((session / "session.sqlite").string());
    return database.execAndGet("SELECT " + column + " FROM object WHERE object = 0").getDouble();
}

} // namespace

TEST_CASE(
    "places on a mesh far from its file's origin, with the recorded origin added, are those in the file",
    "[session]") {
    const glm::dvec3 by(565412.0, 5934211.0, 35.0);
    for (const bool is_far : {false, true}) {
        const SmallExperiment experiment(one_object(), Cache::own);
        write_far_ply(experiment.folder().path() / "meshes/bust.ply", bust(), is_far ? by : glm::dvec3(0.0));
        const ProgramRun run = experiment.run();
        INFO(run.err);
        REQUIRE(run.exit_code == 0);
        const fs::path session = experiment.session(), tables = experiment.folder().path() / "tables";
        const glm::dvec3 origin(number_of(session, "origin_x"), number_of(session, "origin_y"),
                                number_of(session, "origin_z"));
        CHECK((origin != glm::dvec3(0.0)) == is_far);
        REQUIRE(experiment.overt({"export", session.string(), "--out", tables.string()}).exit_code == 0);
        const TsvFile stimuli(tables / "stimuli.tsv");
        bool any = false;
        for (std::size_t row = 0; row < stimuli.size(); ++row) {
            if (stimuli.text(row, "object") != "bust")
                continue;
            any = true;
            CHECK(stimuli.number(row, "origin_x") == origin.x);
            CHECK(stimuli.number(row, "origin_y") == origin.y);
            CHECK(stimuli.number(row, "origin_z") == origin.z);
        }
        CHECK(any);
        // Places, with the origin added, lie on the mesh as the file has it.
        const TsvFile samples(tables / "samples.tsv");
        const Mesh mesh = bust();
        int placed = 0, without_origin = 0;
        for (std::size_t row = 0; row < samples.size(); row += 5) {
            if (!samples.has(row, "surface_x"))
                continue;
            const glm::dvec3 place(samples.number(row, "surface_x"), samples.number(row, "surface_y"),
                                   samples.number(row, "surface_z"));
            const glm::dvec3 in_file = place + origin;
            REQUIRE(is_on(mesh, in_file - (is_far ? by : glm::dvec3(0.0))));
            without_origin += is_on(mesh, place);
            ++placed;
        }
        CHECK(placed > 100);
        CHECK((is_far ? without_origin < placed / 2 : without_origin == placed));
    }
}
