#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/scene/files/mesh_reader.h"
#include "experiment/scene/triangle_order.h"
#include "tests/experiment/scene/mesh_fixtures.h"
#include "tests/support/glb_maker.h"

using namespace overt;

namespace {

/// One triangle whose corners lie at (0, 0), (1, 0) and (0, 1) of a picture.
SurfaceAppearance under_picture(glm::ivec2 size_px, const std::vector<glm::u8vec3>& texels,
                                const SurfacePlacement& placed = {}) {
    SurfaceAppearance look;
    auto picture = std::make_shared<SurfacePicture>();
    picture->size_px = size_px;
    for (const glm::u8vec3& texel : texels)
        picture->texels.emplace_back(texel, 255);
    look.pictures.push_back(picture);
    FileMaterial& material = look.materials.emplace_back();
    material.colour_picture = placed;
    material.colour_picture.picture = 0;
    look.uvs[0] = {{glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)}};
    return look;
}

float red_at(const SurfaceAppearance& look, double u, double v) {
    return look_at(look, 0, glm::vec2(u, v)).colour.x;
}

} // namespace

TEST_CASE("codes of sRGB are the light that IEC 61966-2-1 has for them", "[unit]") {
    CHECK(linear_of_srgb(0) == 0.0f);
    CHECK(linear_of_srgb(255) == 1.0f);
    CHECK(linear_of_srgb(64) == Approx(0.051).margin(0.0005));
    CHECK(linear_of_srgb(124) == Approx(0.202).margin(0.0005));
    CHECK(linear_of_srgb(231) == Approx(0.799).margin(0.0005));
}

TEST_CASE("a picture is mixed between its texels' middles in linear light, and goes on beyond its edges as "
          "it is told",
          "[unit]") {
    const std::vector<glm::u8vec3> black_white{{0, 0, 0}, {255, 255, 255}};
    const SurfaceAppearance repeated = under_picture({2, 1}, black_white);
    CHECK(red_at(repeated, 0.25, 0.0) == Approx(0.0f).margin(1e-6));
    CHECK(red_at(repeated, 0.75, 0.0) == Approx(1.0f));
    CHECK(red_at(repeated, 0.5, 0.0) == Approx(0.5f)); // half of the light, not of the codes
    CHECK(red_at(repeated, 0.0, 0.0) == Approx(0.5f)); // between the last texel and the first
    CHECK(red_at(repeated, 1.25, 0.0) == Approx(0.0f).margin(1e-6));
    SurfacePlacement placed;
    placed.across = PictureEdge::clamp;
    CHECK(red_at(under_picture({2, 1}, black_white, placed), 0.0, 0.0) == Approx(0.0f).margin(1e-6));
    CHECK(red_at(under_picture({2, 1}, black_white, placed), 7.0, 0.0) == Approx(1.0f));
    placed.across = PictureEdge::mirror;
    CHECK(red_at(under_picture({2, 1}, black_white, placed), 1.25, 0.0) == Approx(1.0f));
    CHECK(red_at(under_picture({2, 1}, black_white, placed), 1.75, 0.0) == Approx(0.0f).margin(1e-6));
    CHECK(red_at(under_picture({2, 1}, black_white, placed), -0.25, 0.0) == Approx(0.0f).margin(1e-6));
    placed.is_nearest = true;
    CHECK(red_at(under_picture({2, 1}, black_white, placed), 0.49, 0.0) == 0.0f);
    // The first row is the upper one, where v is 0.
    const SurfaceAppearance rows = under_picture({1, 2}, black_white);
    CHECK(red_at(rows, 0.0, 0.25) == Approx(0.0f).margin(1e-6));
    CHECK(red_at(rows, 0.0, 0.75) == Approx(1.0f));
}

