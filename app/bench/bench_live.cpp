#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "app/bench/bench_command.h"
#include "app/bench/painted_look.h"
#include "app/bench/picture_error.h"
#include "app/stimuli/live_errors.h"
#include "render/bake/eye_rays.h"
#include "render/bake/frame_baker.h"
#include "render/bake/light_colour.h"
#include "render/gl/headless_context.h"
#include "render/stimulus/stimulus_renderer.h"

namespace overt {

namespace {

/// Of the pixels that both pictures have whole, the difference of what an sRGB display shows, in order.
std::vector<double> differences(const LinearImage& live, const LinearImage& baked, double exposure) {
    std::vector<double> found;
    const auto lab_of = [&](const glm::vec4& pixel) {
        return lab_of_xyz(xyz_of_rec709(glm::clamp(exposure * glm::dvec3(pixel), 0.0, 1.0)));
    };
    for (std::size_t i = 0; i < live.pixels.size(); ++i)
        if (live.pixels[i].a >= 1.0f && baked.pixels[i].a >= 1.0f)
            found.push_back(ciede2000(lab_of(live.pixels[i]), lab_of(baked.pixels[i])));
    std::ranges::sort(found);
    return found;
}

double quantile(const std::vector<double>& sorted, double share) {
    return sorted.empty() ? 0.0
                          : sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

} // namespace

BenchFigures bench_live(const BenchOptions& options) {
    const BenchScene bench = bench_scene(options);
    const Object& object = bench.objects.front();
    SceneView view = object.scene();
    view.view.image_px = {options.reference_size_px, options.reference_size_px};
    LightSettings surroundings;
    if (!options.probe.empty())
        surroundings.probe = options.probe.string();
    const SpectralLight light(surroundings);
    const auto context = make_headless_context(options.context);
    const MeshBuffers buffers(*context, object.mesh, openness_of_vertices(object.mesh));
    StimulusRenderer renderer(*context, surroundings, view.view.image_px);
    const std::shared_ptr<const SurfaceAppearance> look = painted_look(object.mesh);
    BenchFigures figures;
    for (const LiveDifference& known : live_differences) {
        MaterialSettings material;
        material.kind = known.kind;
        const bool is_of_file = material.is_of_file();
        std::optional<PaintedSurface> painted;
        if (is_of_file) {
            painted.emplace(*context, object.mesh, buffers, *look, material);
            renderer.set_painted(*painted);
        } else {
            renderer.set_material(material);
        }
        const LinearImage live = renderer.draw(buffers, view, Pose{});
        const BakeScene scene(object.mesh, material, is_of_file ? look : nullptr);
        const SpectralFrame frame =
            bake_frame(scene, light, view, {0.0}, covered_pixels(scene, view, {0.0}),
                       {.samples = settings_of(BakeQuality::standard, known.kind).samples});
        const std::vector<double> found =
            differences(live, to_rec709(frame), exposure_below_one(frame, 0.95));
        const std::string name = fmt::format("{}, live to baked, CIEDE2000, ", name_of(known.kind));
        figures.push_back(at_most(name + "median", quantile(found, 0.5), "", known.median));
        figures.push_back(at_most(name + "95 %", quantile(found, 0.95), "", known.most));
    }
    return figures;
}

} // namespace overt
