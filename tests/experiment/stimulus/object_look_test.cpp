#include <catch2/catch.hpp>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/checks/checked_protocol.h"
#include "experiment/stimulus/object.h"
#include "tests/experiment/scene/mesh_fixtures.h"
#include "tests/support/glb_maker.h"

using namespace overt;

namespace {

/// A box of 1 x 2 x 3 in its file's own coordinates, painted, or of a material that is given.
test::GlbMaker painted_gltf_box(const nlohmann::json& material = {}) {
    test::GlbMaker maker;
    Mesh box = test::cube();
    for (glm::vec3& position : box.positions)
        position *= glm::vec3(1.0f, 2.0f, 3.0f);
    nlohmann::json primitive = maker.primitive(box);
    primitive["attributes"]["TEXCOORD_0"] = maker.floats<2>(std::vector<glm::vec2>(8, glm::vec2(0.5f)));
    primitive["material"] = maker.painted_material(test::png_of({1, 1}, {{200, 100, 50}}));
    if (!material.is_null())
        maker.json["materials"][0].update(material);
    maker.show({primitive});
    return maker;
}

std::optional<Protocol> look_protocol(const std::filesystem::path& folder, std::string_view mesh,
                                      std::string_view material, Diagnostics& diagnostics) {
    const std::string text =
        fmt::format("[protocol]\nname = \"looks\"\n[[object]]\nid = \"thing\"\nmesh = \"{}\"\n"
                    "[[material]]\nid = \"m\"\n{}\n[[task]]\nid = \"t\"\nquestion = \"?\"\n",
                    mesh, material);
    return read_protocol_text(text, folder / "p.toml", {}, diagnostics);
}

std::vector<Object> loaded_looks(const std::filesystem::path& folder, std::string_view mesh,
                                 std::string_view material) {
    Diagnostics diagnostics;
    const std::optional<Protocol> protocol = look_protocol(folder, mesh, material, diagnostics);
    INFO(diagnostics.print());
    REQUIRE(protocol.has_value());
    return load_objects(*protocol, folder / "cache");
}

} // namespace

TEST_CASE("glTF stands upright in millimetres by itself, and is read for its look only where a material asks",
          "[unit]") {
    const test::TemporaryFolder folder;
    folder.file("box.glb", painted_gltf_box().glb());
    const Object own = loaded_looks(folder.path(), "box.glb", "kind = \"own\"").at(0);
    // +y of the file is up, and metres are its unit.
    CHECK(glm::length(own.mesh->bounds().extent() - glm::dvec3(1000.0, 3000.0, 2000.0)) < 1e-3);
    REQUIRE(own.appearance);
    CHECK(look_at(*own.appearance, 3, {0.2f, 0.2f}).colour.x == Approx(linear_of_srgb(200)));
    const Object matt = loaded_looks(folder.path(), "box.glb", "kind = \"diffuse\"").at(0);
    CHECK_FALSE(matt.appearance);
    CHECK(own.appearance_files == "box.glb; images[0]");
    CHECK(matt.appearance_files.empty());
    CHECK(matt.mesh_hash == own.mesh_hash);
    CHECK(
        loaded_looks(folder.path(), "box.glb", "kind = \"plastic\"\nbase = \"own\"").at(0).appearance_hash ==
        own.appearance_hash);
}

TEST_CASE("a material of the file's own needs a file that says something, and says how photographs are meant",
          "[unit]") {
    const test::TemporaryFolder folder;
    folder.file("plain.obj", test::as_obj(test::cube()));
    CHECK_THROWS_WITH(loaded_looks(folder.path(), "plain.obj", "kind = \"own\""),
                      Catch::Contains("plain.obj: object") && Catch::Contains("it says nothing"));
    CHECK_NOTHROW(loaded_looks(folder.path(), "plain.obj", "kind = \"diffuse\""));
    folder.file(
        "photo.glb",
        painted_gltf_box({{"extensions", {{"KHR_materials_unlit", nlohmann::json::object()}}}}).glb());
    CHECK_THROWS_WITH(loaded_looks(folder.path(), "photo.glb", "kind = \"own\""),
                      Catch::Contains("KHR_materials_unlit") && Catch::Contains("base = \"own\""));
    CHECK_NOTHROW(loaded_looks(folder.path(), "photo.glb", "kind = \"diffuse\"\nbase = \"own\""));
    Diagnostics diagnostics;
    look_protocol(folder.path(), "photo.glb", "kind = \"diffuse\"\nbase = \"own\"\nreflectance = [1, 0, 0]",
                  diagnostics);
    CHECK_THAT(diagnostics.print(), Catch::Contains("p.toml:10:") && Catch::Contains("has no effect"));
}