TEST_CASE("a picture is scaled, then turned, then moved, as KHR_texture_transform and its examples have it",
          "[unit]") {
    SurfacePlacement placed;
    placed.scale = {2.0, 3.0};
    placed.turn_rad = 0.3;
    placed.offset = {0.1, 0.2};
    const glm::dvec2 place = placed.place_of({0.5, 0.25});
    CHECK(place.x == Approx(std::cos(0.3) * 1.0 + std::sin(0.3) * 0.75 + 0.1));
    CHECK(place.y == Approx(-std::sin(0.3) * 1.0 + std::cos(0.3) * 0.75 + 0.2));
    // Blender 3.4 writes a turn by 0.3 of a picture scaled by 2 so that its lower left corner stays.
    SurfacePlacement blender;
    blender.scale = {2.0, 2.0};
    blender.turn_rad = 0.3;
    blender.offset = {-2.0 * std::sin(0.3), 1.0 - 2.0 * std::cos(0.3)};
    CHECK(glm::length(blender.place_of({0.0, 1.0}) - glm::dvec2(0.0, 1.0)) < 1e-12);
}

TEST_CASE("what a picture says of metal and roughness is taken as it stands, and times its factors",
          "[unit]") {
    SurfaceAppearance look = under_picture({1, 1}, {{10, 128, 51}});
    look.materials[0].surface_picture = look.materials[0].colour_picture;
    look.materials[0].metallic = 0.5f;
    look.materials[0].roughness = 1.0f;
    look.materials[0].colour = glm::vec3(0.5f);
    look.colours = {{glm::vec3(1.0f), glm::vec3(0.0f), glm::vec3(1.0f)}};
    const SurfaceLook at = look_at(look, 0, glm::vec2(0.5f, 0.0f));
    CHECK(at.roughness == Approx(128.0f / 255.0f));
    CHECK(at.metallic == Approx(0.5f * 51.0f / 255.0f));
    CHECK(at.colour.y == Approx(0.5f * 0.5f * linear_of_srgb(128)));
}

namespace {

/// A ball in which each triangle has a colour of its own, on a picture and at its corners, with what cleaning
/// has to do: triangles twice, without area, corners that are not shared, and the inside out.
struct Atlas {
    Mesh ball = test::bumpy_ball();
    std::vector<glm::u8vec3> texels;
    std::vector<glm::vec3> corner_colours; ///< of the corner c of triangle t: 3 t + c
    int side = 0;

    Atlas() {
        RandomStream random(7, "colours");
        side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(ball.triangles.size()))));
        texels.resize(static_cast<std::size_t>(side * side));
        for (std::size_t i = 0; i < ball.triangles.size(); ++i) {
            texels[i] = {i % 251, (i / 251) % 251, 17 + i % 13};
            for (int corner = 0; corner < 3; ++corner)
                corner_colours.emplace_back(random.uniform(0.5, 1.0), random.uniform(0.5, 1.0), 1.0);
        }
    }

    glm::vec2 uv_of(std::size_t triangle) const {
        const int texel = static_cast<int>(triangle);
        return (glm::vec2(texel % side, texel / side) + 0.5f) / static_cast<float>(side);
    }

    std::string glb() const {
        test::GlbMaker maker;
        std::vector<glm::vec3> positions, colours;
        std::vector<glm::vec2> uvs;
        const auto add = [&](std::size_t triangle, glm::uvec3 corners, bool is_repeated) {
            for (int i = 0; i < 3; ++i) {
                positions.push_back(ball.positions[corners[i]]);
                uvs.push_back(is_repeated ? glm::vec2(0.99f) : uv_of(triangle));
                int of = 0;
                while (ball.triangles[triangle][of] != corners[i] && of < 2)
                    ++of;
                colours.push_back(corner_colours[3 * triangle + static_cast<std::size_t>(of)]);
            }
        };
        for (std::size_t i = 0; i < ball.triangles.size(); ++i) {
            const glm::uvec3 t = ball.triangles[i];
            if (i % 5 == 0)
                add(i, {t.x, t.y, t.x}, true); // without area
            add(i, {t.x, t.z, t.y}, false);    // inside out
            if (i % 7 == 0)
                add(i, {t.z, t.y, t.x}, true); // once more, with another colour
        }
        nlohmann::json primitive{{"attributes",
                                  {{"POSITION", maker.floats<3>(positions)},
                                   {"TEXCOORD_0", maker.floats<2>(uvs)},
                                   {"COLOR_0", maker.floats<3>(colours)}}}};
        primitive["material"] = maker.painted_material(test::png_of({side, side}, texels));
        maker.show({primitive});
        return maker.glb();
    }
};

