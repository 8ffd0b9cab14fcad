#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>

#include <fmt/format.h>

#include "app/bench/bench_clock.h"
#include "app/bench/bench_command.h"
#include "app/bench/path_costs.h"
#include "app/bench/picture_error.h"
#include "app/stimuli/bake_errors.h"
#include "experiment/base/error.h"
#include "experiment/base/scratch_folder.h"
#include "render/bake/eye_rays.h"
#include "render/bake/frame_baker.h"
#include "render/bake/material_model.h"
#include "render/gl/headless_context.h"
#include "render/stimulus/coordinate_pass.h"

namespace overt {

namespace {

struct BakeCase {
    std::string name;
    MaterialSettings material;
    MeasuredErrors errors; ///< that must not be exceeded
};

std::vector<BakeCase> bake_cases() {
    std::vector<BakeCase> cases;
    for (const MeasuredErrors& errors : measured_errors) {
        BakeCase one{"smooth", {}, errors};
        one.material.kind = errors.kind;
        one.material.metal = "Au";
        if (errors.kind == MaterialKind::rough_conductor)
            one.name = "rough";
        if (errors.kind == MaterialKind::coated_conductor) {
            one.name = "coated";
            one.material.metal = "Ag";
        }
        cases.push_back(std::move(one));
    }
    return cases;
}

/// What rays alone take on this machine.
struct RayRates {
    double primary = 0.0, mirrored = 0.0; ///< rays for each second of a processor
};

/// Rays through all pixels of a picture, row by row, and what a mirror makes of those that meet the mesh;
/// nothing else is computed.
RayRates measure_rays(const BakeScene& scene, const SceneView& view) {
    const EyeRays eye(view, {0.0}, scene.centre(), 1.01 * static_cast<double>(scene.radius()));
    const glm::ivec2 size = view.view.image_px;
    std::vector<PathRay> primary, mirrored;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x)
            primary.push_back(eye.through(glm::dvec2(x, y) + 0.5));
    }
    for (const PathRay& ray : primary) {
        const SurfaceHit hit = scene.tree().first_hit(ray, std::numeric_limits<float>::infinity(), true);
        if (hit.surface >= 0)
            mirrored.push_back({hit.position + scene.step_off() * hit.triangle_normal,
                                glm::reflect(ray.direction, hit.shading_normal)});
    }
    const auto rate = [&](const std::vector<PathRay>& rays, bool coherent) {
        double met = 0.0, cast = 0.0;
        const double begin = processor_seconds();
        double took = 0.0;
        do {
            for (const PathRay& ray : rays)
                met += scene.tree().first_distance(ray, coherent) >= 0.0f ? 1.0 : 0.0;
            cast += static_cast<double>(rays.size());
            took = processor_seconds() - begin;
        } while (took < 0.5);
        return met >= 0.0 ? cast / took : 0.0;
    };
    return {rate(primary, true), rate(mirrored, false)};
}

/// The pixels that the map of triangles covers.
std::vector<std::uint8_t> covered_by_map(const ContextChoice& choice, const Object& object,
                                         const SceneView& view) {
    const auto context = make_headless_context(choice);
    CoordinatePass pass(*context, view.view.image_px);
    const MeshBuffers buffers(*context, object.mesh);
    std::vector<std::uint8_t> covered;
    for (const std::uint32_t code : pass.draw(buffers, view, {0.0}))
        covered.push_back(code != 0 ? 1 : 0);
    return covered;
}

SceneView resized(SceneView view, int size_px) {
    view.view.image_px = {size_px, size_px};
    return view;
}

/// A metal that reflects all light, as a table in a folder.
std::string white_metal(const ScratchFolder& folder) {
    const std::filesystem::path file = folder.path() / "white.csv";
    std::ofstream(file) << "wavelength_nm,n,k\n390,0,1\n710,0,1\n";
    return file.string();
}

