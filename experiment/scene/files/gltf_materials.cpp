#include "experiment/scene/files/gltf_materials.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/base/safe_text.h"
#include "experiment/scene/files/mesh_text.h"
#include "experiment/scene/files/picture_bytes.h"

namespace overt {
namespace {

class MaterialReader {
  public:
    MaterialReader(const GltfValue& root, GltfBuffers& buffers, SurfaceAppearance& appearance)
        : root_(root), buffers_(&buffers), appearance_(&appearance) {}

    GltfMaterial read(const GltfValue& of, const std::string& name) {
        GltfMaterial material;
        material.pointer = of.pointer();
        FileMaterial& look = material.look;
        look.name = name;
        look.metallic = 1.0f;
        look.roughness = 1.0f;
        if (has_extension(of, "KHR_materials_pbrSpecularGlossiness") && !of.find("pbrMetallicRoughness"))
            of.fail("is written in the old form of specular and glossiness; convert it to metallic-roughness "
                    "(gltf-transform metalrough does that).");
        bool has_metallic = false;
        if (const std::optional<GltfValue> pbr = of.find("pbrMetallicRoughness")) {
            if (const std::optional<GltfValue> colour = pbr->find("baseColorFactor")) {
                if (colour->size() != 4)
                    colour->fail("four numbers are expected here: red, green, blue and alpha.");
                for (int channel = 0; channel < 3; ++channel)
                    look.colour[channel] = share(colour->item(static_cast<std::size_t>(channel)));
                material.alpha = share(colour->item(3));
            }
            if (const std::optional<GltfValue> metallic = pbr->find("metallicFactor")) {
                look.metallic = share(*metallic);
                has_metallic = true;
            }
            if (const std::optional<GltfValue> roughness = pbr->find("roughnessFactor"))
                look.roughness = share(*roughness);
            look.colour_picture = placed(*pbr, "baseColorTexture");
            look.surface_picture = placed(*pbr, "metallicRoughnessTexture");
        }
        if (!has_metallic && look.surface_picture.picture < 0)
            remark(name,
                   "does not say whether it is metal: glTF then takes it for metal. If it is none, write "
                   "a metallicFactor of 0, or show it in a material of another kind with base = \"own\".");
        look.normal_picture = placed(of, "normalTexture");
        if (const std::optional<GltfValue> bumps = of.find("normalTexture"))
            look.normal_scale = static_cast<float>(bumps->number_or("scale", 1.0));
        read_alpha(of, material);
        say_what_is_left(of, name);
        look.is_unlit = has_extension(of, "KHR_materials_unlit");
        for (const SurfacePlacement* picture :
             {&look.colour_picture, &look.surface_picture, &look.normal_picture})
            if (picture->picture >= 0)
                material.needs_uvs[picture->uv_set] = true;
        return material;
    }

  private:
    void remark(const std::string& name, std::string_view words) {
        appearance_->remarks.push_back(fmt::format("Material {} {}", MeshText::quoted(name), words));
    }

    static float share(const GltfValue& of) {
        const double number = of.number();
        if (number < 0.0 || number > 1.0)
            of.fail("a number from 0 to 1 is expected here.");
        return static_cast<float>(number);
    }

    static bool has_extension(const GltfValue& of, std::string_view name) {
        const std::optional<GltfValue> extensions = of.find("extensions");
        return extensions && extensions->find(name);
    }

    void read_alpha(const GltfValue& of, GltfMaterial& material) {
        const std::string mode = of.text_or_empty("alphaMode");
        if (mode == "MASK")
            material.least_alpha = static_cast<float>(of.number_or("alphaCutoff", 0.5));
        else if (mode == "BLEND")
            material.least_alpha = 254.0f / 255.0f;
        else if (!mode.empty() && mode != "OPAQUE")
            of.at("alphaMode").fail("OPAQUE, MASK or BLEND is expected here.");
    }

    void say_what_is_left(const GltfValue& of, const std::string& name) {
        std::vector<std::string> left;
        if (of.find("occlusionTexture"))
            left.emplace_back("its occlusion, which paths find themselves");
        const std::optional<GltfValue> emission = of.find("emissiveFactor");
        bool gives_light = of.find("emissiveTexture") && emission;
        for (std::size_t i = 0; emission && i < emission->size(); ++i)
            gives_light = gives_light || emission->item(i).number() > 0.0;
        if (gives_light)
            left.emplace_back("the light that it gives off");
        if (const std::optional<GltfValue> extensions = of.find("extensions"))
            for (const std::string& key : extensions->keys())
                if (key != "KHR_materials_unlit")
                    left.push_back(printable_text(key));
        if (!left.empty())
            remark(name, fmt::format("has what is left aside: {}.", fmt::join(left, ", ")));
    }