using CornerPlaces = std::set<std::array<float, 3>>;
CornerPlaces corner_places(const std::vector<glm::vec3>& positions, const glm::uvec3& triangle) {
    CornerPlaces places;
    for (int corner = 0; corner < 3; ++corner) {
        const glm::vec3 p = positions[triangle[corner]];
        places.insert({p.x, p.y, p.z});
    }
    return places;
}

} // namespace

TEST_CASE("each triangle keeps its own colour, and each corner its own, through cleaning and ordering",
          "[unit]") {
    const Atlas atlas;
    const test::TemporaryFolder folder;
    MeshImport import;
    import.weld_tolerance = 1e-6;
    MeshCleaningReport report;
    SurfaceAppearance look;
    Mesh mesh = import_mesh(folder.file("atlas.glb", atlas.glb()), import, report, &look);
    CHECK(report.flipped);
    CHECK(report.degenerate_faces_dropped > 0);
    CHECK(report.duplicate_faces_dropped > 0);
    REQUIRE(mesh.triangles.size() == atlas.ball.triangles.size());
    std::vector<CornersFrom> from;
    order_for_drawing(mesh, &from);
    look = rearranged(std::move(look), from);

    std::map<CornerPlaces, std::size_t> triangle_at;
    for (std::size_t i = 0; i < atlas.ball.triangles.size(); ++i)
        triangle_at[corner_places(atlas.ball.positions, atlas.ball.triangles[i])] = i;
    std::size_t moved = 0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const std::size_t own = triangle_at.at(corner_places(mesh.positions, mesh.triangles[i]));
        moved += own != i ? 1 : 0;
        const glm::u8vec3 texel = atlas.texels[own];
        const glm::vec3 painted(linear_of_srgb(texel.x), linear_of_srgb(texel.y), linear_of_srgb(texel.z));
        // At each corner, where the mixture is that corner's alone.
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec2 place(corner == 1 ? 1.0f : 0.0f, corner == 2 ? 1.0f : 0.0f);
            const glm::vec3 position = mesh.positions[mesh.triangles[i][corner]];
            std::size_t same = 0;
            while (same < 2 &&
                   atlas.ball.positions[atlas.ball.triangles[own][static_cast<int>(same)]] != position)
                ++same;
            const glm::vec3 expected = painted * atlas.corner_colours[3 * own + same];
            CHECK(glm::length(look_at(look, i, place).colour - expected) < 2e-6f);
        }
    }
    CHECK(moved > mesh.triangles.size() / 2);
}

TEST_CASE("pictures do not change the mesh, and each thing of a look changes its hash", "[unit]") {
    const Atlas atlas;
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder.file("atlas.glb", atlas.glb());
    MeshCleaningReport report;
    SurfaceAppearance look;
    const Mesh with = import_mesh(file, {}, report, &look), without = import_mesh(file, {}, report);
    CHECK(with.positions == without.positions);
    CHECK(with.triangles == without.triangles);
    std::set<ContentHash> hashes{hash_of_appearance(look)};
    const auto other = [&](auto&& change) {
        SurfaceAppearance changed = look;
        change(changed);
        CHECK(hashes.insert(hash_of_appearance(changed)).second);
    };
    other([](SurfaceAppearance& l) { l.materials[0].roughness = 0.3f; });
    other([](SurfaceAppearance& l) { l.materials[0].metallic = 0.3f; });
    other([](SurfaceAppearance& l) { l.materials[0].colour.y = 0.3f; });
    other([](SurfaceAppearance& l) { l.materials[0].colour_picture.down = PictureEdge::clamp; });
    other([](SurfaceAppearance& l) { l.materials[0].colour_picture.offset.x = 0.5; });
    other([](SurfaceAppearance& l) { l.materials[0].surface_picture.picture = 0; });
    other([](SurfaceAppearance& l) { l.uvs[0][3][1].x += 0.1f; });
    other([](SurfaceAppearance& l) { l.colours[3][1].x = 0.1f; });
    other([](SurfaceAppearance& l) {
        l.triangle_materials[3] = 0;
        l.triangle_materials.resize(4);
    });
    other([](SurfaceAppearance& l) {
        SurfacePicture picture = *l.pictures[0];
        picture.texels[5].x ^= 1;
        l.pictures[0] = std::make_shared<const SurfacePicture>(picture);
    });
}