/// How far a clear figure of a metal that reflects all light is from the even light around it, in the mean.
void measure_furnace(BenchFigures& figures, const Object& object, const BenchOptions& options) {
    const ScratchFolder folder("overt-bench");
    LightProbe even{LinearImage({8, 4}), 0};
    for (glm::vec4& pixel : even.radiance.pixels)
        pixel = glm::vec4(1.0f);
    const SpectralLight light(even, 1.0);
    const SceneView view = resized(object.scene(), options.reference_size_px);
    for (BakeCase one : bake_cases()) {
        one.material.metal = white_metal(folder);
        one.material.coat_absorbance = {0.0, 0.0, 0.0};
        const BakeScene scene(object.mesh, one.material);
        const LinearImage picture = to_rec709(
            bake_frame(scene, light, view, {0.0}, covered_pixels(scene, view, {0.0}), {.samples = 16}));
        double light_sum = 0.0, alpha_sum = 0.0;
        for (const glm::vec4& pixel : picture.pixels) {
            light_sum += static_cast<double>(pixel.y);
            alpha_sum += static_cast<double>(pixel.a);
        }
        const std::string name = one.name + ", white metal in even light: light lost";
        const double lost = 1.0 - light_sum / alpha_sum;
        // What micro-mirrors send to one another is not followed.
        figures.push_back(one.material.kind == MaterialKind::rough_conductor
                              ? BenchFigure{name, lost, ""}
                              : at_most(name, std::abs(lost), "", 0.003));
    }
}

/// Errors of fewer samples against 1024 of another seed.
void measure_errors(BenchFigures& figures, const BakeCase& one, const BakeScene& scene,
                    const SpectralLight& light, const SceneView& view, double exposure) {
    constexpr std::array counts = measured_samples;
    constexpr int comparable_px = 384;
    const std::vector<std::uint8_t> covered = covered_pixels(scene, view, {0.0});
    BakeSettings settings{.samples = 1024};
    settings.seed = 1;
    const SpectralFrame reference = bake_frame(scene, light, view, {0.0}, covered, settings);
    settings.seed = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        settings.samples = counts[i];
        const PictureError error =
            picture_error(bake_frame(scene, light, view, {0.0}, covered, settings), reference, exposure);
        const std::string psnr = fmt::format("{}, {} samples, PSNR", one.name, counts[i]);
        const std::string delta_e = fmt::format("{}, {} samples, mean Delta-E ab", one.name, counts[i]);
        const bool is_comparable = view.view.image_px.x >= comparable_px;
        figures.push_back(is_comparable
                              ? at_least(psnr, error.srgb_psnr_db, "dB", one.errors.least_psnr_db[i])
                              : BenchFigure{psnr, error.srgb_psnr_db, "dB"});
        figures.push_back(is_comparable ? at_most(delta_e, error.mean_delta_e, "", one.errors.most_delta_e[i])
                                        : BenchFigure{delta_e, error.mean_delta_e, ""});
    }
}

/// The same frame under the gallery's compact sources, in turn with the sky: what it takes, what error
/// standard quality has there, and what aiming at the sources brings, by the error that the same time leaves.
void measure_gallery(BenchFigures& figures, const BakeCase& one, const BakeScene& scene,
                     const SpectralLight& sky, const SceneView& view, int samples) {
    LightSettings surroundings;
    surroundings.probe = "gallery";
    const SpectralLight gallery(surroundings);
    SpectralLight unaimed = gallery;
    unaimed.aim_nowhere();
    const std::vector<std::uint8_t> covered = covered_pixels(scene, view, {0.0});
    struct Timed {
        double seconds = 0.0;
        SpectralFrame frame;
    };
    const auto timed = [&](const SpectralLight& light, int count, std::uint64_t seed) {
        const double begin = processor_seconds();
        SpectralFrame frame =
            bake_frame(scene, light, view, {0.0}, covered, {.samples = count, .seed = seed});
        return Timed{processor_seconds() - begin, std::move(frame)};
    };
    const double under_sky_s = timed(sky, samples, 0).seconds;
    const Timed aimed = timed(gallery, samples, 0), by_chance = timed(unaimed, samples, 0);
    figures.push_back(
        {one.name + ", a frame in the gallery by one under the sky", aimed.seconds / under_sky_s, ""});
    const SpectralFrame reference = timed(gallery, 1024, 1).frame;
    const double exposure = exposure_below_one(reference, 0.95);
    const double error = picture_error(aimed.frame, reference, exposure).mean_delta_e;
    figures.push_back(
        {fmt::format("{}, gallery, {} samples, mean Delta-E ab", one.name, samples), error, ""});
    if (!scene.model().scatters)
        return;
    const double chance_error = picture_error(by_chance.frame, reference, exposure).mean_delta_e;
    figures.push_back(
        {fmt::format("{}, gallery, {} samples, no source aimed at, mean Delta-E ab", one.name, samples),
         chance_error, ""});
    // Errors fall with the root of the time.
    figures.push_back({one.name + ", gallery, time for the same error, aimed by not",
                       aimed.seconds * error * error / (by_chance.seconds * chance_error * chance_error),
                       ""});
}

} // namespace

