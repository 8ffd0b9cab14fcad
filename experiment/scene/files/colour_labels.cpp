#include "experiment/scene/files/colour_labels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

/// What a colour may lose on its way through programs that reckon with it.
constexpr int most_codes_off = 2;
/// Of the area: what soft brushes leave at edges; more is a colour that was forgotten.
constexpr double most_without_colour = 0.05;
/// Of the area: more than borders of regions are on a mesh that is fine enough for them.
constexpr double most_mixed = 0.1;

/// The code of linear light, by sRGB (IEC 61966-2-1).
int srgb_code(float linear) {
    const double light = std::clamp(static_cast<double>(linear), 0.0, 1.0);
    const double share = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
    return static_cast<int>(std::lround(255.0 * share));
}

glm::ivec3 code_of(glm::vec3 linear) {
    return {srgb_code(linear.x), srgb_code(linear.y), srgb_code(linear.z)};
}

int distance(glm::ivec3 a, glm::ivec3 b) {
    const glm::ivec3 off = glm::abs(a - b);
    return std::max({off.x, off.y, off.z});
}

/// The middles of the 16 triangles that halving twice makes of one, as places for look_at().
std::vector<glm::vec2> places_within() {
    std::vector<glm::vec2> places;
    constexpr int steps = 4;
    for (int row = 0; row < steps; ++row)
        for (int column = 0; row + column < steps; ++column) {
            const glm::vec2 corner(static_cast<float>(column) / steps, static_cast<float>(row) / steps);
            constexpr float third = 1.0f / (3 * steps);
            places.push_back(corner + third);
            if (row + column + 1 < steps)
                places.push_back(corner + 2.0f * third);
        }
    return places;
}

bool has_picture(const SurfaceAppearance& look, std::uint32_t triangle) {
    return !look.materials.empty() && look.material_of(triangle).colour_picture.picture >= 0;
}

/// Whose name each colour's label is.
std::vector<PartLabel> labels_of_colours(std::span<const PartColour> colours,
                                         std::map<PartLabel, std::string>& names) {
    std::vector<PartLabel> labels;
    for (std::size_t i = 0; i < colours.size(); ++i) {
        PartLabel label = static_cast<PartLabel>(names.size());
        for (std::size_t other = 0; other < i; ++other) {
            if (colours[other].part == colours[i].part)
                label = labels[other];
            else if (distance(colours[other].code, colours[i].code) <= 2 * most_codes_off)
                throw InputError(fmt::format("the colours {} of {} and {} of {} cannot be told apart.",
                                             colour_code_text(colours[other].code), colours[other].part,
                                             colour_code_text(colours[i].code), colours[i].part));
        }
        names[label] = colours[i].part;
        labels.push_back(label);
    }
    return labels;
}

double area_of(const RawMesh& mesh, std::size_t triangle) {
    const glm::uvec3& corners = mesh.triangles[triangle];
    const glm::dvec3& a = mesh.positions[corners.x];
    const double twice =
        glm::length(glm::cross(mesh.positions[corners.y] - a, mesh.positions[corners.z] - a));
    return std::isfinite(twice) ? 0.5 * twice : 0.0;
}

std::size_t nearest(glm::ivec3 code, std::span<const PartColour> colours) {
    return static_cast<std::size_t>(
        std::ranges::min_element(colours, {},
                                 [&](const PartColour& colour) { return distance(colour.code, code); }) -
        colours.begin());
}

} // namespace

std::string colour_code_text(glm::ivec3 code) {
    return fmt::format("#{:02x}{:02x}{:02x}", code.x, code.y, code.z);
}

void label_by_colours(RawMesh& mesh, const SurfaceAppearance& look, std::span<const PartColour> colours) {
    const bool has_pictures = std::ranges::any_of(
        look.materials, [](const FileMaterial& material) { return material.colour_picture.picture >= 0; });
    if (look.colours.empty() && !has_pictures)
        throw InputError("has no colours of vertices or faces and no picture, by which parts could be told.");
    SurfaceAppearance sharp = look;
    for (FileMaterial& material : sharp.materials)
        material.colour_picture.is_nearest = true;
    std::map<PartLabel, std::string> names;
    const std::vector<PartLabel> label_of = labels_of_colours(colours, names);
    const std::vector<glm::vec2> within = places_within(), corners{{0, 0}, {1, 0}, {0, 1}};

    std::vector<PartLabel> labels;
    std::vector<int> seen(colours.size());
    std::vector<int> votes(names.size());
    double all = 0.0, unknown = 0.0, mixed = 0.0;
    std::optional<std::pair<std::size_t, glm::ivec3>> first_unknown;
    for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
        const auto index = static_cast<std::uint32_t>(triangle);
        std::ranges::fill(votes, 0);
        glm::ivec3 last{0};
        for (const glm::vec2 place : has_picture(sharp, index) ? within : corners) {
            last = code_of(look_at(sharp, index, place).colour);
            const std::size_t colour = nearest(last, colours);
            if (distance(colours[colour].code, last) > most_codes_off)
                continue;
            ++votes[static_cast<std::size_t>(label_of[colour])];
            ++seen[colour];
        }
        const auto most = std::ranges::max_element(votes);
        const double area = area_of(mesh, triangle);
        all += area;
        if (*most == 0) {
            unknown += area;
            if (!first_unknown)
                first_unknown = {triangle, last};
            labels.push_back(label_of[nearest(last, colours)]);
            continue;
        }
        mixed += std::ranges::count_if(votes, [](int count) { return count > 0; }) > 1 ? area : 0.0;
        labels.push_back(static_cast<PartLabel>(most - votes.begin()));
    }
    const double share = all > 0.0 ? unknown / all : 0.0;
    if (share > most_without_colour)
        throw InputError(
            fmt::format("{:.1f} % of the area has none of the colours that stand for parts; triangle {} has "
                        "{}: name that "
                        "colour, too, or paint without soft edges and save pictures without loss (PNG).",
                        100.0 * share, first_unknown->first + 1, colour_code_text(first_unknown->second)));
    if (first_unknown)
        mesh.remarks.push_back(fmt::format(
            "{:.1f} % of the area has none of the colours of parts and is given to the part of the "
            "nearest colour; the first is triangle {}, {}.",
            100.0 * share, first_unknown->first + 1, colour_code_text(first_unknown->second)));
    if (mixed > most_mixed * all)
        mesh.remarks.push_back(fmt::format("{:.1f} % of the area is of triangles with several colours, each "
                                           "of the part that has most of it.",
                                           100.0 * mixed / all));
    for (std::size_t colour = 0; colour < colours.size(); ++colour)
        if (seen[colour] == 0)
            mesh.remarks.push_back(fmt::format("Nothing of the mesh has the colour {} of {}.",
                                               colour_code_text(colours[colour].code), colours[colour].part));
    mesh.triangle_labels = std::move(labels);
    mesh.part_names = std::move(names);
}

} // namespace overt
