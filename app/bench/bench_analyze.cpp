#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "app/analyze/study_folder.h"
#include "app/bench/bench_clock.h"
#include "app/bench/bench_command.h"
#include "app/cli/interruption.h"
#include "app/cli/resident_memory.h"
#include "experiment/base/random.h"
#include "experiment/base/scratch_folder.h"
#include "experiment/statistics/map_similarity.h"
#include "experiment/surface/hat_smoother.h"
#include "experiment/surface/surface_smoother.h"
#include "experiment/surface/voxel_density.h"

namespace overt {

namespace {

constexpr int tries = 3;

/// The sessions as `overt analyze` takes them, with tables, figures and report.
void measure_study(BenchFigures& figures, const std::vector<std::filesystem::path>& sessions) {
    const Interruption interruption;
    const ScratchFolder scratch("overt-bench");
    reset_peak_memory();
    std::int64_t samples = 0;
    double writing_s = 0.0;
    const double all_s = seconds_for([&] {
        StudyFolder folder(scratch.path() / "study", false);
        const StudyResults results = analyzed(sessions, {});
        samples = results.glance.samples;
        writing_s = seconds_for([&] { folder.publish(results, TableFormat::csv, {}); });
    });
    const double memory_mb = peak_memory_mb();
    figures.push_back({"study: gaze samples", static_cast<double>(samples), "", {}, {}});
    // Of the paper's study: 12 observers, 30 trials of 8 s, 2000 samples a second.
    constexpr double paper_samples = 12.0 * 30.0 * 8.0 * 2000.0, most_s = 60.0, most_mb = 1000.0;
    const double share = std::max(1.0, static_cast<double>(samples) / paper_samples);
    figures.push_back(at_most("study: sessions to tables, figures and report", all_s, "s", most_s * share));
    figures.push_back({"study: of that, figures and report", writing_s, "s", {}, {}});
    figures.push_back({"study: samples", static_cast<double>(samples) / all_s, "1/s", {}, {}});
    figures.push_back(at_most("study: peak memory", memory_mb, "MB", most_mb * share));
}

/// Seconds that scipy.ndimage.gaussian_filter takes; nothing if /usr/bin/python3 has no scipy.
std::optional<double> scipy_seconds(glm::ivec3 cells, double sigma_cells) {
    const std::string command =
        fmt::format("/usr/bin/python3 -c 'import time, numpy, scipy.ndimage\n"
                    "a = numpy.random.default_rng(1).random(({}, {}, {}))\n"
                    "best = 1e9\n"
                    "for i in range({}):\n"
                    " t = time.perf_counter(); scipy.ndimage.gaussian_filter(a, {}, mode=\"constant\")\n"
                    " best = min(best, time.perf_counter() - t)\n"
                    "print(best)' 2>/dev/null",
                    cells.x, cells.y, cells.z, tries, sigma_cells);
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
    std::array<char, 64> text{};
    if (!pipe || !std::fgets(text.data(), static_cast<int>(text.size()), pipe.get()))
        return std::nullopt;
    const double seconds = std::strtod(text.data(), nullptr);
    return seconds > 0.0 ? std::optional(seconds) : std::nullopt;
}

void measure_voxels(BenchFigures& figures) {
    const Bounds bounds{glm::vec3(0.0f), glm::vec3(100.0f)};
    constexpr double sigma = 2.0;
    double best = std::numeric_limits<double>::infinity(), side = 1.0;
    glm::ivec3 cells{0};
    for (int i = 0; i < tries; ++i) {
        VoxelDensity voxels(bounds, sigma, 128);
        RandomStream random(1, "points in voxels");
        for (int point = 0; point < 1000; ++point)
            voxels.add(100.0 * glm::dvec3(random.uniform(), random.uniform(), random.uniform()));
        best = std::min(best, seconds_for([&] { voxels.blur(); }));
        cells = voxels.cells();
        side = voxels.cell_side();
    }
    const std::string what = fmt::format("voxel Gaussian at {} x {} x {}", cells.x, cells.y, cells.z);
    figures.push_back({what, 1e3 * best, "ms", {}, {}});
    if (const std::optional<double> peer = scipy_seconds(cells, sigma / side)) {
        figures.push_back({what + ", scipy.ndimage.gaussian_filter", 1e3 * *peer, "ms", {}, {}});
        figures.push_back(at_most(what + ", time beside scipy's", best / *peer, "", 1.0));
    }
}

/// Eight maps of 60 fixations each on an object that is shown 350 mm high.
void measure_maps(BenchFigures& figures, const Object& object) {
    constexpr double shown_mm = 350.0;
    const SurfaceGeometry geometry(object.mesh, shown_mm / object.mesh->bounds().extent().z);
    for (const double sigma_mm : {30.0, 10.0}) {
        if (!HatSmoother::is_worth_while(geometry, sigma_mm))
            continue;
        RandomStream random(1, "fixations of a bench");
        std::vector<std::vector<SurfaceWeight>> maps(SparseFactor::together);
        double given = 0.0;
        for (std::vector<SurfaceWeight>& map : maps) {
            for (int i = 0; i < 60; ++i) {
                const auto triangle = random.below(static_cast<std::uint32_t>(geometry.triangle_count()));
                map.push_back({{triangle, {0.2, 0.5, 0.3}}, 1.0 + i % 4, sigma_mm});
            }
        }
        for (const SurfaceWeight& weight : maps.front())
            given += weight.weight;
        std::vector<std::vector<double>> of_nodes, of_hats;
        const double nodes_s =
            seconds_for([&] { of_nodes = SurfaceSmoother(geometry, sigma_mm).densities(maps); });
        const double hats_s =
            seconds_for([&] { of_hats = HatSmoother(geometry, sigma_mm, sigma_mm).densities(maps); });
        const std::vector<double> areas = geometry.vertex_areas_mm2();
        double least_cc = 1.0, largest_loss = 0.0;
        for (std::size_t i = 0; i < maps.size(); ++i) {
            least_cc = std::min(least_cc, correlation(of_nodes[i], of_hats[i], areas).value_or(0.0));
            double mass = 0.0;
            for (std::size_t v = 0; v < areas.size(); ++v)
                mass += of_hats[i][v] * areas[v];
            largest_loss = std::max(largest_loss, std::abs(mass / given - 1.0));
        }
        const std::string what = fmt::format("{}, {} nodes, 8 maps with sigma {:g} mm", object.id,
                                             geometry.node_count(), sigma_mm);
        figures.push_back({what + ": by hats", hats_s, "s", {}, {}});
        figures.push_back({what + ": by all nodes", nodes_s, "s", {}, {}});
        figures.push_back(at_least(what + ": correlation of both", least_cc, "", 0.995));
        figures.push_back(at_most(what + ": error of the mass", largest_loss, "", 1e-6));
    }
}

} // namespace

BenchFigures bench_analyze(const BenchOptions& options) {
    BenchFigures figures;
    if (!options.files.empty())
        measure_study(figures, options.files);
    measure_voxels(figures);
    const BenchScene scene = bench_scene(options);
    measure_maps(figures, scene.objects.front());
    return figures;
}

} // namespace overt