BenchFigures bench_bake(const BenchOptions& options) {
    const BenchScene bench = bench_scene(options);
    const Object& object = bench.objects.front();
    LightSettings surroundings;
    if (!options.probe.empty())
        surroundings.probe = options.probe.string();
    const SpectralLight light(surroundings);
    const std::vector<std::uint8_t> covered = covered_by_map(options.context, object, object.scene());
    const SceneView small = resized(object.scene(), options.reference_size_px);
    constexpr int poses = 31, objects = 3;

    BenchFigures figures;
    std::optional<RayRates> rates;
    double bake_s = 0.0, exposure = 0.0;
    for (const BakeCase& one : bake_cases()) {
        double begin = processor_seconds();
        const BakeScene scene(object.mesh, one.material);
        figures.push_back({one.name + ", trees built", processor_seconds() - begin, "s of a processor"});
        if (!rates) {
            rates = measure_rays(scene, object.scene());
            figures.push_back(
                {"Embree, rays from the eye", 1e-6 * rates->primary, "million/s of a processor"});
            figures.push_back({"Embree, mirrored rays", 1e-6 * rates->mirrored, "million/s of a processor"});
        }
        const BakeSettings settings{.samples = options.samples};
        begin = processor_seconds();
        const auto begin_wall = std::chrono::steady_clock::now();
        const SpectralFrame frame = bake_frame(scene, light, object.scene(), {0.0}, covered, settings);
        const double took = processor_seconds() - begin;
        const double waited = seconds_since(begin_wall);
        double samples = 0.0, wrong = 0.0;
        for (std::size_t pixel = 0; pixel < covered.size(); ++pixel) {
            samples += frame.samples[pixel];
            wrong += (frame.alpha[pixel] >= 0.5f) != (covered[pixel] != 0) ? 1.0 : 0.0;
        }
        const double rays_s = samples / rates->primary + (frame.rays - samples) / rates->mirrored;
        figures.push_back({one.name + ", a frame", took, "s of a processor"});
        figures.push_back({one.name + ", a frame, waited for", waited, "s"});
        figures.push_back({one.name + ", rays for each sample", frame.rays / samples, ""});
        figures.push_back({one.name + ", a frame by what its rays take alone", took / rays_s, ""});
        figures.push_back(at_most(one.name + ", pixels whose alpha and map disagree", wrong, "px", 0.0));
        figures.push_back({one.name + ", pixels whose alpha had to be moved",
                           static_cast<double>(frame.alphas_moved), "px"});
        bake_s += took / options.samples * settings_of(BakeQuality::standard, one.material.kind).samples *
                  poses * objects;
        if (exposure == 0.0)
            exposure = exposure_below_one(frame, 0.95);
        measure_errors(figures, one, scene, light, small, exposure);
        measure_gallery(figures, one, scene, light, small,
                        settings_of(BakeQuality::standard, one.material.kind).samples);
    }
    figures.push_back(at_most("nine stimuli in 31 poses, standard quality, with two processors",
                              bake_s / 2.0 / 3600.0, "h", 10.0));
    measure_furnace(figures, object, options);
    measure_path_costs(figures, object, light, small);
    return figures;
}

} // namespace overt
