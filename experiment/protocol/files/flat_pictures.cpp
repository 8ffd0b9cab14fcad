#include "experiment/protocol/files/flat_pictures.h"

#include <algorithm>
#include <cctype>

namespace overt {

namespace {

/// Whether the numbers of a picture are light by the custom of its format, and not sRGB.
bool is_linear_format(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".exr" || extension == ".hdr";
}

/// Flat areas reach as far as this to both sides of the picture, in mm: any depth will do.
constexpr double half_depth_mm = 1.0;

void place_areas(ObjectSettings& object, double mm_per_px) {
    for (AreaSettings& area : object.areas) {
        const auto right_mm = [&](double x_px) { return x_px * mm_per_px; };
        const auto up_mm = [&](double y_px) { return object.picture_mm.y - y_px * mm_per_px; };
        for (const auto& [left, top, right, bottom] : area.rectangles)
            area.boxes.push_back({glm::dvec3(right_mm(left), -half_depth_mm, up_mm(bottom)),
                                  glm::dvec3(right_mm(right), half_depth_mm, up_mm(top))});
        for (const auto& [x, y, radius] : area.discs)
            area.spheres.push_back({right_mm(x), 0.0, up_mm(y), radius * mm_per_px});
    }
}

} // namespace

void add_material_of_pictures(Protocol& protocol) {
    if (!protocol.materials.empty() || protocol.objects.empty() ||
        !std::ranges::all_of(protocol.objects, &ObjectSettings::is_flat))
        return;
    MaterialSettings material;
    material.id = material.title = "picture";
    material.kind = MaterialKind::diffuse;
    protocol.materials.push_back(std::move(material));
}

void complete_pictures(Protocol& protocol) {
    const double mm_per_px = protocol.display.height_mm / protocol.display.height_px;
    for (std::size_t i = 0; i < protocol.objects.size(); ++i) {
        ObjectSettings& object = protocol.objects[i];
        if (!object.is_flat())
            continue;
        object.picture_mm =
            mm_per_px * glm::dvec2(protocol.views.front().width_px, protocol.views.front().height_px);
        place_areas(object, mm_per_px);
        FrameSequenceSettings frames;
        frames.object = object.id;
        frames.files = object.picture.string();
        frames.first_number = object.picture_first_number;
        frames.encoding = is_linear_format(object.picture) ? FrameEncoding::linear : FrameEncoding::srgb;
        frames.colour_space = FrameColours::rec709;
        frames.picture_of = static_cast<int>(i);
        for (const MaterialSettings& material : protocol.materials)
            for (const LightSettings& light : protocol.lights)
                for (const MotionSettings& motion : protocol.motions)
                    for (const ViewSettings& view : protocol.views) {
                        frames.material = material.id;
                        frames.light = light.id;
                        frames.motion = motion.id;
                        frames.view = view.id;
                        protocol.frames.push_back(frames);
                    }
    }
}

} // namespace overt