TEST_CASE("an OBJ has its colours from its .mtl, its picture from below up, and materials as parts",
          "[unit]") {
    const test::TemporaryFolder folder;
    // The upper left of the picture is red, the lower right green.
    folder.file("a picture.png", test::png_of({2, 2}, {{255, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 255, 0}}));
    folder.file("my things.mtl", "newmtl paint\nmap_Kd -s 1 1 1 a picture.png\nNs 0\n"
                                 "newmtl tin\nKd 0.25 0.5 0.75\nPm 1\nPr 0.4\n");
    const std::string text = "mtllib my things.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n"
                             "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                             "usemtl paint\nf 1/1 2/2 3/3 -2/-1\nusemtl tin\nf 1 2 5\n";
    const std::filesystem::path file = folder.file("m.obj", text);
    MeshImport import;
    import.parts_by_material = true;
    MeshCleaningReport report;
    SurfaceAppearance look;
    const Mesh mesh = import_mesh(file, import, report, &look);
    REQUIRE(mesh.part_names == std::vector<std::string>{"paint", "tin"});
    int seen = 0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.triangle_parts[i] == 1) {
            const SurfaceLook tin = look_at(look, i, glm::vec2(0.3f));
            CHECK(tin.colour == glm::vec3(0.25f, 0.5f, 0.75f));
            CHECK(tin.metallic == 1.0f);
            CHECK(tin.roughness == 0.4f);
            continue;
        }
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec2 place(corner == 1 ? 1.0f : 0.0f, corner == 2 ? 1.0f : 0.0f);
            const glm::vec3 position = mesh.positions[mesh.triangles[i][corner]];
            SurfaceAppearance near = look;
            for (auto& picture : near.materials)
                picture.colour_picture.across = picture.colour_picture.down = PictureEdge::clamp;
            const glm::vec3 colour = look_at(near, i, place).colour;
            if (position == glm::vec3(0, 1, 0)) {
                CHECK(colour == glm::vec3(1, 0, 0));
                ++seen;
            } else if (position == glm::vec3(1, 0, 0)) {
                CHECK(colour == glm::vec3(0, 1, 0));
                ++seen;
            }
            CHECK(look_at(near, i, place).roughness == Approx(1.0f));
        }
    }
    CHECK(seen >= 2);
    // For its shape alone nothing beside it is needed.
    std::filesystem::remove(folder.path() / "my things.mtl");
    CHECK_NOTHROW(import_mesh(file, {}, report));
    CHECK_THROWS_WITH(import_mesh(file, {}, report, &look),
                      Catch::Contains(":1:") && Catch::Contains("is missing"));
}

TEST_CASE("colours of PLY vertices and faces and of OBJ vertices are sRGB", "[unit]") {
    const test::TemporaryFolder folder;
    const std::string vertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string colours = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    const std::string by_vertex = "ply\nformat ascii 1.0\n" + vertices + colours +
                                  "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                  "0 0 0 64 124 231\n1 0 0 255 0 0\n0 1 0 0 0 255\n3 0 1 2\n";
    const std::string by_face = "ply\nformat ascii 1.0\n" + vertices +
                                "element face 1\nproperty list uchar int vertex_indices\n" + colours +
                                "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 64 124 231\n";
    const std::string obj = fmt::format("v 0 0 0 {} {} {}\nv 1 0 0 1 0 0\nv 0 1 0 0 0 1\nf 1 2 3\n",
                                        64 / 255.0, 124 / 255.0, 231 / 255.0);
    for (const auto& [name, text] : {std::pair{"v.ply", by_vertex}, {"f.ply", by_face}, {"v.obj", obj}}) {
        CAPTURE(name);
        MeshCleaningReport report;
        SurfaceAppearance look;
        const Mesh mesh = import_mesh(folder.file(name, text), {}, report, &look);
        REQUIRE(look.says_something());
        int corner = 0;
        while (mesh.positions[mesh.triangles[0][corner]] != glm::vec3(0.0f))
            ++corner;
        const glm::vec2 place(corner == 1 ? 1.0f : 0.0f, corner == 2 ? 1.0f : 0.0f);
        CHECK(glm::length(look_at(look, 0, place).colour - glm::vec3(0.0513f, 0.2016f, 0.7991f)) < 2e-4f);
        CHECK(look_at(look, 0, place).roughness == 1.0f);
    }
}