    static PictureEdge edge_of(const GltfValue& sampler, std::string_view key) {
        switch (sampler.whole_or(key, 10497)) {
        case 10497:
            return PictureEdge::repeat;
        case 33071:
            return PictureEdge::clamp;
        case 33648:
            return PictureEdge::mirror;
        default:
            sampler.at(key).fail("10497 (repeat), 33071 (clamp) or 33648 (mirror) is expected here.");
        }
    }

    SurfacePlacement placed(const GltfValue& of, std::string_view key) {
        SurfacePlacement placed;
        const std::optional<GltfValue> info = of.find(key);
        if (!info)
            return placed;
        const GltfValue index = info->at("index"), texture = gltf_entry(root_, "textures", index);
        std::uint64_t uv_set = info->whole_or("texCoord", 0);
        if (const std::optional<GltfValue> extensions = info->find("extensions"))
            if (const auto moved = extensions->find("KHR_texture_transform")) {
                placed.offset = pair_or(*moved, "offset", placed.offset);
                placed.scale = pair_or(*moved, "scale", placed.scale);
                placed.turn_rad = moved->number_or("rotation", 0.0);
                uv_set = moved->whole_or("texCoord", uv_set);
            }
        if (uv_set > 1)
            info->fail("TEXCOORD_0 and TEXCOORD_1 are read; this picture lies by another.");
        placed.uv_set = static_cast<int>(uv_set);
        if (const std::optional<GltfValue> sampler_index = texture.find("sampler")) {
            const GltfValue sampler = gltf_entry(root_, "samplers", *sampler_index);
            placed.across = edge_of(sampler, "wrapS");
            placed.down = edge_of(sampler, "wrapT");
            placed.is_nearest = sampler.whole_or("magFilter", 9729) == 9728;
        }
        std::optional<GltfValue> source = texture.find("source");
        if (const auto extensions = texture.find("extensions"); !source && extensions)
            if (const auto webp = extensions->find("EXT_texture_webp"))
                source = webp->at("source");
        if (!source) {
            if (has_extension(texture, "KHR_texture_basisu"))
                texture.fail("its picture is KTX2 alone: convert it to PNG (gltf-transform or ktx do that).");
            texture.fail("it has no picture (\"source\").");
        }
        placed.picture = picture(*source);
        return placed;
    }

    static glm::dvec2 pair_or(const GltfValue& of, std::string_view key, glm::dvec2 otherwise) {
        const std::optional<GltfValue> found = of.find(key);
        if (!found)
            return otherwise;
        if (found->size() != 2)
            found->fail("two numbers are expected here.");
        return {found->item(0).number(), found->item(1).number()};
    }

    /// Its number in the appearance; each is read once.
    int picture(const GltfValue& index) {
        const GltfValue image = gltf_entry(root_, "images", index);
        const auto [known, is_new] =
            pictures_.try_emplace(index.whole(), static_cast<int>(appearance_->pictures.size()));
        if (!is_new)
            return known->second;
        std::string_view bytes;
        std::string file = fmt::format("images[{}]", index.whole());
        if (const std::optional<GltfValue> uri = image.find("uri")) {
            bytes = buffers_->resource(*uri);
            if (!uri->text().starts_with("data:"))
                file = printable_text(uri->text());
        } else {
            bytes = buffers_->view(image.at("bufferView")).bytes;
        }
        auto read = read_surface_picture(
            bytes, fmt::format("{}: {}", image.source().path().string(), image.pointer()), std::move(file));
        texels_ += read->texels.size();
        constexpr std::size_t most_texels = std::size_t{1} << 30;
        if (texels_ > most_texels)
            image.fail("the pictures of this file have more than 2^30 texels together; make them smaller.");
        appearance_->pictures.push_back(std::move(read));
        return known->second;
    }

    GltfValue root_;
    GltfBuffers* buffers_;
    SurfaceAppearance* appearance_;
    std::map<std::uint64_t, int> pictures_;
    std::size_t texels_ = 0;
};

} // namespace

std::vector<std::string> gltf_material_names(const GltfValue& root) {
    std::vector<std::string> names;
    const std::optional<GltfValue> materials = root.find("materials");
    for (std::size_t i = 0; materials && i < materials->size(); ++i) {
        const std::string name = materials->item(i).text_or_empty("name");
        names.push_back(name.empty() ? fmt::format("material {}", i) : printable_text(name));
    }
    return names;
}

std::vector<GltfMaterial> read_gltf_materials(const GltfValue& root, GltfBuffers& buffers,
                                              SurfaceAppearance& appearance) {
    MaterialReader reader(root, buffers, appearance);
    const std::vector<std::string> names = gltf_material_names(root);
    std::vector<GltfMaterial> materials;
    for (std::size_t i = 0; i < names.size(); ++i)
        materials.push_back(reader.read(root.at("materials").item(i), names[i]));
    return materials;
}

} // namespace overt
