#include "experiment/scene/files/gltf_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/base/safe_text.h"
#include "experiment/scene/files/draco_primitive.h"
#include "experiment/scene/files/gltf_accessor.h"
#include "experiment/scene/files/gltf_materials.h"
#include "experiment/scene/files/gltf_nodes.h"
#include "experiment/scene/files/mesh_text.h"
#include "experiment/scene/files/triangle_labels.h"

namespace overt {
namespace {

constexpr std::array extensions_read{std::string_view("KHR_texture_transform"),
                                     std::string_view("KHR_mesh_quantization"),
                                     std::string_view("KHR_lights_punctual"),
                                     std::string_view("EXT_texture_webp"),
                                     std::string_view("KHR_texture_basisu"),
                                     std::string_view("KHR_xmp_json_ld"),
                                     std::string_view("EXT_meshopt_compression"),
                                     std::string_view("KHR_meshopt_compression"),
                                     draco_extension};

/// Extensions that the file cannot be read without.
void expect_known_extensions(const GltfValue& root) {
    const std::optional<GltfValue> required = root.find("extensionsRequired");
    for (std::size_t i = 0; required && i < required->size(); ++i) {
        const GltfValue item = required->item(i);
        const std::string& name = item.text();
        // Those of materials are said of each material; those of pictures where a picture has no other form.
        if (std::ranges::find(extensions_read, std::string_view(name)) != extensions_read.end() ||
            name.starts_with("KHR_materials_"))
            continue;
        if (name.find("gaussian_splatting") != std::string::npos)
            item.fail("this holds points, not triangles: mesh it first.");
        item.fail(fmt::format("needs the extension {}, which overt does not read; export without it.",
                              MeshText::quoted(name)));
    }
}

class GltfReader {
  public:
    GltfReader(const MeshSource& source, MeshWanted wanted)
        : content_(read_gltf_content(source)), root_(source, content_.json, ""), buffers_(root_, content_),
          accessors_(root_, buffers_), wants_look_(wanted == MeshWanted::appearance) {}

    RawMesh read() {
        expect_known_extensions(root_);
        mesh_.material_names = gltf_material_names(root_);
        if (wants_look_)
            materials_ = read_gltf_materials(root_, buffers_, mesh_.appearance);
        for (const PlacedGltfMesh& placed : placed_gltf_meshes(root_))
            add_mesh(placed);
        if (mesh_.triangles.empty())
            root_.fail(left_primitives_ > 0 ? "this holds points or lines, not triangles: mesh it first."
                                            : "this file has no triangles; a surface is needed.");
        say_what_is_left();
        keep_labels_if_several();
        if (wants_look_)
            finish_look();
        return std::move(mesh_);
    }

  private:
    void add_mesh(const PlacedGltfMesh& placed) {
        expect_no_morphs(placed);
        const auto [label, is_new] = labels_.try_emplace(placed.name, static_cast<PartLabel>(labels_.size()));
        if (is_new)
            label_names_.push_back(placed.name);
        const GltfValue primitives = placed.mesh.at("primitives");
        for (std::size_t i = 0; i < primitives.size(); ++i)
            add_primitive(primitives.item(i), placed.scene_from_mesh, label->second);
    }

    static void expect_no_morphs(const PlacedGltfMesh& placed) {
        std::optional<GltfValue> weights = placed.node.find("weights");
        if (!weights)
            weights = placed.mesh.find("weights");
        for (std::size_t i = 0; weights && i < weights->size(); ++i)
            if (weights->item(i).number() != 0.0)
                weights->fail(fmt::format("mesh {} is shaped by morph targets: apply them and export again.",
                                          MeshText::quoted(placed.name)));
    }

    void add_primitive(const GltfValue& primitive, const glm::dmat4& scene_from_mesh, PartLabel label) {
        const std::uint64_t mode = primitive.whole_or("mode", 4);
        if (mode > 6)
            primitive.at("mode").fail("a mode from 0 to 6 is expected here.");
        if (mode < 4) {
            ++left_primitives_;
            return;
        }
        if (const std::optional<GltfValue> extensions = primitive.find("extensions")) {
            if (extensions->find("KHR_materials_variants"))
                has_variants_ = true;
        }
        const GltfValue attributes = primitive.at("attributes");
        const GltfValue position = attributes.at("POSITION");
        expect_room(accessors_.count(position), position);
        unpack(primitive, mode);
        const GltfNumbers places = numbers_of(attributes, "POSITION", {"VEC3"});
        const std::size_t count = places.count();
        const auto first_vertex = static_cast<std::uint32_t>(mesh_.positions.size());
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec4 in_mesh(places[i][0], places[i][1], places[i][2], 1.0);
            const glm::dvec3 place(scene_from_mesh * in_mesh);
            if (!is_coordinate(place.x) || !is_coordinate(place.y) || !is_coordinate(place.z))
                position.fail(fmt::format(
                    "its node makes the coordinates of vertex {} too large for a 32-bit float.", i));
            mesh_.positions.push_back(place);
        }
        const bool turns = glm::determinant(glm::dmat3(scene_from_mesh)) < 0.0;
        const std::vector<glm::uvec3> triangles = triangles_of(primitive, mode, count, turns);
        for (const glm::uvec3& triangle : triangles)
            mesh_.triangles.push_back(triangle + first_vertex);
        mesh_.triangle_labels.resize(mesh_.triangles.size(), label);
        add_areas(attributes, triangles, count);
        const std::uint16_t material = material_of(primitive);
        mesh_.triangle_materials.resize(mesh_.triangles.size(), material);
        if (wants_look_)
            add_look(primitive, attributes, material, triangles, count);
    }

