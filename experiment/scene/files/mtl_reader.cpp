#include "experiment/scene/files/mtl_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/path_inside.h"
#include "experiment/base/safe_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/scene/files/mesh_text.h"
#include "experiment/scene/files/picture_bytes.h"

namespace overt {
namespace {

/// Of a picture beside a mesh, as its file has it.
constexpr std::size_t most_picture_file_bytes = std::size_t{1} << 30;

/// Options before the name of a picture, and how many words at most follow each.
constexpr std::pair<std::string_view, int> picture_options[] = {
    {"-blendu", 1}, {"-blendv", 1}, {"-boost", 1}, {"-mm", 2}, {"-o", 3},    {"-s", 3},      {"-t", 3},
    {"-texres", 1}, {"-clamp", 1},  {"-bm", 1},    {"-cc", 1}, {"-type", 1}, {"-imfchan", 1}};

} // namespace

class MtlLibrary::Reader {
  public:
    Reader(MtlLibrary& library, const MeshSource& source)
        : library_(library), source_(source), text_(source) {}

    void read() {
        do {
            const std::string_view word = text_.next_in_line();
            if (word == "newmtl")
                begin_material();
            else if (material_)
                read_statement(word);
        } while (text_.to_next_line());
        end_material();
    }

  private:
    void begin_material() {
        end_material();
        std::string name(text_.rest_of_line());
        name.erase(name.find_last_not_of(" \t") + 1);
        material_.emplace();
        material_->name = printable_text(name);
        material_->roughness = 1.0f;
        name_ = name;
        shininess_ = roughness_ = {};
        has_factor_ = false;
    }

    void end_material() {
        if (!material_)
            return;
        if (roughness_)
            material_->roughness = *roughness_;
        else if (shininess_)
            material_->roughness = static_cast<float>(std::pow(2.0 / (*shininess_ + 2.0), 0.25));
        if (has_factor_ && material_->colour_picture.picture >= 0 && material_->colour != glm::vec3(1.0f))
            remark(fmt::format(
                "darkens its picture by its Kd, {:.3g} {:.3g} {:.3g}; where the program that wrote it "
                "did not mean that, write Kd 1 1 1.",
                material_->colour.x, material_->colour.y, material_->colour.z));
        library_.materials_.try_emplace(name_, *material_);
        material_.reset();
    }

    void remark(const std::string& words) {
        library_.appearance_->remarks.push_back(
            fmt::format("Material {} {}", MeshText::quoted(material_->name), words));
    }

    void read_statement(std::string_view word) {
        if (word == "Kd") {
            read_colour();
        } else if (word == "Ns") {
            shininess_ = std::max(0.0, number());
        } else if (word == "Pr") {
            roughness_ = static_cast<float>(std::clamp(number(), 0.0, 1.0));
        } else if (word == "Pm") {
            material_->metallic = static_cast<float>(std::clamp(number(), 0.0, 1.0));
        } else if (word == "illum") {
            if (const double model = number(); model == 0.0 || model == 1.0)
                roughness_ = 1.0f; // no gloss
        } else if (word == "d" || word == "Tr") {
            const double given = number();
            if (const double solid = word == "d" ? given : 1.0 - given; solid < 254.0 / 255.0)
                remark(fmt::format("is seen through ({} {:.3g}): it is shown solid.", word, given));
        } else if (word == "map_Kd") {
            material_->colour_picture = placed_picture();
        } else if (word == "norm") {
            material_->normal_picture = placed_picture();
        } else if (word.starts_with("map_") || word == "bump" || word == "disp" || word == "decal" ||
                   word == "refl") {
            remark(fmt::format("has {}, which is left aside.", printable_text(word)));
        }
    }

    double number() {
        const std::string_view word = text_.next_in_line();
        const std::optional<double> value = MeshText::number_in(word);
        if (!value || !std::isfinite(*value))
            text_.fail(fmt::format("{} is no number.", MeshText::quoted(word)));
        return *value;
    }