namespace {

/// A picture of one normal all over, its codes; and what it says with x and y times `scale`.
constexpr glm::u8vec3 leaning_codes{218, 64, 230};
glm::vec3 leaning_normal(float scale) {
    const glm::vec3 n = glm::vec3(leaning_codes) / 127.5f - 1.0f;
    return glm::normalize(glm::vec3(scale * n.x, scale * n.y, n.z));
}

} // namespace

TEST_CASE("normals are read of the pictures that glTF and .mtl files name", "[unit]") {
    const test::TemporaryFolder folder;
    folder.file("bumps.png", test::png_of({1, 1}, {leaning_codes}));
    MeshCleaningReport report;
    // glTF: the picture's scale, its own set of places, and no bumps where there is no picture.
    test::GlbMaker maker;
    const Mesh cube = test::cube();
    nlohmann::json primitive = maker.primitive(cube);
    const std::vector<glm::vec2> places(cube.positions.size(), glm::vec2(0.5f));
    primitive["attributes"]["TEXCOORD_0"] = maker.floats<2>(places);
    primitive["attributes"]["TEXCOORD_1"] = maker.floats<2>(places);
    primitive["material"] = maker.painted_material(test::png_of({1, 1}, {{1, 2, 3}}));
    const int image = maker.add("images", {{"uri", "bumps.png"}});
    nlohmann::json& material = maker.json["materials"][0];
    material["normalTexture"] = {
        {"index", maker.add("textures", {{"source", image}})}, {"scale", 0.5}, {"texCoord", 1}};
    maker.show({primitive});
    SurfaceAppearance look;
    Mesh mesh = import_mesh(folder.file("bumps.gltf", maker.gltf()), {}, report, &look);
    REQUIRE(has_bumps(look));
    CHECK(look.materials[0].normal_scale == 0.5f);
    CHECK(look.materials[0].normal_picture.uv_set == 1);
    CHECK(look.pictures.at(static_cast<std::size_t>(look.materials[0].normal_picture.picture))->file ==
          "bumps.png");
    for (std::uint32_t triangle = 0; triangle < mesh.triangles.size(); ++triangle)
        CHECK(glm::length(bump_at(look, triangle, {0.3f, 0.2f}) - leaning_normal(0.5f)) < 1e-5f);
    material.erase("normalTexture");
    look = {};
    mesh = import_mesh(folder.file("flat.gltf", maker.gltf()), {}, report, &look);
    CHECK_FALSE(has_bumps(look));
    CHECK(bump_at(look, 0, {0.3f, 0.2f}) == glm::vec3(0, 0, 1));

    // OBJ: `norm`.
    folder.file("m.mtl", "newmtl leaning\nKd 1 1 1\nnorm bumps.png\n");
    const std::filesystem::path obj =
        folder.file("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                             "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                             "usemtl leaning\nf 1/1 2/2 3/3 4/4\n");
    look = {};
    mesh = import_mesh(obj, {}, report, &look);
    REQUIRE(has_bumps(look));
    for (std::uint32_t triangle = 0; triangle < mesh.triangles.size(); ++triangle)
        CHECK(glm::length(bump_at(look, triangle, {0.3f, 0.2f}) - leaning_normal(1.0f)) < 1e-5f);
}