    /// What Draco packed of a primitive, if it did.
    void unpack(const GltfValue& primitive, std::uint64_t mode) {
        draco_.reset();
        const std::optional<GltfValue> extensions = primitive.find("extensions");
        const std::optional<GltfValue> packed = extensions ? extensions->find(draco_extension) : std::nullopt;
        if (!packed)
            return;
        if (mode != 4 && mode != 5)
            primitive.at("mode").fail("Draco packs triangles and strips.");
        packed->at("attributes").at("POSITION"); // its corners are vertices that it packs
        // Strips are told by their own indices; what is packed are triangles.
        const std::uint64_t corners = accessors_.count(primitive.at("indices"));
        draco_.emplace(*packed, buffers_.view(packed->at("bufferView")).bytes,
                       mode == 4 ? std::optional(corners) : std::nullopt);
    }

    /// Of each vertex of the primitive.
    GltfNumbers numbers_of(const GltfValue& attributes, std::string_view name,
                           std::initializer_list<std::string_view> types) {
        const GltfValue index = attributes.at(name);
        return draco_ && draco_->has(name) ? draco_->numbers(name, accessors_.form(index, types))
                                           : accessors_.numbers(index, types);
    }

    /// By an attribute _AOI: a whole number for each vertex, as Blender exports the attribute of a face, with
    /// the same number at its corners. Where they differ, the middle one of the three.
    void add_areas(const GltfValue& attributes, const std::vector<glm::uvec3>& triangles, std::size_t count) {
        const std::optional<GltfValue> index = attributes.find("_AOI");
        if (!index)
            return;
        const GltfNumbers numbers = numbers_of(attributes, "_AOI", {"SCALAR"});
        expect_count(*index, numbers, count);
        std::vector<PartLabel> labels;
        for (std::size_t i = 0; i < count; ++i) {
            const double number = numbers[i][0];
            constexpr double most = 1e6, most_off = 0.01;
            if (std::abs(number) > most || std::abs(number - std::round(number)) > most_off)
                index->fail(fmt::format("vertex {} has the area {}: a whole number is expected.", i, number));
            labels.push_back(static_cast<PartLabel>(std::lround(number)));
        }
        area_labels_.resize(mesh_.triangles.size() - triangles.size(), 0);
        for (const glm::uvec3& triangle : triangles)
            area_labels_.push_back(middle_label(labels[triangle.x], labels[triangle.y], labels[triangle.z]));
    }

    /// A file may have the same numbers placed a million times: what it makes is held against what it has.
    void expect_room(std::size_t more_vertices, const GltfValue& whose) {
        vertices_ += more_vertices;
        constexpr std::size_t always = 4'000'000, for_each_byte = 4;
        if (vertices_ > max_mesh_vertices || vertices_ > always + for_each_byte * buffers_.bytes_there())
            whose.fail(
                fmt::format("with these the file makes {} vertices of the few bytes that it has; place its "
                            "meshes less often.",
                            vertices_));
    }