    void read_colour() {
        const std::string_view first = text_.next_in_line();
        if (first == "spectral" || first == "xyz")
            text_.fail("colours are read as red, green and blue.");
        const std::optional<double> red = MeshText::number_in(first);
        if (!red || !std::isfinite(*red))
            text_.fail(fmt::format("{} is no number.", MeshText::quoted(first)));
        std::array<double, 3> colour{*red, *red, *red}; // one number is grey
        for (std::size_t channel = 1; channel < 3; ++channel) {
            const std::string_view word = text_.next_in_line();
            if (word.empty() || word.front() == '#')
                break;
            const std::optional<double> value = MeshText::number_in(word);
            if (!value || !std::isfinite(*value))
                text_.fail(fmt::format("{} is no number.", MeshText::quoted(word)));
            colour[channel] = *value;
        }
        for (std::size_t channel = 0; channel < 3; ++channel)
            material_->colour[static_cast<int>(channel)] =
                static_cast<float>(std::clamp(colour[channel], 0.0, 1.0));
        has_factor_ = true;
    }

    SurfacePlacement placed_picture() {
        SurfacePlacement placed;
        glm::dvec2 scale(1.0), offset(0.0);
        std::string_view word = text_.next_in_line();
        while (true) {
            const auto* const option =
                std::ranges::find(picture_options, word, [](const auto& row) { return row.first; });
            if (option == std::end(picture_options))
                break;
            const std::string_view name = word;
            word = text_.next_in_line();
            for (int i = 0; i < option->second; ++i) {
                const std::optional<double> value = MeshText::number_in(word);
                if (option->second > 1 && !value)
                    break; // fewer numbers than there can be
                if (name == "-clamp" && word == "on")
                    placed.across = placed.down = PictureEdge::clamp;
                if (value && i < 2 && std::isfinite(*value) && (name == "-s" || name == "-o"))
                    (name == "-s" ? scale : offset)[i] = *value;
                word = text_.next_in_line();
            }
        }
        // v runs upwards in these files, and downwards in ours.
        placed.scale = scale;
        placed.offset = {offset.x, 1.0 - scale.y - offset.y};
        if (word.empty())
            text_.fail("the name of a picture is missing.");
        const TextPlace place = text_.place();
        std::string name(word);
        // Names may have blanks.
        if (const std::string_view rest = text_.rest_of_line(); !rest.empty())
            name.append(" ").append(rest);
        name.erase(name.find_last_not_of(" \t") + 1);
        placed.picture = picture(std::move(name), place);
        return placed;
    }

    int picture(std::string name, TextPlace place) {
        std::ranges::replace(name, '\\', '/');
        const std::filesystem::path folder = source_.path().parent_path();
        const auto [known, is_new] = library_.pictures_.try_emplace(
            (folder / name).lexically_normal(), static_cast<int>(library_.appearance_->pictures.size()));
        if (!is_new)
            return known->second;
        if (!stays_inside(name))
            source_.fail_at(
                place.line, place.column,
                fmt::format("refers to {} outside its folder; put the picture beside it and write its name "
                            "alone.",
                            MeshText::quoted(name)));
        if (const std::string why = why_no_file_inside(folder, name); !why.empty())
            source_.fail_at(place.line, place.column,
                            fmt::format("the picture {} {}.", MeshText::quoted(name), why));
        const std::string bytes = read_whole_file(folder / name, most_picture_file_bytes);
        library_.files_.push_back(printable_text(name));
        library_.appearance_->pictures.push_back(read_surface_picture(bytes, (folder / name).string(), name));
        return known->second;
    }

    MtlLibrary& library_;
    const MeshSource& source_;
    MeshText text_;
    std::optional<FileMaterial> material_;
    std::string name_;
    std::optional<double> shininess_;
    std::optional<float> roughness_;
    bool has_factor_ = false;
};

void MtlLibrary::read(const std::filesystem::path& file) {
    const MeshSource source(file);
    files_.push_back(printable_text(file.filename().string()));
    Reader(*this, source).read();
}

const FileMaterial* MtlLibrary::find(const std::string& name) const {
    const auto found = materials_.find(name);
    return found == materials_.end() ? nullptr : &found->second;
}

} // namespace overt