    std::vector<glm::uvec3> triangles_of(const GltfValue& primitive, std::uint64_t mode, std::size_t count,
                                         bool turns) {
        std::vector<std::uint32_t> indices;
        const std::optional<GltfValue> of_file = primitive.find("indices");
        if (of_file) {
            corners_ += accessors_.count(*of_file);
            constexpr std::size_t always = 16'000'000, for_each_byte = 16;
            if (corners_ > always + for_each_byte * buffers_.bytes_there())
                of_file->fail(
                    "with these the file makes more triangles than its bytes can mean; place its meshes "
                    "less often.");
            indices = draco_ ? draco_->corners() : accessors_.indices(*of_file, count);
        } else {
            indices.resize(count);
            for (std::size_t i = 0; i < count; ++i)
                indices[i] = static_cast<std::uint32_t>(i);
        }
        if (mode == 4 && indices.size() % 3 != 0)
            primitive.fail(
                fmt::format("has {} corners, which make no whole number of triangles.", indices.size()));
        std::vector<glm::uvec3> triangles;
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            triangles.push_back(turns ? glm::uvec3(a, c, b) : glm::uvec3(a, b, c));
        };
        if (mode == 4 || draco_) {
            for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
                add(indices[i], indices[i + 1], indices[i + 2]);
            return triangles;
        }
        for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
            const std::uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
            if (mode == 6)
                add(b, c, indices[0]);
            // Strips are joined by triangles with a corner twice, which are no surface.
            else if (a != b && b != c && c != a)
                i % 2 == 0 ? add(a, b, c) : add(a, c, b);
        }
        return triangles;
    }

    /// The primitive's material, or one that is added for all without.
    std::uint16_t material_of(const GltfValue& primitive) {
        std::uint64_t number = 0;
        if (const std::optional<GltfValue> index = primitive.find("material")) {
            gltf_entry(root_, "materials", *index);
            number = index->whole();
        } else {
            if (!without_material_) {
                without_material_ = mesh_.material_names.size();
                mesh_.material_names.emplace_back("no material");
                if (wants_look_) {
                    GltfMaterial& none = materials_.emplace_back();
                    none.look.name = mesh_.material_names.back();
                    none.look.roughness = 1.0f;
                    none.pointer = primitive.pointer();
                }
            }
            number = *without_material_;
        }
        if (number > std::numeric_limits<std::uint16_t>::max())
            primitive.fail("more materials than 65,535 cannot be told apart.");
        return static_cast<std::uint16_t>(number);
    }

    void add_look(const GltfValue& primitive, const GltfValue& attributes, std::uint16_t material,
                  const std::vector<glm::uvec3>& triangles, std::size_t count) {
        SurfaceAppearance& look = mesh_.appearance;
        const std::size_t before = mesh_.triangles.size() - triangles.size();
        for (std::size_t set = 0; set < 2; ++set) {
            if (!materials_[material].needs_uvs[set])
                continue;
            const std::string name = fmt::format("TEXCOORD_{}", set);
            const std::optional<GltfValue> index = attributes.find(name);
            if (!index)
                primitive.fail(
                    fmt::format("its material {} has a picture, but it does not say where on it its corners "
                                "lie ({}): unwrap it, or give it another material.",
                                MeshText::quoted(materials_[material].look.name), name));
            const GltfNumbers uvs = numbers_of(attributes, name, {"VEC2"});
            expect_count(*index, uvs, count);
            look.uvs[set].resize(before);
            for (const glm::uvec3& triangle : triangles) {
                CornerUvs& corners = look.uvs[set].emplace_back();
                for (int corner = 0; corner < 3; ++corner)
                    corners[static_cast<std::size_t>(corner)] = {uvs[triangle[corner]][0],
                                                                 uvs[triangle[corner]][1]};
            }
        }
        if (const std::optional<GltfValue> index = attributes.find("COLOR_0")) {
            const GltfNumbers colours = numbers_of(attributes, "COLOR_0", {"VEC3", "VEC4"});
            expect_count(*index, colours, count);
            constexpr CornerColours white{glm::vec3(1.0f), glm::vec3(1.0f), glm::vec3(1.0f)};
            look.colours.resize(before, white);
            for (const glm::uvec3& triangle : triangles) {
                CornerColours& corners = look.colours.emplace_back();
                for (int corner = 0; corner < 3; ++corner) {
                    const float* const colour = colours[triangle[corner]];
                    corners[static_cast<std::size_t>(corner)] =
                        glm::clamp(glm::vec3(colour[0], colour[1], colour[2]), 0.0f, 1.0f);
                }
            }
        }
    }

    static void expect_count(const GltfValue& index, const GltfNumbers& numbers, std::size_t count) {
        if (numbers.count() != count)
            index.fail(fmt::format("has {} elements, but POSITION has {}; each vertex has one of each.",
                                   numbers.count(), count));
    }

    void keep_labels_if_several() {
        if (!area_labels_.empty()) {
            area_labels_.resize(mesh_.triangles.size(), 0);
            mesh_.triangle_labels = std::move(area_labels_);
            mesh_.are_areas_labelled = true;
            return;
        }
        if (labels_.size() < 2) {
            mesh_.triangle_labels = {};
            return;
        }
        for (const PartLabel label : mesh_.triangle_labels)
            mesh_.part_names.try_emplace(label, label_names_[static_cast<std::size_t>(label)]);
    }

    void finish_look() {
        SurfaceAppearance& look = mesh_.appearance;
        const std::size_t triangles = mesh_.triangles.size();
        for (std::vector<CornerUvs>& set : look.uvs)
            if (!set.empty())
                set.resize(triangles);
        if (!look.colours.empty())
            look.colours.resize(triangles, {glm::vec3(1.0f), glm::vec3(1.0f), glm::vec3(1.0f)});
        for (const GltfMaterial& material : materials_)
            look.materials.push_back(material.look);
        look.triangle_materials = mesh_.triangle_materials;
        expect_no_holes();
        look.triangle_materials = {};
        // Triangles without any material, colour or picture say nothing.
        if (without_material_ && look.materials.size() == 1 && look.colours.empty())
            look.materials = {};
    }

    /// The hidden map knows whole triangles: a surface with holes in it would be shown otherwise than looked
    /// at.
    void expect_no_holes() const {
        const SurfaceAppearance& look = mesh_.appearance;
        for (std::uint32_t triangle = 0; triangle < look.triangle_materials.size(); ++triangle) {
            const GltfMaterial& material = materials_[look.triangle_materials[triangle]];
            if (material.least_alpha <= 0.0f)
                continue;
            constexpr int side = 8;
            for (int i = 0; i < side * side; ++i) {
                glm::vec2 place((static_cast<float>(i % side) + 0.5f) / side,
                                (static_cast<float>(i / side) + 0.5f) / side);
                if (place.x + place.y > 1.0f)
                    place = 1.0f - place;
                if (material.alpha * alpha_at(look, triangle, place) < material.least_alpha)
                    mesh_source().fail(fmt::format("{}: material {} has holes (alpha): the hidden map knows "
                                                   "whole triangles. Cut the holes into "
                                                   "the mesh, or set its alpha mode to OPAQUE.",
                                                   material.pointer, MeshText::quoted(material.look.name)));
            }
        }
    }

    void say_what_is_left() {
        std::vector<std::string>& remarks = mesh_.remarks;
        if (const std::vector<std::string> files = buffers_.files(); !files.empty())
            remarks.push_back(MeshText::files_beside(files));
        const auto count_of = [&](const GltfValue& of, std::string_view list) {
            const std::optional<GltfValue> entries = of.find(list);
            return entries ? entries->size() : 0;
        };
        if (left_primitives_ > 0)
            remarks.push_back(
                fmt::format("Left aside: {} of points or lines.", counted(left_primitives_, "primitive")));
        if (const std::size_t animations = count_of(root_, "animations"))
            remarks.push_back(
                fmt::format("Not played: {} of the file; the protocol's [[motion]] moves the object.",
                            counted(animations, "animation")));
        const std::size_t cameras = count_of(root_, "cameras");
        std::size_t lights = 0;
        if (const std::optional<GltfValue> extensions = root_.find("extensions"))
            if (const auto punctual = extensions->find("KHR_lights_punctual"))
                lights = count_of(*punctual, "lights");
        if (cameras + lights > 0)
            remarks.push_back(
                fmt::format("Left aside: {} and {} of the file; [[view]] and [[light]] say where they stand.",
                            counted(cameras, "camera"), counted(lights, "light")));
        if (has_variants_)
            remarks.emplace_back("The file has variants of its materials; the first is shown.");
        if (const std::optional<GltfValue> extras = root_.at("asset").find("extras")) {
            std::vector<std::string> origin;
            for (const std::string_view key : {"title", "author", "license", "source"})
                if (const auto text = extras->find(key); text && text->is_text())
                    origin.push_back(fmt::format("{} {}", key, printable_text(text->text())));
            if (!origin.empty())
                remarks.push_back(fmt::format("The file says of its origin: {}.", fmt::join(origin, "; ")));
        }
    }

    const MeshSource& mesh_source() const { return root_.source(); }

    const GltfContent content_;
    const GltfValue root_;
    GltfBuffers buffers_;
    GltfAccessors accessors_;
    std::optional<DracoPrimitive> draco_; ///< of the primitive at hand
    const bool wants_look_;
    RawMesh mesh_;
    std::vector<GltfMaterial> materials_;
    std::map<std::string, PartLabel> labels_;
    std::vector<std::string> label_names_;
    std::vector<PartLabel> area_labels_; ///< of triangles, by the attribute _AOI; empty: there is none
    std::optional<std::size_t> without_material_;
    std::size_t vertices_ = 0, corners_ = 0, left_primitives_ = 0;
    bool has_variants_ = false;
};

} // namespace

bool is_gltf(const MeshSource& source) {
    const std::string_view bytes = source.bytes();
    if (bytes.starts_with("glTF"))
        return true;
    const std::size_t first = bytes.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && bytes[first] == '{';
}

RawMesh read_gltf(const MeshSource& source, MeshWanted wanted) { return GltfReader(source, wanted).read(); }

} // namespace overt
